"""Taichi's cache of compiled kernels on the disk: kept large enough, and freed of a lock that nobody holds any more.

Taichi guards the cache with a lock file and removes it when it has read or written. A process that is killed in that
moment leaves the lock behind, and from then on every process on the machine compiles everything anew, without a word
(measured: first frame after 21 s instead of 7). And above the default of 100 MB (the kernels of some thirty scenes) it
throws kernels away.
"""

import contextlib
import os
import time
from pathlib import Path

LARGEST = 2**31 - 1  # bytes of kernels kept, the most Taichi can be told; a scene has 2 to 5 MB
LOCK, STALE = "ticache.lock", 60.0  # seconds: reading or writing takes less than one


def free(default: str) -> None:
    """Remove a lock older than a minute from the cache: TI_OFFLINE_CACHE_FILE_PATH, or the default folder given."""
    folder = Path(os.environ.get("TI_OFFLINE_CACHE_FILE_PATH") or default)
    for lock in {folder / LOCK, folder / "ticache" / LOCK}:
        with contextlib.suppress(OSError):
            if time.time() - lock.stat().st_mtime > STALE:
                lock.unlink()
