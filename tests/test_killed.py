"""Fault injection: processes killed at random moments of their life, and killed again, end with the bits of one that
nobody disturbed; and what a kill leaves is never older than the last frame.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tiny import WAVE, contents, write

from taichi_spmhd.stored import read

FRAMES, T_END = 8, 0.2
LABELS = ("xi_0", "xi_1-2")
KILLED = -signal.SIGKILL
PATIENCE = 120.0  # seconds until a run has begun: compiling on a busy machine


class Killing:
    """Runs of one scene in processes of their own, each with its folder and its own cache of kernels."""

    def __init__(self, root):
        self.root, self.scene = root, write(root, WAVE)
        for _ in range(2):  # the first fills the cache
            shutil.rmtree(root / "whole", ignore_errors=True)
            clock = time.monotonic()
            assert self.start("whole").wait() == 0
            self.life = time.monotonic() - clock
        self.whole = contents(root / "whole")

    def start(self, name: str) -> subprocess.Popen:
        """A run, or what is left of it."""
        out = self.root / name
        words = ["run", self.scene, "--arch", "cpu", "--threads", "1", "--quiet", "--out", out]
        new = ["--frames", FRAMES, "--movie", "gif", "--set", f"t_end={T_END}"]
        words += ["--resume"] if (out / "run.json").exists() else new
        env = {**os.environ, "TI_OFFLINE_CACHE_FILE_PATH": str(self.root / f"{name} cache")}
        return subprocess.Popen([sys.executable, "-m", "taichi_spmhd", *map(str, words)], env=env)

    def kill(self, name: str, delay: float, begun: bool, number=signal.SIGKILL) -> int:
        """Signal a run after a delay, from its start or from when it has written its first file; the exit code."""
        running, until = self.start(name), time.monotonic() + PATIENCE
        while begun and not (self.root / name / "run.json").exists() and time.monotonic() < until:
            time.sleep(0.001)
        time.sleep(delay)
        running.send_signal(number)
        return running.wait()

    def disturbed(self, seed: int) -> int:
        """One run killed at least once, then left alone; the number of kills that met it alive."""
        chance, name, kills = random.Random(seed), f"run {seed}", 0
        if chance.random() < 0.8:  # else it compiles, and may be killed while it writes its kernels
            shutil.copytree(self.root / "whole cache", self.root / f"{name} cache")
        while kills == 0 or chance.random() < 0.3:
            begun = chance.random() < 0.6
            kills += self.kill(name, chance.uniform(0, 0.5 if begun else 1) * self.life, begun) == KILLED
            self.check(self.root / name)
            if (self.root / name / "summary.json").exists():
                break
        assert self.start(name).wait() == 0
        assert contents(self.root / name) == self.whole, f"seed {seed}"
        return kills

    def check(self, out) -> None:
        """The states on the disk are of the last frame there, of the last row but one, or later."""
        times = np.linspace(0, T_END, FRAMES)
        frames = len(list((out / "frames").glob("[0-9]*.png")))
        for label in LABELS:
            history, state = out / f"history_{label}.csv", out / f"state_{label}.npz"
            rows = max(0, history.read_text().count("\n") - 1) if history.exists() else 0
            reached = read(state)["time"] if state.exists() else -1.0
            assert frames == 0 or reached >= times[frames - 1]
            assert rows < 2 or reached >= times[rows - 2]


def test_a_run_killed_at_random_moments_resumes_to_the_same_bits(tmp_path):
    assert Killing(tmp_path).disturbed(seed=4) >= 1


@pytest.mark.slow
def test_fifty_runs_killed_at_random_moments_resume_to_the_same_bits(tmp_path):
    killing = Killing(tmp_path)
    with ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:
        kills = list(pool.map(killing.disturbed, range(50)))
    assert sum(kills) >= 50, "some had ended before the moment came, others were killed again"


@pytest.mark.slow
def test_a_process_told_to_end_saves_exits_130_and_resumes_to_the_same_bits(tmp_path):
    killing, chance, ends = Killing(tmp_path), random.Random(1), []
    for k, number in enumerate([signal.SIGINT, signal.SIGTERM] * 2):
        ends.append(killing.kill(f"run {k}", chance.uniform(0, 0.15) * killing.life, True, number))
        killing.check(tmp_path / f"run {k}")
        assert killing.start(f"run {k}").wait() == 0
        assert contents(tmp_path / f"run {k}") == killing.whole
    assert set(ends) <= {0, 130} and ends.count(130) >= 2, "0: it had ended before it was told"
