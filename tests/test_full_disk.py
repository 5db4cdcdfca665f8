"""A disk that is full from any call on: one line, the earlier state kept; with room again, the same bits."""

import errno
import os
import shutil

import pytest
from tiny import DEVICE, WAVE, contents, one_line, write

from taichi_spmhd.stored import read

WORDS = (*DEVICE, "--variant", "xi = 0", "--frames", "3", "--movie", "gif")
CALLS = ("fsync", "replace", "link")
STATE = "state_xi_0.npz"


class Full:
    """Counts the calls that need room on the disk, and refuses those from `first` on."""

    def __init__(self, patch, first: float = float("inf")):
        self.count, self.first = 0, first
        for name in CALLS:
            patch.setattr(os, name, self.guarded(getattr(os, name)))

    def guarded(self, own):
        def call(*given, **more):
            self.count += 1
            if self.count > self.first:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return own(*given, **more)

        return call


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A scene, the files of a run with room, and how many calls it made."""
    root = tmp_path_factory.mktemp("full")
    scene = write(root, WAVE)
    with pytest.MonkeyPatch.context() as patch:
        full = Full(patch)
        assert one_line("run", scene, "--out", root / "out", *WORDS) == ""
    return scene, contents(root / "out"), full.count


def filled(whole, out, first: int) -> None:
    """A run whose disk is full after so many calls, and then has room again."""
    scene, files, _ = whole
    with pytest.MonkeyPatch.context() as patch:
        Full(patch, first)
        said = one_line("run", scene, "--out", out, *WORDS, codes=(2,))
    assert "cannot write" in said and "free" in said, said
    states = [path for path in out.glob("state_*.npz") if path.name == STATE or ".previous" in path.name]
    assert all(read(path)["time"] >= 0 for path in states), "what is there can be read"
    begun = (out / "run.json").exists()
    assert one_line("run", scene, "--out", out, *WORDS, *(["--resume"] if begun else [])) == ""
    assert contents(out) == files, first
    shutil.rmtree(out)


@pytest.mark.slow
def test_a_disk_full_from_every_fourth_call_on_loses_nothing(whole, tmp_path):
    for first in range(0, whole[2], 4):
        filled(whole, tmp_path / "out", first)


def test_a_disk_full_from_some_call_on_loses_nothing(whole, tmp_path):
    for first in (whole[2] // 2, whole[2] - 1):  # amid the frames; at the end
        filled(whole, tmp_path / "out", first)
