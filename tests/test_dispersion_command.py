"""`spmhd dispersion`: files, pictures, scans, and what cannot be meant."""

import csv
import json

import numpy as np
import pytest
from PIL import Image
from tiny import spmhd

from taichi_spmhd import InputError, WendlandC4, load_scene
from taichi_spmhd.dispersion import scan, scan_picture
from taichi_spmhd.glass import glass
from taichi_spmhd.parameters import parameters
from taichi_spmhd.simulation import Simulation

KNOWN = parameters(lambda nx=32, xi=0.0, lattice="square": None)
SCENE = next(iter(load_scene("uniform_field").values()))


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("xi=0:1:5", {"xi": [0, 0.25, 0.5, 0.75, 1]}),
        ("xi=1e-3:10:5", {"xi": [1e-3, 1e-2, 0.1, 1, 10]}),  # far apart: evenly in the logarithm
        ("xi=0, 1/2,1", {"xi": [0, 0.5, 1]}),
        ("nx=16:24:3", {"nx": [16, 20, 24]}),
        ("lattice=square,hexagonal", {"lattice": ["square", "hexagonal"]}),
        ("kernel=cubic,wendland_c4", {"kernel": ["cubic", "wendland_c4"]}),
        ("DivBSource=on,off", None),
    ],
)
def test_ranges_and_lists_become_values(text, values):
    if values is None:
        with pytest.raises(InputError, match="nothing of that name"):  # the scene lists no DivBSource at xi = 0
            scan.ranges([text], KNOWN, SCENE)
    else:
        assert {n: pytest.approx(v) if n == "xi" else v for n, v in values.items()} == scan.ranges([text], KNOWN, SCENE)


WRONG = {
    "no range": (["--scan", "xi"], "NAME=FROM:TO:COUNT"),
    "one value in a range": (["--scan", "xi=0:1:1"], "count from 2"),
    "an unknown name": (["--scan", "chi=0,1"], "nothing of that name"),
    "no number": (["--scan", "xi=a,b"], "expected a number"),
    "set and scanned": (["--scan", "xi=0,1", "--set", "xi=1"], "in both"),
    "too many": (["--scan", "xi=0:1:200", "beta=0.1:1:200"], "fewer values"),
    "a lattice of another dimension": (["--lattice", "cubic"], "in 2-D there are hexagonal"),
    "a spot outside": (["--at", "0.5", "7"], "a spot of the box"),
    "half a spot": (["--at", "0.5"], "a number for each axis"),
    "a folder that is a file": (["--out", __file__], "is a file"),
    "a value that the scene refuses": (["--scan", "beta=-1,1"], "must be positive"),
}


@pytest.mark.parametrize(("words", "says"), WRONG.values(), ids=WRONG)
def test_what_cannot_be_meant_is_one_line(capsys, tmp_path, words, says):
    out = [] if "--out" in words else ["--out", tmp_path / "out"]
    assert spmhd("dispersion", "uniform_field", *words, *out) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1 and says in lines[0]


def test_a_scene_gives_table_picture_and_record(capsys, tmp_path):
    assert spmhd("dispersion", "uniform_field", "--set", "beta=0.2", "lattice=square", "--out", tmp_path) == 0
    said = capsys.readouterr().out
    assert "1.1347 v_A/dx" in said and "square" in said
    made = json.loads((tmp_path / "dispersion.json").read_text())
    row = made["rows"][0]
    assert (row["xi"], row["beta"], row["growth"]) == (0.0, pytest.approx(0.2), pytest.approx(1.1347, abs=5e-4))
    assert made["states"]["xi = 0"]["boundary_xi"] == pytest.approx(0.4)
    # along B, 90 degrees out of phase with the density and so with u: the real part of one is the other's imaginary one
    vector = {name: complex(*parts) for name, parts in row["eigenvector"].items()}
    assert max(vector, key=lambda name: abs(vector[name])) in ("x_x", "v_x")
    assert abs((vector["u"] / vector["v_x"]).real) < 1e-3 * abs(vector["u"] / vector["v_x"])
    with open(tmp_path / "dispersion.csv") as file:
        table = list(csv.DictReader(file))
    grid = [float(r["growth"]) for r in table if r["where"] == "map"]
    assert max(grid) <= row["growth"] * (1 + 1e-9) and max(grid) > 0.99 * row["growth"]
    assert {r["angle"] for r in table if r["where"] == "line"} == {"0", "45", "90"}
    picture = np.asarray(Image.open(tmp_path / "dispersion.png").convert("RGB"))
    assert picture.std() > 20  # not an empty sheet


def test_a_scan_gives_a_row_for_every_combination_and_a_map(capsys, tmp_path):
    words = ["--scan", "xi=0,0.3,0.6", "beta=0.1,0.5", "--set", "lattice=square", "--out", tmp_path, "--quiet"]
    assert spmhd("dispersion", "uniform_field", *words) == 0
    assert capsys.readouterr().out == ""
    rows = json.loads((tmp_path / "dispersion.json").read_text())["rows"]
    assert [(r["xi"], round(r["beta"], 9)) for r in rows] == [(x, b) for x in (0, 0.3, 0.6) for b in (0.1, 0.5)]
    # xi < (1 - beta)/2, the boundary of linear theory
    assert [r["growth"] > 1e-3 for r in rows] == [r["xi"] < 0.5 * (1 - r["beta"]) for r in rows]
    assert len((tmp_path / "dispersion.csv").read_text().splitlines()) == 7
    assert (tmp_path / "dispersion.png").stat().st_size > 10_000


def test_a_glass_is_even_and_the_same_every_time():
    box, kernel = (1.0, 1.0), WendlandC4()
    x = glass(box, 12, kernel, seed=1)
    assert np.array_equal(x, glass(box, 12, kernel, seed=1)) and not np.array_equal(x, glass(box, 12, kernel, seed=2))
    scene = SCENE.but(box=box, positions=x, kernel=kernel)
    with Simulation(scene) as sim:
        rho = sim["rho"]
    # a random start has 25 %; measured 0.2 %
    assert rho.std() / rho.mean() < 0.01
    assert x.min() >= 0 and x.max() < 1


def test_what_was_asked_stands_beside_what_was_found(tmp_path):
    """uniform_field has a parameter `angle`, of B; the mode has an angle of its own, to B."""
    words = ["--scan", "angle=0,30", "--set", "lattice=square", "beta=0.2", "--out", tmp_path, "--quiet"]
    assert spmhd("dispersion", "uniform_field", *words) == 0
    rows = json.loads((tmp_path / "dispersion.json").read_text())["rows"]
    assert [row["parameters"]["angle"] for row in rows] == [0, 30]
    with open(tmp_path / "dispersion.csv") as file:
        table = list(csv.DictReader(file))
    assert [row["set angle"] for row in table] == ["0", "30"] and float(table[0]["angle"]) < 1


def test_a_map_over_words_has_the_words(tmp_path):
    words = ["--scan", "kernel=cubic,wendland_c4", "beta=0.1,0.5", "--out", tmp_path, "--quiet"]
    assert spmhd("dispersion", "uniform_field", *words) == 0
    assert scan_picture.edges(["cubic", "quintic"]).tolist() == [-0.5, 0.5, 1.5]
    assert scan_picture.edges([1.0, 10.0, 100.0]) == pytest.approx(10 ** np.array([-0.5, 0.5, 1.5, 2.5]))
    assert (tmp_path / "dispersion.png").stat().st_size > 10_000


def test_a_scan_of_a_variant_that_is_nowhere_is_told(capsys, tmp_path):
    words = ["--scan", "beta=0.1,0.5", "--variant", "xi = 7", "--out", tmp_path, "--quiet"]
    assert spmhd("dispersion", "uniform_field", *words) == 2
    assert "no state of this scan has it" in capsys.readouterr().err


def test_a_scene_whose_field_cancels_is_told_where_to_look(capsys, tmp_path):
    words = ["--set", "nx=16", "--variant", "with cleaning", "--out", tmp_path]
    assert spmhd("dispersion", "orszag_tang", *words) == 0
    assert "no field in the mean" in capsys.readouterr().out
