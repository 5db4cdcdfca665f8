"""A file that takes its place whole or not at all, and is still there after a power cut."""

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

UNABLE = {errno.EINVAL, getattr(errno, "ENOTSUP", errno.EINVAL), errno.EBADF}  # systems that cannot sync a folder


@contextmanager
def replacing(path, ending: str = "", previous=None) -> Iterator[Path]:
    """A temporary name beside `path`, which takes its place when all went well and vanishes otherwise.

    It is on the disk before it is renamed, and so is the new name when this returns. ending: of the temporary name, for
    writers that read the format from it; previous: where the file that was there stays.
    """
    path = Path(path)
    part = temporary(path, ending)
    try:
        yield part
        sync(part)
        if previous is not None and path.exists():
            keep(path, Path(previous))
        os.replace(part, path)
        sync_folder(path.parent)
    finally:
        with suppress(OSError):  # the folder itself may be gone, or be no folder
            part.unlink(missing_ok=True)


def temporary(path: Path, ending: str = "") -> Path:
    """A temporary name of this process."""
    return path.with_name(f".{path.name}.{os.getpid()}.part{ending}")


def keep(path: Path, previous: Path) -> None:
    """Give the file a second name, in one piece; it moves there where the file system has no hard links."""
    link = temporary(previous)
    try:
        os.link(path, link)
        os.replace(link, previous)
    except OSError:
        os.replace(path, previous)
    finally:
        with suppress(OSError):  # two names of one file: renaming one to the other leaves both
            link.unlink(missing_ok=True)


def sync(path: Path) -> None:
    """Wait until the disk has what was written to a file."""
    number = os.open(path, os.O_RDWR)
    try:
        os.fsync(number)
    finally:
        os.close(number)


def sync_folder(folder: Path) -> None:
    """Wait until the disk has the names in a folder, where the system knows how."""
    try:
        number = os.open(folder, os.O_RDONLY)
    except OSError:  # Windows opens no folders
        return
    try:
        os.fsync(number)
    except OSError as error:
        if error.errno not in UNABLE:
            raise
    finally:
        os.close(number)
