"""What the README says is so: its commands, its examples, its table, and the CI that runs them."""

import re
from pathlib import Path

import numpy as np
import pytest
from tiny import spmhd

from taichi_spmhd import Simulation, load_scene
from taichi_spmhd.library import shipped

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
CI = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
SETUP, TEST = re.findall(r"```sh\n(.*?)\n```", README)  # two commands, no more
SCENE, SCRIPT = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
COMMANDS = sorted(set(re.findall(r"(?<!_)\bspmhd ([a-z]+)\b", README)))
TABLE = re.search(r"\| lecture \|.*?(?=\n\n)", README, re.DOTALL).group(0).splitlines()[2:]


@pytest.fixture
def braked(tmp_path):
    """The README's scene file."""
    path = tmp_path / "braked.py"
    path.write_text(SCENE, encoding="utf-8")
    return path


def cells(line: str) -> list[list[str]]:
    """What stands in backticks, by column: lecture, what, file, scene, test."""
    return [re.findall(r"`([^`]+)`", cell) for cell in line.strip("| \n").split("|")]


def helped(capsys, *words) -> str:
    """What --help says."""
    assert spmhd(*words, "--help") == 0
    return capsys.readouterr().out


def test_two_commands_of_one_line_each_are_all_it_takes():
    assert "\n" not in SETUP and "\n" not in TEST
    assert SETUP.startswith("python3 -m venv .venv && ") and SETUP.endswith("spmhd run scenes/alfven_tensile.py")
    assert TEST == ".venv/bin/python -m pytest"


def test_the_ci_runs_the_same_two_commands():
    lines = [line.strip() for line in CI.splitlines()]
    assert SETUP in lines and f"check {TEST}" in lines and f"check {TEST} -m slow" in lines
    assert CI.index(SETUP) < CI.index("'.[dev]'"), "a dependency the README's line lacks would be hidden"


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_it_names_exists(capsys, command):
    assert helped(capsys, command).startswith(f"usage: spmhd {command}")


def test_every_command_there_is_and_every_option_it_names_are_told(capsys):
    there = re.findall(r"^    ([a-z]+) {2}", helped(capsys), re.MULTILINE)
    told = ("list", "show", "run", "live", "bench", "cost", "dispersion", "stability")
    assert there == [name for name in told if name in COMMANDS]
    known = "".join(helped(capsys, command) for command in there)
    unknown = {option for option in re.findall(r"(?<![\w-])--[a-z][a-z-]+", README) if option not in known}
    assert unknown <= {"--help"}


def test_the_scene_it_shows_brakes_and_heats_as_it_says(braked):
    """dv/dt changes by -v/tau at every particle; the heat makes up for it, so the energy stays."""
    variants = load_scene(braked, nx=8, tau=0.2)
    with Simulation(variants["free"]) as free, Simulation(variants["braked"]) as sim:
        change = sim.rates()["v"] - free.rates()["v"]
        assert change == pytest.approx(-sim["v"] / 0.2, abs=1e-12 * np.abs(sim["v"]).max() / 0.2)
        sim.run(until=0.05)
        # leapfrog's own error; without the heat it would be the kinetic energy lost, 3e-3 of the total
        assert abs(sim.summary()["energy_drift"]) < 1e-4


def test_its_effect_has_eight_lines():
    effect = re.search(r"@dataclass.*?(?=\n\n\n)", SCENE, re.DOTALL).group(0).splitlines()
    assert len([line for line in effect if '"""' not in line and line.strip()]) <= 8


def test_its_python_example_runs(capsys):
    names = {}
    exec(compile(SCRIPT, "README.md", "exec"), names)
    assert names["rgb"].dtype == np.uint8 and "(" in capsys.readouterr().out
    names["sim"].close()


@pytest.mark.parametrize("line", TABLE)
def test_the_lecture_table_names_what_exists(line):
    _, _, files, scenes, tests = cells(line)
    assert files and scenes and tests
    assert all((ROOT / name).is_file() for name in files + tests)
    assert set(scenes) <= set(shipped())


def test_the_lecture_table_leaves_no_scene_and_no_term_out():
    named = {name for line in TABLE for name in cells(line)[3]}
    assert named == set(shipped())
    terms = {path.name for path in (ROOT / "taichi_spmhd" / "terms").glob("*.py")} - {"__init__.py", "base.py"}
    assert terms <= {Path(name).name for line in TABLE for name in cells(line)[2]}


def test_its_links_lead_somewhere_and_its_film_is_small():
    local = [link for link in re.findall(r"\]\(([^)]+)\)", README) if not link.startswith("http")]
    assert all((ROOT / link).exists() for link in local)
    films = [ROOT / link for link in local if link.endswith(".gif")]
    assert films and all(film.stat().st_size < 4_000_000 for film in films)
