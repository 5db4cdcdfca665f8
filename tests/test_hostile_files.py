"""Arrays that were damaged, or made by somebody else: refused in one line, or the very same bits; never unpickled."""

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_checkpoint import altered, turbulence

import taichi_spmhd
from taichi_spmhd import InputError, Simulation
from taichi_spmhd.checkpoint import admit
from taichi_spmhd.diagnostics.reference import loaded
from taichi_spmhd.render import write_gif, write_png
from taichi_spmhd.stored import read

OPENED = Path(__file__).parent / "opened"  # what the pickle below would make


class Trap:
    """An object whose pickle makes a folder when it is read."""

    def __reduce__(self):
        return os.mkdir, (str(OPENED),)


class Saved:
    """A simulation, the bytes of its state, and the arrays in it."""

    def __init__(self, sim, path):
        self.sim, self.path = sim, path
        sim.step()
        sim.save(path)
        self.content, self.arrays = path.read_bytes(), read(path)

    def same(self, content: bytes) -> bool:
        """Whether a file says the same to the bit; False where it is refused in one line. Else it is a mistake."""
        self.path.write_bytes(content)
        try:
            found = read(self.path)
            admit(self.sim, self.path, found)
        except InputError as error:
            assert str(self.path) in str(error) and str(error).isprintable() and len(str(error)) < 2000
            return False
        assert {name: found[name].tobytes() for name in self.arrays} == self.bits(), "other bits were taken for a state"
        return True

    def bits(self) -> dict:
        return {name: array.tobytes() for name, array in self.arrays.items()}


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    with Simulation(turbulence(12)) as sim:
        yield Saved(sim, tmp_path_factory.mktemp("saved") / "state.npz")


SHARE = st.floats(0, 1, exclude_max=True)


@settings(max_examples=120)
@given(at=SHARE, length=st.integers(0, 40), new=st.binary(max_size=40))
def test_a_state_with_other_bytes_is_refused_or_the_same_bits(saved, at, length, new):
    k = int(at * len(saved.content))
    saved.same(saved.content[:k] + new + saved.content[k + length :])


@settings(max_examples=60)
@given(at=SHARE, mask=st.integers(1, 255), end=st.integers(0, 3000))
def test_a_state_with_a_flipped_byte_is_refused_or_the_same_bits(saved, at, mask, end):
    """The directory at the end of the archive, and headers, are where a byte may matter to nobody."""
    content = saved.content
    for k in (int(at * len(content)), len(content) - 1 - end):
        saved.same(content[:k] + bytes([content[k] ^ mask]) + content[k + 1 :])


@settings(max_examples=30)
@given(at=SHARE)
def test_a_state_cut_short_is_refused(saved, at):
    assert not saved.same(saved.content[: int(at * len(saved.content))])


CHANGES = {
    "left out": lambda a: None,
    "of objects": lambda a: np.array([Trap()], dtype=object),
    "text": lambda a: np.full(a.shape, "a"),
    "complex": lambda a: a.astype(complex) if a.dtype.kind in "fiu" else None,
    "of another size": lambda a: np.zeros((*a.shape, 2), a.dtype),
    "empty": lambda a: np.zeros((0, *a.shape[1:]), a.dtype) if a.ndim else np.zeros(0),
    "not a number": lambda a: a * np.nan if a.dtype.kind == "f" else None,
    "half as precise": lambda a: a.astype(np.float16) if a.dtype.kind == "f" and a.ndim else None,
    "negative": lambda a: -1.0 - abs(a) if a.dtype.kind == "f" and not a.ndim else None,
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_state_with_another_array_is_refused(saved, change):
    for name, array in saved.arrays.items():
        if change == "negative" and name in ("E0", "used"):
            continue  # the energy of a gas that radiates may be below 0
        assert not saved.same(altered(saved.content, **{name: CHANGES[change](array)})), name
    assert not OPENED.exists()


def test_a_number_of_objects_in_a_map_is_refused(tmp_path):
    path = tmp_path / "map.npz"
    for arrays in ({"rho": np.array([[Trap()]], dtype=object)}, {"rho": np.ones((2, 2)) * np.nan}, {"rho": []}):
        np.savez(path, t=1.0, **arrays)
        with pytest.raises(InputError, match=r"reference .*map\.npz"):
            loaded(path, 0)
        loaded.cache_clear()
    assert not OPENED.exists()


@settings(max_examples=60)
@given(at=SHARE, new=st.binary(max_size=30), length=st.integers(1, 60))
def test_a_map_with_other_bytes_is_refused_or_the_same(tmp_path_factory, at, new, length):
    path = tmp_path_factory.mktemp("map") / "map.npz"
    np.savez(path, t=1.0, rho=np.ones((4, 4)))
    content = path.read_bytes()
    k = int(at * len(content))
    path.write_bytes(content[:k] + new + content[k + length :])
    try:
        assert loaded(path, 0)["t"] == 1.0
    except InputError as error:
        assert "map.npz" in str(error)


def test_no_file_of_the_package_unpickles():
    """np.load is told so in words, since its default has been another; nothing else that reads pickles is there."""
    for path in Path(taichi_spmhd.__file__).parent.rglob("*.py"):
        text = path.read_text()
        assert text.count("np.load(") == text.count("allow_pickle=False"), path
        assert not any(word in text for word in ("import pickle", "import shelve", "import marshal", "joblib")), path


@settings(max_examples=40)
@given(at=SHARE, new=st.binary(max_size=20), length=st.integers(1, 60))
def test_a_damaged_frame_is_named_or_makes_a_film(tmp_path_factory, at, new, length):
    folder = tmp_path_factory.mktemp("film")
    write_png(folder / "0000.png", np.random.default_rng(0).integers(0, 255, (24, 24, 3), np.uint8))
    content = (folder / "0000.png").read_bytes()
    k = int(at * len(content))
    (folder / "0001.png").write_bytes(content[:k] + new + content[k + length :])
    try:
        write_gif(folder / "film.gif", [folder / "0000.png", folder / "0001.png"])
    except InputError as error:
        assert "0001.png cannot be read" in str(error) or "frame 1 is" in str(error)
