"""Finding and loading scene files, and their parameters."""

import pytest
from tiny import WAVE, write

import taichi_spmhd as spmhd
from taichi_spmhd import InputError, library


@pytest.fixture
def wave(tmp_path):
    return write(tmp_path, WAVE)


def test_variants_and_parameters_of_a_file(wave):
    variants = spmhd.load_scene(wave, nx=20)
    assert list(variants) == ["xi = 0", "xi = 1/2"]
    assert len(variants["xi = 0"].positions) == 20 * 20
    assert library.parameters_of(wave) == {
        "nx": 16, "t_end": 0.1, "beta": 0.2, "noisy": False, "lattice": "hexagonal"
    }  # fmt: skip


def test_text_becomes_what_the_default_is(wave):
    read = library.parameters_of(wave, nx="32", beta="1/2", t_end="1e-3", noisy="yes", lattice="square")
    assert read == {"nx": 32, "beta": 0.5, "t_end": 1e-3, "noisy": True, "lattice": "square"}
    assert library.parameters_of(wave, beta=1)["beta"] == 1.0


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"nxx": 3}, r"no parameter 'nxx' \(did you mean 'nx'\?\); it has nx, t_end"),
        ({"nx": "abc"}, "nx=abc: expected a whole number, for example nx=16"),
        ({"nx": "3.5"}, "whole number"),
        ({"nx": 3.5}, "whole number"),
        ({"nx": True}, "whole number"),
        ({"beta": ""}, "beta=: expected a number"),
        ({"beta": "nan"}, "expected a number"),
        ({"beta": "1/0"}, "expected a number"),
        ({"noisy": "maybe"}, "true or false"),
        ({"lattice": "hexagon"}, r"one of hexagonal, square \(did you mean 'hexagonal'\?\)"),
    ],
)
def test_parameters_that_do_not_fit_are_named_with_what_does(wave, given, words):
    with pytest.raises(InputError, match=words):
        spmhd.load_scene(wave, **given)


BROKEN = {
    "def scenes(:\n": r"wave.py, line 1: SyntaxError: ",
    "x = 1\n": r"wave.py is no scene file: it needs a function scenes",
    "import no_such_module\n": r"wave.py, line 1: ModuleNotFoundError: No module named 'no_such_module'",
    "x = 1\ny = 1 / 0\n": r"wave.py, line 2: ZeroDivisionError",
    "raise SystemExit(3)\n": r"wave.py, line 1: SystemExit",
    "def scenes():\n    return 3\n": r"scenes\(\) returned int; it must return",
    "def scenes():\n    return {}\n": r"scenes\(\) returned dict",
    "def scenes():\n    return {'a': 3}\n": r"returned 'a': int",
    "def scenes():\n\n    return undefined\n": r"wave.py, line 3: NameError",
    "def scenes(nx):\n    return {}\n": r"give the parameter 'nx' a default",
}


@pytest.mark.parametrize("text", BROKEN)
def test_a_broken_scene_file_is_named_with_its_line(tmp_path, text):
    with pytest.raises(InputError, match=BROKEN[text]) as told:
        spmhd.load_scene(write(tmp_path, text))
    assert "\n" not in str(told.value)


def test_an_unknown_scene_names_the_nearest(tmp_path, monkeypatch):
    scenes = {"alfven_tensile": tmp_path / "alfven_tensile.py", "blast": tmp_path / "blast.py"}
    monkeypatch.setattr(library, "shipped", lambda: scenes)
    with pytest.raises(InputError, match=r"did you mean 'alfven_tensile'\?\); there are alfven_tensile, blast"):
        spmhd.load_scene("alfen_tensile")
    with pytest.raises(InputError, match=r"no scene file blst.py \(did you mean 'blast'\?\)"):
        spmhd.load_scene("blst.py")
    assert library.find("blast") == scenes["blast"]


def test_a_changed_file_is_loaded_anew(tmp_path):
    path = write(tmp_path, WAVE)
    assert "xi = 0" in spmhd.load_scene(path)
    assert "none" in spmhd.load_scene(write(tmp_path, WAVE.replace('"xi = 0"', '"none"')))


def test_a_neighbour_file_can_be_imported(tmp_path):
    write(tmp_path, "NX = 12\n", "numbers_of_the_wave.py")
    text = WAVE.replace("from dataclasses", "from numbers_of_the_wave import NX\nfrom dataclasses").replace(
        "nx=16", "nx=NX"
    )
    assert library.parameters_of(write(tmp_path, text))["nx"] == 12


def test_file_names_of_labels():
    assert library.slug("xi = 1/2") == "xi_1-2"
    assert library.slug("with cleaning") == "with_cleaning"
    assert library.slug("h = 1.2+ (fine)") == "h_1.2+_fine_"


def test_labels_that_give_one_file_name_are_refused(tmp_path):
    text = WAVE.replace('"xi = 1/2": bare.plus(DivBSource(xi=0.5))', '"xi=0": bare')
    with pytest.raises(InputError, match="'xi = 0' and 'xi=0' give one file name xi_0; rename one"):
        spmhd.load_scene(write(tmp_path, text))


def test_listing_reads_without_running(tmp_path, monkeypatch):
    path = write(tmp_path, WAVE + "\nraise RuntimeError\n")
    monkeypatch.setattr(library, "shipped", lambda: {"wave": path})
    (entry,) = library.listing()
    assert entry == ("wave", "A tiny wave: rows of particles.", "About 2 s on two cores", path)


def test_every_scene_that_ships_says_what_to_see_and_what_it_costs():
    for entry in library.listing():
        assert entry.sight and entry.cost, entry.name
