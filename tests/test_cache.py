"""Taichi's cache on the disk: a lock that nobody holds does not switch it off."""

import os
import time

from taichi_spmhd.cache import LOCK, STALE, free


def test_a_lock_left_by_a_killed_process_goes(tmp_path, monkeypatch):
    monkeypatch.delenv("TI_OFFLINE_CACHE_FILE_PATH", raising=False)
    lock = left(tmp_path / "ticache", age=2 * STALE)
    free(str(tmp_path))
    assert not lock.exists()


def test_a_lock_that_may_be_held_stays(tmp_path, monkeypatch):
    monkeypatch.setenv("TI_OFFLINE_CACHE_FILE_PATH", str(tmp_path / "own"))
    lock = left(tmp_path / "own" / "ticache", age=STALE / 2)
    free(str(tmp_path))
    assert lock.exists()


def test_a_cache_that_is_not_there_is_no_error(tmp_path):
    free(str(tmp_path / "nothing"))


def left(folder, age: float):
    """A lock that was made `age` seconds ago."""
    folder.mkdir(parents=True)
    lock = folder / LOCK
    lock.touch()
    then = time.time() - age
    os.utime(lock, (then, then))
    return lock
