"""`spmhd cost`: the grid, what is said of it, and studies that are what a run of its own would be."""

import csv
import json
import os
import signal

import numpy as np
import pytest
from tiny import spmhd

from taichi_spmhd import Heun, InputError, QuinticSpline, choices, load_scene
from taichi_spmhd.cost import grid, places
from taichi_spmhd.cost.measure import digest
from taichi_spmhd.cost.plan import planned, study_of
from taichi_spmhd.cost.setting import work
from taichi_spmhd.cost.worker import Workers
from taichi_spmhd.library import find, shipped
from taichi_spmhd.terms import Cleaning, Conductivity, ConstantCleaning

PLACE = {"arch": "cpu", "precision": "f64", "threads": 2}
SMALL = ("sound_wave", "--vary", "nx=32,64", "kernel=quintic", "--t-end", "0.25", "--threads", "2", "--repeat", "2")

BANG = '''"""A sound wave, and one with a term that explodes."""
from dataclasses import dataclass

from taichi_spmhd import load_scene
from taichi_spmhd.runtime import ti
from taichi_spmhd.terms import Term
from taichi_spmhd.types import vec3


@dataclass(frozen=True)
class Bang(Term):
    """dv/dt = sqrt(0.05 - t): not a number from t = 0.05 on"""

    evolves = {"v": vec3}

    @ti.func
    def local(self, i, now):
        return ti.Struct(v=ti.sqrt(0.05 - now.t) * ti.Vector([1.0, 0.0, 0.0]))


def scenes(nx=16):
    calm = load_scene("sound_wave", nx=nx)["sound wave"].but(t_end=0.1)
    return {"calm": calm, "bang": calm.plus(Bang())}
'''


def plan(scene, vary=(), labels=None, **given):
    """The plan of a command line."""
    rest = {**PLACE, "repeat": None, "budget": None}
    return planned(scene, given, list(vary), labels, None, None, **rest)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A small study of the sound wave by the command: (folder, cost.json)."""
    out = tmp_path_factory.mktemp("study")
    assert spmhd("cost", *SMALL, "--out", str(out)) == 0
    return out, json.loads((out / "cost.json").read_text())


def test_the_grid_is_the_product_and_the_cheapest_come_first():
    made = plan("sound_wave", ["nx=64,16,32", "kernel=quintic,cubic", "precision=f32,f64"])
    assert len(made.settings) == 3 * 2 * 2
    cost = [setting.work for setting in made.settings]
    assert cost == sorted(cost)
    first, last = made.settings[0], made.settings[-1]
    assert (first.parameters["nx"], first.changes["kernel"]) == (16, "cubic")
    assert (last.parameters["nx"], last.changes["kernel"]) == (64, "quintic")
    assert made.level == "nx" and made.telling == ["kernel", "precision", "nx"]


def test_a_scene_without_a_study_is_measured_at_three_resolutions_up_to_its_own():
    assert plan("sound_wave").varied == {"nx": [32, 46, 64]}


@pytest.mark.parametrize("name", [name for name in shipped() if study_of(find(name)).vary])
def test_every_study_a_scene_declares_can_be_built(name):
    made = plan(name)
    assert len(made.settings) >= 3 and made.level == "nx" and made.error


def test_more_particles_and_more_neighbours_are_more_work():
    wave = load_scene("alfven_tensile", nx=16)["xi = 1/2"]
    finer = load_scene("alfven_tensile", nx=32)["xi = 1/2"]
    assert work(finer) == pytest.approx(8 * work(wave), rel=0.05)  # N^(1 + 1/2) in 2-D; rows are whole numbers
    # 18.1 and 28.3 neighbours and 20 for what does not depend on them; longer h, fewer steps: 1.2 and 1.0 spacings
    assert work(wave.but(kernel=QuinticSpline())) == pytest.approx(48.3 / 38.1 * 1.2 * work(wave), rel=0.01)


def test_choices_change_what_they_name_and_nothing_else():
    scene = load_scene("orszag_tang", nx=32)["with cleaning"]
    made = choices.applied(
        scene, {"h_fact": 1.1, "kernel": "quintic", "cour": 0.2, "stepper": "heun", "cleaning": "constant"}
    )
    assert made.kernel == QuinticSpline(h_fact=1.1) and made.stepper == Heun(cour=0.2)
    kinds = [type(term) for term in made.terms]
    assert ConstantCleaning in kinds and Cleaning not in kinds and len(kinds) == len(scene.terms)
    made = choices.applied(scene, {"Conductivity": False, "DivBSource.xi": 1.0, "cleaning": "none"})
    assert not {Conductivity, Cleaning} & {type(term) for term in made.terms}
    assert next(term for term in made.terms if type(term).__name__ == "DivBSource").xi == 1.0


@pytest.mark.parametrize(
    ("words", "cure"),
    [
        (("--vary", "nx"), "--vary nx=16,32,64"),
        (("--vary", "nx=32,"), "write NAME=VALUE"),
        (("--vary", "nx=32,32"), "twice"),
        (("--vary", "nx=32", "nx=64"), "put all its values behind one nx="),
        (("--vary", "kernel=cubik"), "did you mean 'cubic'"),
        (("--vary", "kernal=cubic"), "did you mean 'kernel'"),
        (("--vary", "precision=f16"), "choose of f64, f32"),
        (("--vary", "threads=0"), "1 to 1024"),
        (("--vary", "cour=fast"), "give a number"),
        (("--vary", "Pressure=perhaps"), "give on or off"),
        (("--vary", "nx=16,32", "--set", "nx=64"), "leave one of them out"),
        (("--repeat", "0"), "1 to 100"),
        (("--budget", "-3"), "--budget 120"),
        (("--jobs", "0"), "1 to 256"),
        (("--jobs", "2", "--cluster", "tcp://here:1"), "leave out --jobs"),
        (("--resume",), "there is no study"),
        (("--out", "pyproject.toml"), "give a folder"),
    ],
)
def test_bad_input_is_one_line_with_the_cure(capsys, tmp_path, words, cure):
    out = () if "--out" in words else ("--out", str(tmp_path / "out"))
    vary = () if "--vary" in words else ("--vary", "nx=16")
    assert spmhd("cost", "sound_wave", "--quiet", "--t-end", "0.01", *vary, *words, *out) == 2
    said = capsys.readouterr().err
    assert cure in said and said.count("\n") == 1


def test_a_scene_without_a_solution_is_referred_to_the_price_list(capsys):
    assert spmhd("cost", "blast") == 2
    assert "--effects" in capsys.readouterr().err


def test_repetitions_are_interleaved_and_what_is_done_is_not_repeated():
    made = plan("sound_wave", ["nx=16,32"])
    todo = places.tasks(made, {(made.settings[0].key, 0)})
    assert [(task.setting.parameters["nx"], task.round) for task in todo] == [
        (32, 0),
        (16, 1),
        (32, 1),
        (16, 2),
        (32, 2),
    ]


def test_strands_share_the_work_and_keep_a_setting_to_themselves():
    made = plan("sound_wave", ["nx=16,20,24,28,32"])
    dealt = places.shares(places.tasks(made, set()), 2)
    keys = [{task.setting.key for task in share} for share in dealt]
    assert sum(map(len, dealt)) == 5 * 3 and not keys[0] & keys[1]
    sizes = [sum(task.setting.work for task in share) for share in dealt]
    assert max(sizes) < 1.5 * min(sizes)  # 1.27: five settings cannot be halved


def test_a_study_is_what_a_run_of_its_own_gives_to_the_bit(study, simulate):
    """The repetitions go back to the start of one simulation; each must be a new one."""
    _, made = study
    for row in made["rows"]:
        sim = simulate(load_scene("sound_wave", nx=row["setting"]["nx"])["sound wave"].but(t_end=0.25)).run()
        assert row["same_bits"] and row["repeats"] == 2 and row["steps"] == sim.steps
        assert row["digest"] == digest(sim)
        assert row["errors"] == sim.summary()["errors"]


def test_the_order_of_the_sound_wave_is_two(study):
    """1/N^2 until the kernel's bias shows (docstring of the scene); measured 1.99."""
    folder, made = study
    coarse, fine = (row["error"] for row in made["rows"])
    assert np.log2(coarse / fine) == pytest.approx(2, abs=0.1)
    assert f"{np.log2(coarse / fine):.2f}" in (folder / "cost.md").read_text()


def test_seconds_are_steps_alone_and_say_where_and_when(study):
    _, made = study
    for row in made["rows"]:
        assert 0 < row["seconds_min"] <= row["seconds"] <= row["seconds_max"] < row["seconds_compile"]
        assert row["seconds_scaled"] == pytest.approx(row["seconds"] * 4e-3 / row["calibration"], rel=0.5)
        assert row["updates_per_s"] == pytest.approx(row["particles"] * row["steps"] / row["seconds"])
    assert set(made["machine"]) == {"hardware", "version", "commit", "date"}
    assert all(run["arch"] == "cpu" and run["threads"] == 2 and run["cores"] > 0 for run in made["runs"])


def test_the_table_holds_conservation_and_clumping_beside_the_error(study):
    folder, made = study
    with open(folder / "cost.csv") as file:
        lines = list(csv.DictReader(file))
    assert [float(line["error_v_x"]) for line in lines] == [row["errors"]["v_x"] for row in made["rows"]]
    assert {"nx", "kernel", "precision", "seconds", "energy_drift", "momentum_drift", "close_pairs"} <= set(lines[0])
    text = (folder / "cost.md").read_text()
    assert "close pairs" in text and "energy drift" in text and made["machine"]["date"] in text


def test_a_finished_study_resumes_with_more_settings_and_refuses_another(study, capsys):
    folder, made = study
    wider = [word.replace("quintic", "quintic,cubic") for word in SMALL]
    assert spmhd("cost", *wider, "--budget", "1e-9", "--resume", "--out", str(folder), "--quiet") == 0
    again = json.loads((folder / "cost.json").read_text())
    assert again["runs"][: len(made["runs"])] == made["runs"]  # nothing was measured twice
    assert len(again["runs"]) == len(made["runs"]) + 1  # and a budget leaves one run at least
    assert spmhd("cost", *SMALL[:4], "--t-end", "0.5", "--resume", "--out", str(folder)) == 2
    assert "t_end = 0.25, now it is 0.5" in capsys.readouterr().err
    assert spmhd("cost", *SMALL, "--error", "B", "--resume", "--out", str(folder)) == 2
    assert "there is no such error; there are rho, v" in capsys.readouterr().err


def test_what_is_not_ours_is_not_touched(tmp_path, capsys):
    (tmp_path / "cost.png").write_text("a picture of my cat")
    assert spmhd("cost", *SMALL, "--out", str(tmp_path)) == 2
    assert "no study of ours" in capsys.readouterr().err
    assert (tmp_path / "cost.png").read_text() == "a picture of my cat"


@pytest.mark.slow
def test_a_process_that_is_killed_is_replaced_and_its_run_repeated():
    made = plan("sound_wave", ["nx=32"])
    order = {**made.order(made.settings[0]), "t_end": 0.05}
    workers = Workers("cpu")
    try:
        first = workers.ask(order)
        os.kill(workers.worker(order).running.pid, signal.SIGKILL)
        again = workers.ask(order)
    finally:
        workers.close()
    assert first["digest"] == again["digest"] and "wrong" not in again


def test_a_run_that_goes_wrong_is_a_row_and_the_others_go_on(tmp_path, capsys):
    (tmp_path / "bang.py").write_text(BANG)
    out = tmp_path / "out"
    words = ("--vary", "nx=16", "--repeat", "2", "--out", str(out), "--threads", "2")
    assert spmhd("cost", str(tmp_path / "bang.py"), *words) == 0
    calm, bang = json.loads((out / "cost.json").read_text())["rows"]
    assert calm["wrong"] is None and calm["repeats"] == 2
    assert "Bang" in bang["wrong"] and bang["repeats"] == 1 and bang["error"] is None
    assert "Went wrong: bang" in capsys.readouterr().out


def test_an_axis_that_is_no_parameter_of_the_scene_is_not_silently_ignored():
    scene = load_scene("sound_wave")["sound wave"]
    with pytest.raises(InputError, match="nothing of that name"):
        grid.axes({"xi": ["1"]}, {}, scene)


@pytest.mark.slow
def test_the_travelling_alfven_wave_is_as_accurate_as_asked():
    """Vector error after one period, nx = 64 (55 spacings a wavelength) and 74 (64). Measured 1.10e-3 and 1.08e-3; an
    established SPMHD code in Fortran has 1.05e-3 at 64. Wendland C4 stays at 1.67e-3, its bias at h_fact = 1.5.
    """
    made = plan("alfven_tensile", ["nx=64,74", "kernel=wendland_c6"])
    workers = Workers("cpu")
    try:
        errors = [workers.ask(made.order(setting))["errors"]["B"] for setting in made.settings]
    finally:
        workers.close()
    assert errors[0] <= 1.8e-3 and errors[1] <= 1.3e-3
