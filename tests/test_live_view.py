"""What a live run draws: the field as pixels, field lines from the vector potential."""

from dataclasses import replace

import numpy as np
import pytest

from taichi_spmhd import Picture, Simulation, exact, load_scene
from taichi_spmhd.live import view
from taichi_spmhd.live.lines import draw_lines, filled, potential, solved

SIZE = (160, 160)
B0 = 1 / np.sqrt(4 * np.pi)  # of the vortex


@pytest.fixture(scope="module")
def vortex():
    with Simulation(load_scene("orszag_tang", nx=32)["with cleaning"], spare=()) as sim:
        sim.begin()
        yield sim


def middles(n: int) -> np.ndarray:
    return (np.arange(n) + 0.5) / n


def test_the_potential_is_the_vortex_own(vortex):
    A = potential(vortex, vortex.columns(), 64)
    x, y = np.meshgrid(middles(64), middles(64))
    truth = B0 * (np.cos(4 * np.pi * x) / (4 * np.pi) + np.cos(2 * np.pi * y) / (2 * np.pi))
    # 32 particles a side shared among cells half as wide: an error of second order; measured 0.6 % of the range
    assert np.abs(A - A.mean() - truth).max() < 0.02 * np.ptp(truth)


@pytest.mark.parametrize("periodic", [(True, True), (True, False), (False, True), (False, False)])
def test_the_curl_of_the_potential_is_the_field(periodic):
    """B from any A_z, with or without periods, comes back from the A_z found for it; the mean field too."""
    n = 96
    x, y = np.meshgrid(middles(n), middles(n), indexing="ij")
    wave = [(lambda u: np.cos(2 * np.pi * u), lambda u: -2 * np.pi * np.sin(2 * np.pi * u)) if wraps
            else (lambda u: np.cos(np.pi * u), lambda u: -np.pi * np.sin(np.pi * u)) for wraps in periodic]  # fmt: skip
    (f, df), (g, dg) = wave
    A = f(x) * g(y) + 0.3 * y + 0.2 * x
    found = solved([f(x) * dg(y) + 0.3, -df(x) * g(y) - 0.2], (1.0, 1.0), periodic).T
    # exact for periods; a mirrored field is only smooth to first order at the edge: measured 0.3 %
    assert np.abs((found - found.mean()) - (A - A.mean())).max() < 0.01 * np.ptp(A)


@pytest.mark.parametrize("periodic", [True, False])
def test_holes_are_filled_from_across_an_edge_only_where_there_is_a_period(periodic):
    """A hole at the left edge: 1 to its right, 5 at the right edge."""
    value = np.ones((8, 8))
    value[-1] = 5.0
    below = np.ones((8, 8))
    below[0] = 0.0  # the whole column of cells: only its right side and, across a period, the right edge are near
    made = filled(value * below, below, (periodic, True))
    assert made[0] == pytest.approx((1.0 + 5.0) / 2 if periodic else 1.0)
    assert np.array_equal(made[1:], value[1:])


def test_lines_run_along_the_field(vortex):
    A = potential(vortex, vortex.columns(), 64)
    dark = np.zeros((256, 256, 3), np.uint8)
    lit = draw_lines(dark, A)[..., 0] > 60
    assert 0.03 < lit.mean() < 0.4
    # along x = 1/8 and x = 3/8 the field of the vortex has B_y = 0 nowhere but at nodes; the lines are level sets:
    # the potential under lit pixels is near one of the levels, that of dark ones mostly is not
    turns = (A - A.min()) * 18 / np.ptp(A)
    apart = np.abs(turns - np.round(turns))
    under = lit[::-1].reshape(64, 4, 64, 4).mean(axis=(1, 3))
    assert apart[under > 0.4].mean() < 0.6 * apart[under == 0].mean()


def test_lines_are_seen_on_white_and_on_black(vortex):
    A = potential(vortex, vortex.columns(), 64)
    black, white = (np.full((256, 256, 3), tone, np.uint8) for tone in (0, 255))
    lit, dimmed = draw_lines(black, A).astype(int), 255 - draw_lines(white, A).astype(int)
    assert np.abs(lit - dimmed).max() <= 1  # the same lines, to the rounding of a tone
    assert lit.max() > 100 and not black.any() and white.all()  # the pictures given stay as they are


def test_a_field_out_of_the_plane_has_no_lines():
    (scene,) = load_scene("blast", nx=24).values()
    with Simulation(scene, spare=()) as sim:
        sim.begin()
        assert potential(sim, sim.columns()) is None
        rgb = view.image(sim, scene.picture, (0.0, 1.0), SIZE, lines=True)
        assert rgb.shape == (160, 160, 3)


@pytest.mark.parametrize("draw", ["particles", "nearest", "sph"])
def test_pictures_have_the_size_asked_for_and_show_the_field(vortex, draw):
    picture = Picture("B", axis=1, draw=draw)
    limits = view.limits([vortex], picture)
    assert limits[0] == -limits[1] and limits[1] == pytest.approx(B0, rel=0.05)
    rgb = view.image(vortex, picture, limits, SIZE).astype(int)
    assert rgb.shape == (160, 160, 3) and rgb.dtype == int
    # B_y = B0 sin 4 pi x: red where positive, blue where negative
    red = (rgb[..., 0] - rgb[..., 2]).mean(axis=0)
    assert red[15:25].mean() > 50 and red[55:65].mean() < -50


def test_what_can_be_drawn_is_listed_and_drawn(vortex):
    names = {entry["name"]: entry["components"] for entry in view.names(vortex)}
    assert names["rho"] == 1 and names["B"] == 3 and {"div_B", "gap", "psi", "P"} <= set(names)
    assert not {"id", "x0", "hinv", "g"} & set(names)
    for name, components in names.items():
        picture = Picture(name, axis=0 if components > 1 else None)
        limits = view.limits([vortex], picture)
        assert limits[0] < limits[1]
        assert view.image(vortex, picture, limits, (64, 64)).shape == (64, 64, 3)


def test_a_profile_shows_the_exact_curve():
    (scene,) = load_scene("sound_wave", nx=32).values()
    with Simulation(scene, spare=()) as sim:
        sim.begin()
        limits = view.limits([sim], scene.picture)
        shown = view.image(sim, scene.picture, limits, (200, 100))
        bare = view.image(sim, Picture("h"), view.limits([sim], Picture("h")), (200, 100))
    curve = [120, 190, 255]
    assert (shown == curve).all(axis=2).sum() > 100 and not (bare == curve).all(axis=2).any()
    assert exact  # the curve is the scene's own


def test_the_bits_of_the_run_are_not_touched(vortex):
    before = {name: values.copy() for name, values in vortex.columns().items()}
    view.image(vortex, replace(vortex.scene.picture, member="gap"), (0.0, 1.2), SIZE, lines=True)
    assert all(np.array_equal(before[name], vortex[name]) for name in before)
