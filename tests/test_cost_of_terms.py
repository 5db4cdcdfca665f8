"""What a scene does not list does not exist: no member, no byte, no instruction. What it lists costs something."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from taichi_spmhd.lattice import square
from taichi_spmhd.scene import Scene
from taichi_spmhd.terms import Conductivity, Pressure, Viscosity

PACKAGE = Path(__file__).parents[1] / "taichi_spmhd"
BOX = (1.0, 1.0)
MAGNETIC = {"B", "b", "psi", "y", "ch", "Pt"}

BUILD = """
import json, sys
import taichi_spmhd as spmhd
from taichi_spmhd import terms

spmhd.init(arch="cpu", precision=sys.argv[1], threads=1)
box = (1.0, 1.0)
scene = spmhd.Scene(box=box, positions=spmhd.square(box, 12), start=lambda x: {"rho": 1.0, "P": 1.0, "B": [1.0, 0, 0]},
                    terms=tuple(getattr(terms, name)() for name in sys.argv[2:]))
sim = spmhd.Simulation(scene)
sim.begin()
print(json.dumps({"members": list(sim.particles.members), "bytes": sim.particles.bytes_each + sim.neighbours.bytes_each,
                  "package": spmhd.__file__, "terms": terms.__all__}))
"""

PRICES = """
import json, time
from taichi_spmhd import runtime
from taichi_spmhd.bench import cases
from taichi_spmhd.simulation import Simulation
from taichi_spmhd.terms import Cleaning, Resistivity

runtime.init("cpu", "f32", 1)
full = cases.scene("mhd3d_f32", 16)
sims = {"all": full, "no Cleaning": full.without(Cleaning), "no Resistivity": full.without(Resistivity)}
sims, best = {label: Simulation(scene) for label, scene in sims.items()}, {}
for repeat in range(60):
    for label, sim in sims.items():
        if repeat == 0:
            sim.begin()
        clock = time.perf_counter()
        sim.rhs.rates(sim.neighbours.near, sim.neighbours.count, 0.0, 0.0, sim.rhs.moment.most, sim.rhs.sums.rows)
        best[label] = min(best.get(label, 1e9), time.perf_counter() - clock)
print(json.dumps(best))
"""


def child(tree: Path, folder: Path, code: str, *words: str) -> dict:
    """What a child that finds the package in `tree` prints; its kernels are compiled anew and written to `folder`."""
    folder.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(tree), "TI_OFFLINE_CACHE_FILE_PATH": str(folder / "kernels")}
    environment["TI_PRINT_KERNEL_LLVM_IR_OPTIMIZED"] = "1"
    command = [sys.executable, "-c", code, *words]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.strip().splitlines()[-1])


ARITHMETIC = re.compile(r"= f(?:add|sub|mul|div|neg) [a-z ]*(?:<(\d+) x )?")


def rates_kernel(folder: Path) -> str:
    """Machine-independent code of the rates kernel after optimisation."""
    modules = [text for text in (path.read_text() for path in folder.glob("*.ll")) if "define void @rates_" in text]
    assert len(modules) == 1, f"one rates kernel was expected in {sorted(folder.iterdir())}"
    return modules[0]


def instructions(folder: Path) -> int:
    """Lines of code."""
    return sum(line.startswith("  ") for line in rates_kernel(folder).splitlines())


def arithmetic(folder: Path) -> int:
    """Additions and multiplications; a vector instruction counts each of its numbers, however wide it is."""
    return sum(int(width or 1) for width in ARITHMETIC.findall(rates_kernel(folder)))


def vector_share(folder: Path) -> float:
    """How much of the arithmetic is done by vector instructions."""
    widths = [int(width or 1) for width in ARITHMETIC.findall(rates_kernel(folder))]
    return sum(width for width in widths if width > 1) / sum(widths)


def tree_without_cleaning(folder: Path) -> Path:
    """A copy of the package without cleaning.py and its mention; the benchmark, which lists the term, stays behind."""
    copy = folder / "taichi_spmhd"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__", "bench"))
    (copy / "terms" / "cleaning.py").unlink()
    index = copy / "terms" / "__init__.py"
    kept = [line for line in index.read_text().splitlines() if "leaning" not in line]
    index.write_text("\n".join(kept) + "\n")
    return folder


def test_a_hydro_scene_allocates_nothing_magnetic(simulate):
    scene = Scene(
        box=BOX,
        positions=square(BOX, 12),
        start=lambda x: {"rho": 1.0, "P": 1.0},
        terms=(Pressure(), Viscosity(), Conductivity()),
    )
    sim = simulate(scene)
    assert not MAGNETIC & set(sim.particles.members)
    assert not MAGNETIC & set(sim.particles.names)


@pytest.mark.parametrize("precision", ["f64", "f32"])
def test_a_term_that_is_not_listed_leaves_what_a_build_without_its_file_has(tmp_path, precision):
    listed = ("Stress", "Induction", "Viscosity")
    bare = tree_without_cleaning(tmp_path)
    here = child(PACKAGE.parent, tmp_path / "here", BUILD, precision, *listed)
    there = child(bare, tmp_path / "there", BUILD, precision, *listed)
    more = child(PACKAGE.parent, tmp_path / "more", BUILD, precision, *listed, "Cleaning")
    assert Path(there["package"]).is_relative_to(bare) and "Cleaning" not in there["terms"]
    assert Path(here["package"]).is_relative_to(PACKAGE) and "Cleaning" in here["terms"]
    assert here["members"] == there["members"] and here["bytes"] == there["bytes"]
    assert instructions(tmp_path / "here") == instructions(tmp_path / "there")
    assert more["bytes"] > here["bytes"] and {"y", "psi", "ch"} <= set(more["members"]) - set(here["members"])
    # so the comparison can fail; lines of code would not do: on some processors more of a longer loop is vectorised
    assert arithmetic(tmp_path / "more") > arithmetic(tmp_path / "here") + 20


@pytest.mark.slow
def test_listed_terms_cost_measurably_more_in_f32(tmp_path):
    """Rates kernel of full MHD against the same without one term: minima of 60 interleaved repeats.

    Measured on 2 AVX-512 cores that others used as well: Cleaning + 11 %, Resistivity + 14 %; 2 % must show.
    """
    best = child(PACKAGE.parent, tmp_path / "prices", PRICES)
    assert best["all"] > 1.02 * best["no Cleaning"]
    assert best["all"] > 1.02 * best["no Resistivity"]
