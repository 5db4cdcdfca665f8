"""Pictures: pixels against brute force, frames as people see them, films within their limits."""

import sys

import numpy as np
import pytest
from PIL import Image

from taichi_spmhd import runtime
from taichi_spmhd.box import Box
from taichi_spmhd.errors import InputError
from taichi_spmhd.picture import Picture
from taichi_spmhd.terms import Pressure

UNIT = Box((0.0, 0.0), (1.0, 1.0))
ALFVEN = Box((0.0, 0.0), (2 / np.sqrt(3), 2.0))
BOTH = (True, True)
RED = (255, 0, 0)


@pytest.fixture(scope="module", autouse=True)
def taichi():
    runtime.init(arch="cpu", precision="f64", threads=2)


def scattered(n=150, seed=1):
    """Random positions (n, 2) in the unit box."""
    return np.random.default_rng(seed).random((n, 2))


def middles(width):
    """Middles of the pixels of the unit box, (width, width, 2), first row on top."""
    at = (np.arange(width) + 0.5) / width
    return np.stack(np.meshgrid(at, at[::-1]), axis=-1)


def separation(pixels, x, periodic):
    """Vectors (H, W, N, 2) from particles to pixels, to the nearest image if periodic."""
    apart = pixels[:, :, None] - x
    return apart - np.rint(apart) if periodic else apart


def hexagonal(nx=32, ny=64):
    """Hexagonal lattice (nx ny, 2) that fills the Alfven box."""
    i, j = np.meshgrid(np.arange(nx), np.arange(ny))
    rows = np.stack([(i + 0.25 + 0.5 * (j % 2)) / nx, (j + 0.5) / ny], axis=-1)
    return rows.reshape(-1, 2) * ALFVEN.size


def column(x, values, spacing, **more):
    """What Panels.frame takes, for equal particles."""
    same = np.full(len(x), spacing)
    return {"x": x, "values": values, "h": 1.2 * same, "spacing": same, "gaps": np.full(len(x), 1.07)} | more


def dark_share(rgb):
    """Fraction of pixels that show the background."""
    from taichi_spmhd.render.colours import BACKGROUND

    return float((np.abs(rgb.astype(int) - BACKGROUND).max(axis=2) < 12).mean())


class Fake:
    """As much of a Simulation as pictures need."""

    time, dim = 0.5, 2

    def __init__(self, x):
        from types import SimpleNamespace

        one = np.ones(len(x))
        self.members = {"x": x, "rho": one, "m": one / len(x), "h": 1.2 * one / len(x) ** 0.5}
        self.members["B"] = np.column_stack([3 * one, 4 * one, x[:, 0]])
        self.scene = SimpleNamespace(box=UNIT, boundary=SimpleNamespace(periodic=BOTH))

    def __getitem__(self, name):
        return self.members[name]


@pytest.mark.parametrize("periodic", [False, True])
def test_nearest_colours_each_pixel_by_its_nearest_particle(periodic):
    from taichi_spmhd.render.binning import place
    from taichi_spmhd.render.pixels import draw_nearest

    x, width = scattered(), 96
    number = np.arange(len(x))
    colour = np.stack([number, 0 * number, 0 * number], axis=1).astype(np.uint8)
    rgb = draw_nearest(place(UNIT, x, (width, width), BOTH), colour, (width, width), (periodic, periodic))
    distance = np.linalg.norm(separation(middles(width), x, periodic), axis=-1)
    # the drawn particle may differ from the nearest one only where both are equally far, to f32 rounding of pixels
    drawn = np.take_along_axis(distance, rgb[..., :1].astype(int), axis=2)[..., 0]
    assert np.all(drawn <= distance.min(axis=2) + 1e-6)


def test_nearest_finds_the_only_particle_from_far_away():
    from taichi_spmhd.render import draw
    from taichi_spmhd.render.colours import palette

    crowd = np.concatenate([np.full((500, 2), 0.02) + 0.01 * scattered(500), [[0.9, 0.9]]])
    values = np.append(np.zeros(500), 1.0)
    rgb = draw("nearest", UNIT, crowd, values, np.full(501, 0.05), (64, 64), palette("viridis"), (0, 1))
    assert tuple(rgb[0, 63]) == tuple(palette("viridis")[255])
    assert tuple(rgb[63, 0]) == tuple(palette("viridis")[0])


def sph_by_hand(x, values, h, volume, width, periodic):
    """Normalised interpolation (width, width) with the cubic spline, every particle at every pixel."""
    q = np.linalg.norm(separation(middles(width), x, periodic), axis=-1) / h
    weight = volume / h**2 * (np.clip(2 - q, 0, None) ** 3 / 4 - np.clip(1 - q, 0, None) ** 3)
    with np.errstate(invalid="ignore"):
        return (weight * values).sum(axis=2) / weight.sum(axis=2), weight.sum(axis=2)


@pytest.mark.parametrize("periodic", [False, True])
def test_sph_loses_no_particle_when_h_varies_tenfold(periodic):
    from taichi_spmhd.render.binning import place
    from taichi_spmhd.render.pixels import interpolate

    x, width = scattered(400), 64
    h = 0.02 * 10 ** scattered(400, seed=2)[:, 0]
    values = np.sin(9 * x[:, 0]) + x[:, 1]
    places = place(UNIT, x, (width, width), (periodic, periodic))
    field = interpolate(places, values, h * width, h**2, 2, (width, width), (periodic, periodic))
    exact, weight = sph_by_hand(x, values, h, h**2, width, periodic)
    # where only the last wisp of a kernel reaches, f32 rounding decides; 1e-4 of a typical weight is far above it
    inside = weight > 1e-4
    assert inside.mean() > 0.9
    assert np.abs(field - exact)[inside].max() < 1e-3


def test_sph_interpolates_a_linear_field():
    from taichi_spmhd.render.binning import place
    from taichi_spmhd.render.pixels import interpolate

    n, width = 32, 80
    x = middles(n).reshape(-1, 2)
    places, h, same = place(UNIT, x, (width, width), BOTH), np.full(n * n, 1.2 / n * width), np.ones(n * n)
    field = interpolate(places, x[:, 0], h, same, 2, (width, width))
    inner = slice(10, -10)  # two kernels from the edges, where the sums are symmetric
    # normalised interpolation on a lattice is not exact for linear fields: a few per cent of a spacing at h = 1.2
    assert np.abs(field - middles(width)[..., 0])[inner, inner].max() < 0.05 / n


def test_discs_show_periodic_images_only_along_periodic_axes():
    from taichi_spmhd.render.pixels import draw_discs

    corner = np.array([[0.0, 0.0, 0.0]])
    colour = np.array([RED], np.uint8)
    for periodic, expected in (((True, True), 4), ((True, False), 2), ((False, False), 1)):
        rgb = draw_discs(corner, colour, np.array([8.0]), (60, 40), periodic)
        corners = [tuple(rgb[row, col]) == RED for row in (0, -1) for col in (0, -1)]
        assert sum(corners) == expected


def test_a_disc_has_its_area():
    from taichi_spmhd.render.pixels import draw_discs

    rgb = draw_discs(np.array([[30.3, 29.6, 0.0]]), np.array([RED], np.uint8), np.array([12.0]), (60, 60))
    covered = (rgb[..., 1] < 9).sum()  # green falls from 17 to 0 under a red disc; half covered counts
    assert covered == pytest.approx(np.pi * 144, rel=0.03)


@pytest.mark.parametrize("kind", ["particles", "nearest", "sph"])
def test_pictures_have_the_same_bits_twice(kind):
    from taichi_spmhd.render import draw
    from taichi_spmhd.render.colours import palette

    x = scattered(900)
    same = np.full(900, 1 / 30)

    def picture():
        return draw(kind, UNIT, x, x[:, 0], 1.2 * same, (120, 120), palette("viridis"), (0, 1), spacing=same,
                    periodic=BOTH)  # fmt: skip

    assert np.array_equal(picture(), picture())


@pytest.mark.parametrize("kind", ["particles", "nearest", "sph"])
def test_a_cube_is_cut_at_its_middle(kind):
    from taichi_spmhd.render import draw
    from taichi_spmhd.render.colours import palette

    at = (np.arange(9) + 0.5) / 9
    x = np.stack(np.meshgrid(at, at, at), axis=-1).reshape(-1, 3)
    same = np.full(len(x), 1 / 9)
    inside = np.abs(x[:, 2] - 0.5) < 0.01  # the layer on the plane carries 1, the others -1
    rgb = draw(kind, Box((0, 0, 0), (1, 1, 1)), x, np.where(inside, 1.0, -1.0), 0.6 * same, (90, 90),
               palette("RdBu_r"), (-1, 1), spacing=same, periodic=(True, True, True))  # fmt: skip
    centre = rgb[45, 45].astype(int)
    assert centre[0] > 90 > centre[2]  # red, the colour of +1


def test_lattice_is_nearly_covered_and_sheets_leave_dark_gaps():
    from taichi_spmhd.render import draw
    from taichi_spmhd.render.colours import palette

    x = hexagonal()
    spacing = np.full(len(x), np.sqrt(ALFVEN.volume / len(x)))
    sheets = x.copy()
    row = np.rint(x[:, 1] / ALFVEN.size[1] * 64 - 0.5)
    sheets[:, 1] -= np.where(row % 2 == 1, 0.9, 0.0) * ALFVEN.size[1] / 64  # pairs of rows fall together

    def share(positions):
        rgb = draw("particles", ALFVEN, positions, x[:, 0], spacing, (320, 554), palette("RdBu_r"), (0, 1.2),
                   spacing=spacing, periodic=BOTH)  # fmt: skip
        return dark_share(rgb)

    assert share(x) < 0.05  # discs of 0.57 spacings touch on the lattice: only the corners between three stay
    assert share(sheets) > 0.25  # sheets two rows apart, each little wider than a disc: a third is bare


def test_a_blown_up_particle_does_not_stop_the_picture():
    from taichi_spmhd.render import draw
    from taichi_spmhd.render.colours import BROKEN, palette

    x = scattered(100)
    x[0], x[1] = np.nan, 1e30
    values = np.where(np.arange(100) == 2, np.nan, 1.0)
    for kind in ("particles", "nearest", "sph"):
        draw(kind, UNIT, x, values, np.full(100, 0.1), (50, 50), palette("viridis"), (0, 1))
    rgb = draw("nearest", UNIT, x, values, np.full(100, 0.1), (200, 200), palette("viridis"), (0, 1))
    assert (rgb == BROKEN).all(axis=2).any()


def test_frames_have_even_sizes_and_keep_their_limits():
    from taichi_spmhd.render import Panels

    x = hexagonal(8, 16)
    for count, width in ((1, 401), (2, 777), (3, 1200), (5, 901)):
        labels = [f"variant {n}" for n in range(count)]
        panels = Panels(labels, ALFVEN, Picture("B", axis=2, gaps=True, width=width), "A title")
        rgb = panels.frame(0.0, {label: column(x, x[:, 0] - 0.5, 0.14) for label in labels})
        limits = panels.limits
        later = panels.frame(0.1, {label: column(x, 5 * x[:, 0], 0.14) for label in labels})
        assert rgb.shape == later.shape == (panels.size[1], panels.size[0], 3)
        assert rgb.dtype == np.uint8 and rgb.shape[0] % 2 == 0 and rgb.shape[1] % 2 == 0
        assert panels.limits == limits


def test_panels_keep_the_shape_of_the_box_and_do_not_overlap():
    from taichi_spmhd.render.layout import arrange

    for count in (1, 2, 3, 4, 7):
        for box in (UNIT, ALFVEN, Box((0, 0), (4, 1))):
            layout = arrange(count, box, Picture(gaps=True))
            seen = np.zeros((layout.height, layout.width), int)
            for rect in (*layout.fields, *layout.histograms, layout.bar):
                seen[rect.top : rect.bottom, rect.left : rect.right] += 1
                assert rect.bottom < layout.height and rect.right < layout.width
            assert seen.max() == 1
            field = layout.fields[0]
            assert field.width / field.height == pytest.approx(box.size[0] / box.size[1], rel=0.02)  # whole pixels


def test_the_time_and_the_share_of_close_pairs_are_written():
    from taichi_spmhd.render import Panels
    from taichi_spmhd.render.panels import time_text
    from taichi_spmhd.render.text import close_text

    assert [time_text(t) for t in (0, 0.5, 0.0123, 12.0)] == ["t = 0.00", "t = 0.50", "t = 0.0123", "t = 12.00"]
    assert close_text(np.array([0.1, 0.9, 1.0, 1.0])) == "25 % closer than half a spacing"
    assert close_text(np.append(0.4, np.ones(999))) == "0.1 % closer than half a spacing"
    panels = Panels(["a"], UNIT, Picture("rho", limits=(0, 1), gaps=True))
    x = scattered(50)
    first = panels.frame(0.0, {"a": column(x, x[:, 0], 0.14)})
    same, other = (panels.frame(t, {"a": column(x, x[:, 0], 0.14)}) for t in (0.0, 0.5))
    assert np.array_equal(first, same)
    rows, _ = np.nonzero((first != other).any(axis=2))
    assert len(rows) > 0 and rows.max() < 60  # only the caption in the title line changed


def test_close_gaps_are_drawn_in_red():
    from taichi_spmhd.render import Panels
    from taichi_spmhd.render.text import CLOSE

    x = scattered(50)
    panels = Panels(["a"], UNIT, Picture("rho", limits=(0, 1), gaps=True))
    for gap, red in ((0.4, True), (1.07, False)):
        rgb = panels.frame(0.0, {"a": column(x, x[:, 0], 0.14, gaps=np.full(50, gap))})
        assert (rgb == CLOSE).all(axis=2).any() == red


def test_lines_and_long_strips_show_value_against_x():
    from taichi_spmhd.render import Panels
    from taichi_spmhd.render.panels import DOT

    x = np.linspace(-0.5, 0.5, 100)[:, None]
    strip = np.column_stack([x, 0 * x + 0.01])
    for box, points in ((Box((-0.5,), (0.5,)), x), (Box((-0.5, 0.0), (0.5, 0.02)), strip)):
        panels = Panels(["a"], box, Picture("rho", limits=(0, 1)))
        rgb = panels.frame(0.0, {"a": column(points, np.full(100, 0.75), 0.01)})
        field = panels.layout.fields[0]
        rows = np.nonzero((rgb == DOT).all(axis=2))[0]
        assert np.mean(rows) == pytest.approx(field.top + 0.25 * field.height, abs=2)  # pixels


def moving_films(count):
    """A film of `count` different frames of three panels of discs, its hardest kind for a GIF."""
    from taichi_spmhd.render import Panels

    x = hexagonal()
    labels = ["xi = 0", "xi = 1/2", "xi = 1"]
    panels = Panels(labels, ALFVEN, Picture("B", axis=2, limits=(-0.12, 0.12), gaps=True), "Alfven wave")
    noise = np.random.default_rng(3).normal(0, 0.01, x.shape)

    def frames():
        for n in range(count):
            wave = 0.1 * np.cos(2 * np.pi * (x[:, 0] + x[:, 1] - n / count))
            yield panels.frame(n / count, {label: column(x + n / count * noise, wave, 0.0336) for label in labels})

    return panels, frames()


def test_gif_stays_under_its_limit_and_has_all_frames(tmp_path):
    from taichi_spmhd.render import write_gif

    panels, frames = moving_films(12)
    size = write_gif(tmp_path / "film.gif", frames, 0.1, panels.palette(), limit=1_200_000)
    assert size == (tmp_path / "film.gif").stat().st_size <= 1_200_000
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 12
        assert film.info["loop"] == 0 and film.info["duration"] == 100  # milliseconds
        assert film.width >= 0.5 * panels.size[0]
    assert [path.name for path in tmp_path.iterdir()] == ["film.gif"]


def test_gif_keeps_the_colours(tmp_path):
    from taichi_spmhd.render import write_gif, write_png

    panels, frames = moving_films(2)
    frames = list(frames)
    names = [tmp_path / f"{n}.png" for n in range(2)]
    for name, rgb in zip(names, frames, strict=True):
        write_png(name, rgb)
    write_gif(tmp_path / "film.gif", names, 0.1, panels.palette())  # names of pictures are as good as arrays
    with Image.open(tmp_path / "film.gif") as film:
        film.seek(1)
        off = np.abs(np.asarray(film.convert("RGB")).astype(int) - frames[1]).max(axis=2)
    assert film.size == panels.size
    assert np.median(off) < 8 and off.mean() < 12  # of 255: 124 colours stand for all, the rims are the coarsest


def test_a_film_that_cannot_fit_is_refused_and_leaves_nothing(tmp_path):
    from taichi_spmhd.render import write_gif

    noise = np.random.default_rng(0).integers(0, 255, (4, 200, 200, 3), dtype=np.uint8)
    with pytest.raises(InputError, match="fewer frames"):
        write_gif(tmp_path / "film.gif", noise, limit=1000)
    assert not list(tmp_path.iterdir())


def test_mp4_has_all_frames(tmp_path):
    import imageio_ffmpeg

    from taichi_spmhd.render import write_mp4

    panels, frames = moving_films(6)
    size = write_mp4(tmp_path / "film.mp4", frames, fps=10)
    assert size == (tmp_path / "film.mp4").stat().st_size > 1000
    reader = imageio_ffmpeg.read_frames(str(tmp_path / "film.mp4"))
    assert tuple(next(reader)["size"]) == panels.size
    assert sum(1 for _ in reader) == 6
    assert [path.name for path in tmp_path.iterdir()] == ["film.mp4"]


def test_mp4_without_ffmpeg_names_the_cure(tmp_path, monkeypatch):
    from taichi_spmhd.render import write_mp4

    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(InputError, match=r"pip install 'taichi-spmhd\[movie\]'"):
        write_mp4(tmp_path / "film.mp4", [np.zeros((4, 4, 3), np.uint8)])


def test_png_is_lossless_and_bad_frames_are_refused(tmp_path):
    from taichi_spmhd.render import write_gif, write_png

    rgb = np.random.default_rng(0).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    write_png(tmp_path / "new" / "0000.png", rgb)
    assert np.array_equal(np.asarray(Image.open(tmp_path / "new" / "0000.png")), rgb)
    with pytest.raises(InputError, match="uint8"):
        write_png(tmp_path / "x.png", rgb.astype(float))
    with pytest.raises(InputError, match="one size"):
        write_gif(tmp_path / "x.gif", [rgb, rgb[:10]])
    with pytest.raises(InputError, match="at least one frame"):
        write_gif(tmp_path / "x.gif", [])


def test_snapshot_draws_a_simulation():
    from taichi_spmhd.render import columns, snapshot

    sim = Fake(scattered(400))
    assert columns(sim, Picture("B"))["values"] == pytest.approx(np.sqrt(25 + sim["x"][:, 0] ** 2))
    assert columns(sim, Picture("B", axis=2))["values"] == pytest.approx(sim["x"][:, 0])
    assert columns(sim, Picture("rho"))["spacing"] == pytest.approx(1 / 20)
    rgb = snapshot(sim, "B", axis=2, draw="sph", size=500)
    assert rgb.dtype == np.uint8 and rgb.ndim == 3 and rgb.shape[1] <= 500


@pytest.mark.parametrize(
    ("wrong", "cure"),
    [
        ({"draw": "particle"}, "did you mean 'particles'"),
        ({"colours": "virids"}, "did you mean 'viridis'"),
        ({"member": "Bz"}, 'write Picture\\("B", axis=2\\)'),
        ({"member": "div B"}, "did you mean 'div_B'"),
        ({"member": 3}, "must be a name"),
        ({"axis": 3}, "0, 1 or 2"),
        ({"limits": (1, 0)}, "write \\(0, 1\\)"),
        ({"limits": (0, float("nan"))}, "two numbers"),
        ({"limits": 3}, "two numbers"),
        ({"limits": (0, 1), "log": True}, "positive"),
        ({"width": 10}, "240"),
    ],
)
def test_a_wrong_picture_is_refused_with_the_cure(wrong, cure):
    with pytest.raises(InputError, match=cure) as caught:
        Picture(**wrong)
    assert "\n" not in str(caught.value)


def test_wrong_members_and_kinds_are_refused():
    from taichi_spmhd.render import Panels, columns, draw
    from taichi_spmhd.render.colours import palette

    sim = Fake(scattered(9))
    with pytest.raises(InputError, match="no member 'psi'"):
        columns(sim, Picture("psi"))
    with pytest.raises(InputError, match="scalar"):
        columns(sim, Picture("rho", axis=1))
    with pytest.raises(InputError, match="2 components"):
        columns(sim, Picture("x", axis=2))
    with pytest.raises(InputError, match="did you mean 'sph'"):
        draw("sp", UNIT, sim["x"], sim["rho"], sim["h"], (10, 10), palette("viridis"), (0, 1))
    with pytest.raises(InputError, match="panel 'b'"):
        Panels(["a", "b"], UNIT, Picture()).frame(0.0, {"a": column(sim["x"], sim["rho"], 0.3)})


def test_the_gap_is_drawn_like_a_member(disordered):
    from taichi_spmhd.render import columns

    sim = disordered(Pressure())
    picture = Picture("gap")
    apart = sim["x"][:, None] - sim["x"]
    distance = np.linalg.norm(apart - np.rint(apart / sim.scene.box.size) * sim.scene.box.size, axis=2)
    np.fill_diagonal(distance, np.inf)
    spacings = distance.min(axis=1) * np.sqrt(sim["rho"] / sim["m"])
    assert columns(sim, picture)["values"] == pytest.approx(spacings, rel=1e-12)  # both f64
    read = columns(sim, picture, sim.columns())  # members that were read before
    assert np.array_equal(read["values"], columns(sim, picture)["values"])
    with pytest.raises(InputError, match="scalar"):
        columns(sim, Picture("gap", axis=0))


def test_symbols_and_colour_maps_follow_what_is_shown():
    assert [Picture("B", axis=2).symbol, Picture("v").symbol, Picture("rho").symbol] == ["B_z", "|v|", "rho"]
    assert Picture("div_B").symbol == "h|div B|/|B|"
    assert Picture("B", axis=2).colour_map((-0.12, 0.12)) == "RdBu_r"
    assert Picture("rho").colour_map((0, 1)) == "viridis"
    assert Picture("div_B").colour_map((1e-4, 1)) == "inferno"
    assert Picture("gap").symbol == "gap / spacing" and Picture("gap").colour_map((0, 1.2)) == "plasma_r"
    assert Picture("rho", colours="cividis").colour_map((-1, 1)) == "cividis"
