"""Kernels that start at once (launching.py): results of Taichi's own way, which is taken where something changed."""

import gc
import time
import weakref

import numpy as np
import pytest

from taichi_spmhd import library
from taichi_spmhd.launching import Method
from taichi_spmhd.runtime import ti
from taichi_spmhd.simulation import Simulation
from taichi_spmhd.wide import whole


@ti.data_oriented
class Sums:
    """Kernels with every kind of argument the package uses."""

    @ti.kernel
    def add(self, out: ti.types.ndarray(dtype=ti.i32, ndim=1), n: ti.i32):
        for k in range(n):
            out[k] += 1

    @ti.kernel
    def scaled(self, table: ti.types.ndarray(ndim=2), factor: float, twice: ti.template()) -> float:
        total = 0.0
        for k in range(table.shape[0]):
            table[k, 0] *= factor
            total += table[k, 0]
        if ti.static(twice):
            total *= 2.0
        return total

    @ti.kernel
    def both(self, a: float) -> ti.types.vector(2, ti.f32):
        return ti.Vector([ti.cast(a, ti.f32), ti.cast(2.0 * a, ti.f32)])

    @ti.kernel
    def nothing(self):
        pass


def test_arrays_may_be_exchanged_and_numbers_differ():
    sums, first, second = Sums(), ti.ndarray(ti.i32, 8), ti.ndarray(ti.i32, 4)
    for n in (8, 4, 2):
        sums.add(first, n)
    for n in (4, 1):
        sums.add(second, n)
    sums.add(first, 1)
    assert first.to_numpy().tolist() == [4, 3, 2, 2, 1, 1, 1, 1]
    assert second.to_numpy().tolist() == [2, 1, 1, 1]


def test_numpy_arrays_of_any_size_and_type_and_what_is_compiled_in():
    sums = Sums()
    for size in (3, 3, 5):
        table = np.ones((size, 1))
        assert sums.scaled(table, 2.0, False) == 2.0 * size
        assert (table == 2).all()
    assert sums.scaled(np.ones((3, 1)), 2, False) == 6.0  # a whole number is a number
    assert sums.scaled(np.ones((3, 1)), 2.0, True) == 12.0
    single = np.ones((3, 1), np.float32)
    assert sums.scaled(single, 3.0, True) == 18.0 and single.dtype == np.float32 and (single == 3).all()
    apart = np.ones((3, 2))[:, :1]
    with pytest.raises(ValueError, match="contiguous"):
        sums.scaled(apart, 2.0, True)


def test_vectors_come_back():
    sums = Sums()
    assert [[float(c) for c in sums.both(a)] for a in (1.0, 2.5)] == [[1.0, 2.0], [2.5, 5.0]]


def test_two_objects_do_not_meet_and_an_object_is_let_go():
    one, other = Sums(), Sums()
    mine, yours = ti.ndarray(ti.i32, 2), ti.ndarray(ti.i32, 2)
    for _ in range(3):
        one.add(mine, 2)
        other.add(yours, 1)
    assert mine.to_numpy().tolist() == [3, 3] and yours.to_numpy().tolist() == [3, 0]
    watched = weakref.ref(one)
    del one
    gc.collect()
    assert watched() is None


def test_a_wrong_argument_is_refused_at_every_call():
    sums, out = Sums(), ti.ndarray(ti.i32, 2)
    sums.add(out, 1)
    for wrong in ("1", None, 1.5):
        with pytest.raises(Exception, match=r"(?i)argument|type"):
            sums.add(out, wrong)
    for count in ((out,), (out, 1, 2)):
        with pytest.raises(Exception, match=r"(?i)argument|missing"):
            sums.add(*count)


def taichis_own_way(self, owner, *given):
    """A kernel of a class, called as Taichi does it."""
    with whole(self.kernel):
        return self.kernel(owner, *given)


def test_a_run_has_the_bits_of_one_that_goes_taichis_own_way(monkeypatch):
    scene = library.load_scene("sod", nx=225)["sod"]
    with Simulation(scene) as sim:
        for _ in range(12):
            sim.step()
        quick = sim.columns()
    monkeypatch.setattr(Method, "__call__", taichis_own_way)
    with Simulation(scene) as sim:
        for _ in range(12):
            sim.step()
        assert all((quick[name] == values).all() for name, values in sim.columns().items())


def test_a_start_is_quicker_than_taichis():
    """An empty kernel, the best of 5 times 100 calls each way: measured 4 to 6 times quicker."""
    sums = Sums()
    sums.nothing()
    kernel = vars(Sums)["nothing"].kernel
    ways = {"quick": sums.nothing, "taichi": lambda: kernel(sums)}
    best = {name: min(seconds(way) for _ in range(5)) for name, way in ways.items()}
    assert best["quick"] < 0.7 * best["taichi"]


def seconds(call) -> float:
    """Of 100 calls."""
    clock = time.perf_counter()
    for _ in range(100):
        call()
    return time.perf_counter() - clock
