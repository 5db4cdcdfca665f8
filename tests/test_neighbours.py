"""The neighbour list against all pairs: periodic, open and walls, any ratio of h, small boxes, overflow, reuse."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from conftest import disordered_scene
from test_terms import cubic

from taichi_spmhd.boundary import Boundary, Open, Periodic, Reflecting
from taichi_spmhd.density import SumMass
from taichi_spmhd.errors import InputError
from taichi_spmhd.kernels import CubicSpline
from taichi_spmhd.lattice import cubic as cubic_lattice
from taichi_spmhd.lattice import jitter, line, square
from taichi_spmhd.library import load_scene
from taichi_spmhd.neighbours import Neighbours
from taichi_spmhd.runtime import ti
from taichi_spmhd.scene import Scene
from taichi_spmhd.search import IMAGE, LANES
from taichi_spmhd.terms import Induction, Pressure, Stress

SUPPORT = 2.0  # of the cubic spline, in h


def gas(x):
    return {"mass": 1.0 / len(x), "P": 1.0}


def scene(x, box, *axes, **changes):
    boundary = Boundary(**dict(zip("xyz", axes, strict=False)))
    exact = SumMass(tolerance=1e-14)  # so that rho is the sum to round-off
    made = {"start": gas, "terms": (Pressure(),), "boundary": boundary, "density": exact}
    return Scene(**{"box": box, "positions": x, **made, **changes})


def rows(sim):
    """What the sums go through, as sorted tuples (particle, image code), by memory index."""
    near, count = sim.neighbours.near.to_numpy(), sim.neighbours.rows.to_numpy()
    return [
        sorted((int(e) & (2**IMAGE - 1), int(e) >> IMAGE) for e in row[:n] if e != len(sim))
        for row, n in zip(near, count, strict=True)
    ]


def images(sim):
    """Shifts and mirrors that can bring a particle near another: (code, function of x)."""
    box, boundary = sim.scene.box, sim.scene.boundary
    out = [(0, lambda x: x)]
    for image in boundary.images:
        walls = [(a, box.lo[a] if side == 1 else box.hi[a]) for a, side in enumerate(image) if side]
        code = sum(side << 2 * a for a, side in enumerate(image))
        out.append((code - 64 if code >= 32 else code, lambda x, walls=walls: mirrored(x, walls)))
    return out


def mirrored(x, walls):
    x = x.copy()
    for a, wall in walls:
        x[:, a] = 2 * wall - x[:, a]
    return x


def distances(sim, x, copies):
    """|x_i - copy_j| through the periodic axes."""
    apart = x[:, None] - copies[None]
    for a in range(sim.dim):
        if sim.scene.boundary.periodic[a]:
            apart[..., a] -= sim.scene.box.size[a] * np.round(apart[..., a] / sim.scene.box.size[a])
    return np.linalg.norm(apart, axis=-1)


def assert_complete(sim):
    """Every pair within either support is listed once; nothing beyond the padded radius is."""
    table, _ = sim.particles.table()
    c = {name: table[:, first : first + kind] for name, kind, first in sim.particles.layout}
    lists = rows(sim)
    for row in lists:
        assert len(set(row)) == len(row), "a neighbour is listed twice"
    h, h0 = c["h"].max(1), c["h0"].max(1)
    for code, image in images(sim):
        listed = np.zeros((len(sim), len(sim)), bool)
        for n, row in enumerate(lists):
            listed[n, [j for j, its in row if its == code]] = True
        needed = distances(sim, c["x"], image(c["x"])) < SUPPORT * np.maximum(h[:, None], h)
        r0, reach = distances(sim, c["x0"], image(c["x0"])), sim.neighbours.pad * SUPPORT * np.maximum(h0[:, None], h0)
        assert not (needed & ~listed).any(), "a neighbour is lost"
        assert not (listed & (r0 > reach * 1.001)).any(), "no neighbour at all is listed"


def assert_summed(sim):
    """rho is the sum over all particles and images with the particle's own h, to 1e-12 (round-off of the sum)."""
    table, _ = sim.particles.table()
    c = {name: table[:, first : first + kind] for name, kind, first in sim.particles.layout}
    r = [distances(sim, c["x"], image(c["x"])) for _, image in images(sim)]
    norm = CubicSpline().at(sim.dim).sigma * 7 * np.pi / 10  # cubic() carries the norm of 2-D
    rho = sum((c["m"].T * cubic(q / c["h"])[0]).sum(1) for q in r) * norm / c["h"][:, 0] ** sim.dim
    assert abs(c["rho"][:, 0] / rho - 1).max() < 1e-12


LATTICES = {1: (line, (1.0,), 40), 2: (square, (1.0, 0.7), 20), 3: (cubic_lattice, (1.0, 0.8, 0.9), 8)}
KINDS = {"periodic": Periodic(), "open": Open(), "walls": Reflecting()}


@pytest.mark.parametrize("dim, kind", list(product(LATTICES, KINDS)))
def test_the_list_holds_every_neighbour(simulate, dim, kind):
    make, box, nx = LATTICES[dim]
    x = jitter(make(box, nx), box, 0.2)
    axes = [KINDS[kind]] * dim if dim < 3 or kind != "walls" else [Periodic(), KINDS[kind], (Open(), KINDS[kind])]
    sim = simulate(scene(x, box, *axes))
    sim.begin()
    assert_complete(sim)
    assert_summed(sim)


def cloud(n):
    """Spacing proportional to the distance from the middle, from 0.01 to 0.45."""
    random = np.random.default_rng(4)
    r, angle = 0.45 * (0.02) ** random.uniform(size=n), 2 * np.pi * random.uniform(size=n)
    return 0.5 + r[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def test_smoothing_lengths_may_differ_by_thirty(simulate):
    """The start's density is wrong by a factor of 1000 in the middle: the list follows while h is being found."""
    sim = simulate(scene(cloud(700), (1.0, 1.0), Open(), Open()))
    h = sim["h"]
    assert h.max() / h.min() > 30
    assert_complete(sim)
    assert_summed(sim)


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_a_box_of_just_over_two_supports_is_enough(simulate, dim):
    make = (line, square, cubic_lattice)[dim - 1]
    side = 5 * np.ones(dim)  # spacings; two supports are 4.8
    sim = simulate(scene(make(side, 5), side, *[Periodic()] * dim))
    sim.begin()
    assert_complete(sim)
    assert_summed(sim)


def test_a_support_that_outgrows_half_the_box_is_an_error_and_not_a_lost_image(simulate):
    """All mass in one corner: the lonely particle's support would meet its neighbours twice."""
    x = np.concatenate([jitter(square((0.2, 0.2), 8), (0.2, 0.2), 0.1), [[0.6, 0.6]]])
    with pytest.raises(InputError, match="outgrown the box"):
        simulate(scene(x, (1.0, 1.0), Periodic(), Periodic())).begin()


def test_the_same_particles_in_another_order_give_the_same_physics(simulate):
    first = disordered_scene(Stress(), Induction())
    order = np.random.default_rng(7).permutation(len(first.positions))
    values = first.start(first.positions)
    shuffled = {name: value[order] if np.ndim(value) else value for name, value in values.items()}
    second = first.but(positions=first.positions[order], start=lambda _: shuffled)
    a, b = simulate(first), simulate(second)
    ours, theirs = {**a.columns(), **a.rates()}, {**b.columns(), **b.rates()}
    for name, values in ours.items():  # only the order of the sums differs
        assert abs(values[order] - theirs[name]).max() <= 1e-12 * abs(values).max(), name


def test_a_list_that_overflows_is_widened_and_drops_nobody(simulate):
    sim = simulate(scene(jitter(square((1.0, 1.0), 20), (1.0, 1.0), 0.2), (1.0, 1.0), Periodic(), Periodic()))
    sim.neighbours.width = LANES
    sim.neighbours.near = ti.ndarray(ti.i32, (len(sim), LANES))
    sim.begin()
    assert sim.neighbours.width > LANES
    assert_complete(sim)
    assert_summed(sim)


def test_no_neighbour_is_lost_while_the_list_is_kept(simulate):
    """Random displacements of up to 2 % of a spacing a step, most of them without a new list."""
    sim = simulate(scene(jitter(square((1.0, 1.0), 20), (1.0, 1.0), 0.1), (1.0, 1.0), Periodic(), Periodic()))
    sim.begin()
    random, begun, inner = np.random.default_rng(8), sim.neighbours.builds, 0
    first = sim.particles.first["x"]
    for k in range(40):
        table, ids = sim.particles.table()
        table[:, first : first + 2] += random.uniform(-0.001, 0.001, (len(sim), 2))
        sim.particles.admit(table, ids)
        sim.rhs.neighbourhood()
        assert_summed(sim)
        inner += sim.neighbours.rows is sim.neighbours.inner
        if k % 5 == 0:
            assert_complete(sim)
    assert 1 <= sim.neighbours.builds - begun <= 20, "the run must both keep lists and build some"
    assert 5 <= inner <= 35, "the run must both use whole rows and their beginnings only"


@pytest.mark.parametrize("name", ["blast", "alfven_3d"])
def test_the_beginnings_of_rows_are_all_that_counts(simulate, monkeypatch, name):
    """What lies beyond the inner ring adds zeros: 12 steps to 1e-11, since the order of sums follows a row's length."""
    made = replace(list(load_scene(name, nx=16).values())[-1], density=SumMass(tolerance=1e-14))
    sims, used = [simulate(made), simulate(made)], []
    plain = Neighbours.holds

    def whole(near):
        """As before, but all of every row."""
        held, used[:] = plain(near), [*used, near.rows is near.inner]
        near.rows = near.count if near is sims[1].neighbours else near.rows
        return held

    monkeypatch.setattr(Neighbours, "holds", whole)
    for sim in sims:
        for _ in range(12):
            sim.step()
    ours, theirs = (sim.columns() for sim in sims)
    assert all(abs(ours[key] - theirs[key]).max() <= 1e-11 * abs(theirs[key]).max() for key in ours)
    assert True in used and False in used


def test_in_a_fast_flow_a_list_serves_two_steps(simulate):
    """Mach 1 to 3 with shocks: 40 steps with 20 lists (measured); with a pad that is a little too small it were 40."""
    sim = simulate(load_scene("orszag_tang", nx=64)["with cleaning"])
    sim.run(until=0.4)
    begun = sim.neighbours.builds
    for _ in range(40):
        sim.step()
    assert 10 <= sim.neighbours.builds - begun <= 24
