"""Scene files small enough to run in a test, and what the tests of the commands have in common."""

import io
import json
from contextlib import redirect_stderr, redirect_stdout

import numpy as np

from taichi_spmhd.__main__ import main

WAVE = '''"""A tiny wave: rows of particles.

Nothing to look for. About 2 s on two cores.
"""
from dataclasses import dataclass
from typing import Literal

import numpy as np

from taichi_spmhd import Picture, Scene, hexagonal
from taichi_spmhd.runtime import ti
from taichi_spmhd.terms import DivBSource, Induction, Pressure, Stress, Term
from taichi_spmhd.types import vec3

BOX = (1.0, np.sqrt(0.75))


def start(x):
    wave = np.sin(2 * np.pi * x[:, 0])
    still = np.zeros_like(wave)
    B = np.stack([still + 1, 0.1 * wave, still], axis=1)
    return {"rho": 1.0, "P": 0.1, "B": B, "v": np.stack([still, wave, still], axis=1)}


def scenes(nx=16, t_end=0.1, beta=0.2, noisy=False, lattice: Literal["hexagonal", "square"] = "hexagonal"):
    bare = Scene(box=BOX, positions=hexagonal(BOX, nx), start=start, terms=(Stress(), Induction()), t_end=t_end,
                 picture=Picture("B", axis=1, width=400))
    return {"xi = 0": bare, "xi = 1/2": bare.plus(DivBSource(xi=0.5))}
'''

EXPLODES = (
    WAVE
    + '''

@dataclass(frozen=True)
class Bang(Term):
    """dv/dt = sqrt(0.05 - t): not a number from t = 0.05 on"""

    evolves = {"v": vec3}

    @ti.func
    def local(self, i, now):
        return ti.Struct(v=ti.sqrt(0.05 - now.t) * ti.Vector([1.0, 0.0, 0.0]))


calm = scenes


def scenes():
    bare = calm()["xi = 1/2"]
    return {"calm": bare, "bang": bare.plus(Bang())}
'''
)

DEVICE = ("--arch", "cpu", "--threads", "2")


def write(folder, text: str, name: str = "wave.py"):
    """A scene file."""
    path = folder / name
    path.write_text(text)
    return path


def spmhd(*words) -> int:
    """A command in this process; the exit code."""
    return main([str(word) for word in words])


def run(scene, out, *words) -> int:
    """`spmhd run` with few frames and no film, unless words say otherwise."""
    given = [str(word) for word in words]
    more = [] if "--resume" in given or "--frames" in given else ["--frames", 5]
    more += [] if "--resume" in given or "--movie" in given else ["--movie", "none"]
    return spmhd("run", scene, "--out", out, *DEVICE, *more, *given)


def refused(capsys, *words) -> str:
    """The one line of a command that must be refused; checks the exit code and that there is no traceback."""
    capsys.readouterr()
    assert spmhd(*words) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1 and lines[0].startswith("spmhd: error: ")
    return lines[0]


def one_line(*words, codes=(0, 2)) -> str:
    """What a command says on stderr: nothing with exit code 0, one line otherwise; any other end is a mistake."""
    said = io.StringIO()
    with redirect_stderr(said), redirect_stdout(io.StringIO()):
        code = spmhd(*words)
    lines = said.getvalue().splitlines()
    assert code in codes and len(lines) == (code != 0), f"{words}: exit code {code}: {said.getvalue()}"
    assert code == 0 or lines[0].startswith("spmhd: error: "), lines
    return lines[0] if lines else ""


def line_of(text: str, words: str) -> int:
    """The number of the line in which these words stand."""
    return next(n for n, line in enumerate(text.splitlines(), 1) if words in line)


def without_seconds(line: str) -> list[str]:
    """The cells of a line of table.md; its third column is the stopwatch's, and the last line has the day."""
    cells = line.split(" | ")
    return [] if line.startswith("Made by") else cells[:2] + cells[3:]


def contents(folder) -> dict:
    """Every file of a run by name; states without the stopwatch, summary and table without what depends on it."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.suffix == ".npz":
            with np.load(path) as file:
                timing = ("seconds", "seconds_compile", "timed")
                found[name] = {key: file[key].tobytes() for key in file.files if key not in timing}
        elif path.name == "summary.json":
            made = json.loads(path.read_text())
            drop = ("seconds", "seconds_compile", "updates_per_s")
            found[name] = {
                label: {k: v for k, v in e.items() if k not in drop} for label, e in made["variants"].items()
            }
        elif path.name == "table.md":
            found[name] = [without_seconds(line) for line in path.read_text().splitlines()]
        elif path.is_file():
            found[name] = path.read_bytes()
    return found


class Killed(BaseException):
    """Nothing catches this, as nothing catches SIGKILL."""


def kill_at(monkeypatch, owner, name: str, count: int):
    """Die instead of the count-th call of a function."""
    calls, own = [], getattr(owner, name)

    def dies(*given, **more):
        calls.append(0)
        if len(calls) == count:
            raise Killed
        return own(*given, **more)

    monkeypatch.setattr(owner, name, dies)
