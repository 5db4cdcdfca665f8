"""Lattices: they tile the periodic box, keep off its edges, and carry the density they are asked for."""

from math import sqrt

import numpy as np
import pytest

from taichi_spmhd import (
    close_packed,
    cubic,
    displaced,
    hexagonal,
    jitter,
    line,
    spacing,
    square,
    step_lattice,
)
from taichi_spmhd.box import as_box
from taichi_spmhd.errors import InputError

# one awkward box per lattice: nothing fits without stretching
LATTICES = {
    "line": (line, ((-0.3, 1.1),), 7),
    "square": (square, ((-0.5, 0.5), (0.0, 0.73)), 10),
    "cubic": (cubic, (1.0, 0.61, (-1.0, 0.3)), 6),
    "hexagonal": (hexagonal, (2 / sqrt(3), 2.0), 16),
    "close_packed": (close_packed, ((-1.5, 1.5), (-0.75, 0.75), (-0.75, 0.75)), 12),
}
every_lattice = pytest.mark.parametrize("lattice, box, nx", LATTICES.values(), ids=LATTICES)


def neighbour_distances(x, box):
    """Distances of all pairs through the periodic box, shape (N, N), infinite on the diagonal."""
    size = np.array(as_box(box).size)
    apart = x[:, None] - x[None]
    apart -= size * np.round(apart / size)
    return np.linalg.norm(apart, axis=-1) + np.diag(np.full(len(x), np.inf))


@every_lattice
def test_lies_strictly_inside_the_box(lattice, box, nx):
    x, region = lattice(box, nx), as_box(box)
    assert x.shape[1] == region.dim
    assert np.all(x > region.lo)
    assert np.all(x < region.hi)


@every_lattice
def test_every_particle_sees_the_same_neighbours_through_the_periodic_edges(lattice, box, nx):
    distances = np.sort(neighbour_distances(lattice(box, nx), box), axis=1)[:, : min(12, nx - 1)]
    assert np.max(np.ptp(distances, axis=0)) < 1e-12  # round-off of coordinates of order 1


@every_lattice
def test_nearest_neighbours_are_about_a_spacing_apart(lattice, box, nx):
    x = lattice(box, nx)
    gap = np.min(neighbour_distances(x, box)) / spacing(box, len(x))
    assert 0.8 < gap < 1.16  # unstretched: 1 (cubic), 1.075 (hexagonal), 1.122 (close packed); these boxes stretch 20 %


def test_unstretched_hexagons_have_six_neighbours_at_dx():
    box = (1.0, sqrt(3) / 2 * 8 / 10)  # eight rows of ten fit exactly
    distances = neighbour_distances(hexagonal(box, 10), box)
    assert np.all(np.sum(np.abs(distances - 0.1) < 1e-12, axis=1) == 6)


def test_unstretched_close_packing_has_twelve_neighbours_at_dx():
    box = (1.0, sqrt(3 / 4) * 4 / 5, sqrt(2 / 3) * 4 / 5)  # four rows and four layers of dx = 1/5
    distances = neighbour_distances(close_packed(box, 5), box)
    assert np.all(np.sum(np.abs(distances - 0.2) < 1e-12, axis=1) == 12)


@pytest.mark.parametrize("nx", [1, 2, 3, 16, 33])
def test_hexagonal_rows_are_even_in_number_and_nx_long(nx):
    rows = len(hexagonal((2 / sqrt(3), 2.0), nx)) / nx
    assert rows % 2 == 0
    # the even number next to the ideal one: at most one row off, and never fewer than two
    assert abs(rows - 2.0 / (sqrt(3) / 2 * 2 / sqrt(3) / nx)) <= 1


def test_spacing_is_the_root_of_the_volume_of_one_particle():
    assert spacing((2.0, 4.0, 1.0), 64) == pytest.approx(0.5, rel=1e-15)


def test_jitter_is_reproducible_wrapped_and_of_the_size_asked_for():
    box = ((-1.0, 1.0), (0.0, 1.0))
    x = square(box, 64)
    moved = jitter(x, box, 0.1, seed=3)
    assert np.array_equal(moved, jitter(x, box, 0.1, seed=3))
    assert not np.array_equal(moved, jitter(x, box, 0.1, seed=4))
    assert np.all((moved >= [-1, 0]) & (moved < [1, 1]))
    step = moved - x
    step -= np.array([2.0, 1.0]) * np.round(step / [2.0, 1.0])
    assert np.std(step) == pytest.approx(0.1 * spacing(box, len(x)), rel=0.05)  # 4096 draws: s.d. known to 1.1 %


def test_jitter_of_amplitude_zero_moves_nothing():
    x = line((1.0,), 100)
    assert np.max(np.abs(jitter(x, (1.0,), 0.0) - x)) < 1e-15


@pytest.mark.parametrize("amplitude", [1e-4, 0.9])
def test_displaced_particles_share_the_cumulative_mass_equally(amplitude):
    n, k = 64, 2 * np.pi
    x = displaced(line((1.0,), n), (1.0,), lambda x: 1 + amplitude * np.sin(k * x))[:, 0]
    mass = x + amplitude * (1 - np.cos(k * x)) / k
    assert np.max(np.abs(mass - (np.arange(n) + 0.5) / n)) < 2e-15  # a few units of round-off


def test_displaced_moves_whole_columns_along_the_axis_named():
    box = ((-1.0, 1.0), (2.0, 3.0))
    x = hexagonal(box, 12)
    moved = displaced(x, box, lambda y: 2 + np.cos(2 * np.pi * y), axis=1)
    assert np.array_equal(moved[:, 0], x[:, 0])
    assert len(np.unique(moved[:, 1])) == len(np.unique(x[:, 1]))
    assert np.max(np.abs(moved[:, 1] - x[:, 1])) > 0.01  # the largest displacement of this profile is 0.08


def test_displaced_by_a_constant_density_stays_where_it_was():
    x = cubic((1.0, 1.0, 1.0), 6)
    assert np.max(np.abs(displaced(x, (1.0, 1.0, 1.0), lambda z: 0 * z + 7, axis=2) - x)) < 1e-15


def test_shock_tube_on_a_line_has_spacings_in_the_ratio_of_the_densities():
    x, mass, box = step_lattice((-0.5, 0.5), 450, (1.0, 0.125))
    assert (len(x), box.lo, box.hi) == (450, (-0.5,), (0.5,))  # 400 + 50 particles tile Sod's tube exactly
    gaps = np.diff(x[:, 0])
    assert gaps[:399] == pytest.approx(mass / 1.0, rel=1e-10)
    assert gaps[400:] == pytest.approx(mass / 0.125, rel=1e-10)


@pytest.mark.parametrize("rho", [(1.0, 0.125), (0.125, 1.0), (1.08, 1.0), (1.0, 1.0)])
@pytest.mark.parametrize("rows", [None, 24])
def test_both_sides_of_a_shock_tube_carry_their_density_with_equal_masses(rho, rows):
    x, mass, box = step_lattice((-0.5, 0.5), 200, rho, rows)
    height = box.size[1] if rows else 1.0
    for side, wanted, length in zip((x[:, 0] < 0, x[:, 0] > 0), rho, (-box.lo[0], box.hi[0]), strict=True):
        assert np.sum(side) * mass / (length * height) == pytest.approx(wanted, rel=1e-12)  # exact but for round-off
    assert np.all((x > box.lo) & (x < box.hi))
    assert box.lo[0] <= -0.5 + 1e-12
    assert box.hi[0] >= 0.5 - 1e-12


@pytest.mark.parametrize("rho", [(1.0, 0.125), (0.5, 1.0)])
def test_both_lattices_of_a_strip_close_across_its_height(rho):
    x, _, box = step_lattice((-0.5, 0.5), 100, rho, rows=16)
    for side in (x[x[:, 0] < 0], x[x[:, 0] > 0]):
        inner = np.abs(np.abs(side[:, 0]) - 0.25) < 0.1  # away from the step and the ends
        nearest = np.sort(neighbour_distances(side, ((-9.0, 9.0), box.size[1])), axis=1)[inner, :6]
        assert np.max(np.ptp(nearest, axis=0)) < 1e-12  # round-off: the same six neighbours also across the edge


def test_a_step_without_a_step_is_the_uniform_hexagonal_lattice():
    x, _, box = step_lattice((-0.5, 0.5), 20, (1.0, 1.0), rows=4)
    order = np.lexsort(np.round(x, 9).T)
    plain = hexagonal(box, 20)
    assert np.allclose(x[order], plain[np.lexsort(np.round(plain, 9).T)], rtol=0, atol=1e-14)  # round-off


WRONG = {
    "nx = 0": (lambda: hexagonal((1.0, 1.0), 0), "whole number of at least 1"),
    "nx = 2.5": (lambda: line((1.0,), 2.5), "whole number"),
    "nx = True": (lambda: line((1.0,), True), "whole number"),
    "hexagons in a 3-D box": (lambda: hexagonal((1.0, 1.0, 1.0), 4), "use close_packed or cubic"),
    "close packing in the plane": (lambda: close_packed((1.0, 1.0), 4), "use hexagonal or square"),
    "a box turned inside out": (lambda: line(((1.0, 0.0),), 4), "positive lengths"),
    "negative jitter": (lambda: jitter(line((1.0,), 4), (1.0,), -0.1), "give a number >= 0"),
    "positions of another dimension": (lambda: jitter(np.zeros((4, 2)), (1.0,), 0.1), r"give an array \(N, 1\)"),
    "density below zero": (lambda: displaced(line((1.0,), 4), (1.0,), lambda x: x - 0.5), "positive and finite"),
    "an axis that is not there": (
        lambda: displaced(line((1.0,), 4), (1.0,), np.exp, axis=1),
        "axis = 1: give one of 0",
    ),
    "odd rows": (lambda: step_lattice((-0.5, 0.5), 100, (1.0, 0.1), rows=7), "even number"),
    "a step outside": (lambda: step_lattice((0.0, 1.0), 100, (1.0, 0.1)), "move it inside"),
    "vacuum on one side": (lambda: step_lattice((-0.5, 0.5), 100, (1.0, 0.0)), "two positive densities"),
}


@pytest.mark.parametrize("call, cure", WRONG.values(), ids=WRONG)
def test_wrong_input_is_refused_in_one_line_with_the_cure(call, cure):
    with pytest.raises(InputError, match=cure) as caught:
        call()
    assert "\n" not in str(caught.value)
