"""The battery of hard cases: each is sound at its stated parameters, and the battery sees what is not."""

import json
from dataclasses import replace
from math import inf

import numpy as np
import pytest
from PIL import Image
from test_guards import Bang
from tiny import spmhd

from taichi_spmhd import InputError
from taichi_spmhd.stability import CASES, PRESETS, Limits
from taichi_spmhd.stability.battery import BEST, Task, margin, tasks, wanted
from taichi_spmhd.stability.record import Record
from taichi_spmhd.stability.report import finish, markdown
from taichi_spmhd.stability.trial import FAILED, SOUND, UNSOUND, trial

QUICK = [Task(case, BEST, value, case.chosen(False)[0]) for case in CASES.values() for value in case.chosen(False)[1]]


def failing(row: dict) -> str:
    """What a trial says of itself."""
    return f"{row['verdict']}: {row['beyond']} {row.get('why', '')}"


@pytest.mark.parametrize("task", QUICK, ids=lambda task: f"{task.case.name} {task.value}")
def test_a_hard_case_stays_sound(task):
    """The hardest stated value of each, small: spmhd stability --quick."""
    row = task.make()
    assert row["verdict"] == SOUND, failing(row)
    assert row["floors"] == 0 and row["t"] == 1


SAMPLE = [  # of --full, at its resolution: one of each kind of trouble
    ("uniform_field", 1e-6, "usual"),
    ("alfven_wave", 1e-3, "usual"),
    ("blast_beta", 2e-6, "robust"),
    ("blast_ratio", 1e5, "usual"),
    ("colliding_flow", 100.0, "robust"),
    ("parting_flow", 10.0, "robust"),
    ("strewn", 0.1, "robust"),
    ("density_jump", 1e4, "robust"),
    ("divergence_peak", "jump", "robust"),
    ("rotor", 2.0, "robust"),
    ("noh", 1e-6, "robust"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "value", "preset"), SAMPLE)
def test_a_sample_of_the_whole_battery_stays_sound(name, value, preset):
    row = Task(CASES[name], preset, value, CASES[name].nx[0]).make()
    assert row["verdict"] == SOUND, failing(row)


def test_the_conservative_equations_alone_clump_in_a_strong_field():
    # measured: a quarter of all particles closer than half a spacing to another
    row = Task(CASES["uniform_field"], "textbook", 0.1, 20).make()
    assert row["verdict"] == UNSOUND and row["close"] > 0.1 and "close" in row["beyond"][0]


def problem(**changes):
    """The small uniform field."""
    return replace(CASES["uniform_field"].make(0.1, 20), **changes)


def test_a_run_that_breaks_is_told_with_time_place_and_term():
    scene = PRESETS[BEST].scene(problem(extra=(Bang(t0=0.3),), t_end=1.0))
    row = trial(scene, Limits())
    assert row["verdict"] == FAILED and 0.2 < row["t"] < 0.5
    assert row["term"] == "Bang" and row["particle"] is not None and len(row["position"]) == 2
    assert row["why"] and row["cause"]


def test_a_start_that_cannot_be_simulated_is_a_failure_not_a_crash():
    row = trial(PRESETS[BEST].scene(problem(start=lambda x: {"rho": 1.0, "P": -1.0, "B": [1.0, 0, 0]})), Limits())
    assert row["verdict"] == FAILED and row["cause"] == "start" and "positive" in row["why"]


@pytest.mark.parametrize("limits", [Limits(energy=0.0), Limits(div_B=0.0), Limits(close=-1.0), Limits(momentum=-1.0)])
def test_each_limit_can_be_exceeded(limits):
    row = trial(PRESETS[BEST].scene(problem(t_end=0.05)), limits)
    assert row["verdict"] == UNSOUND and len(row["beyond"]) == 1


def test_a_floor_is_never_sound():
    from taichi_spmhd.stability.trial import excess

    assert excess({"energy": 0.0, "momentum": 0.0, "close": 0.0, "floors": 1}, Limits()) == ["1 floors"]
    assert excess({"energy": float("nan"), "floors": 0}, Limits())  # not a number is beyond every limit


def test_what_is_beyond_is_tried_until_it_fails():
    case = "uniform_field"
    asked, row, seen = tasks([case], [BEST], whole=True), None, []
    task = next(asked)
    with pytest.raises(StopIteration):
        while True:
            seen.append(task)
            # the second one beyond fails: there must be no third
            broken = task.beyond and task.value == CASES[case].beyond[1]
            row = {**task.named(), "verdict": FAILED if broken else SOUND}
            task = asked.send(row)
    assert [task.value for task in seen] == [*CASES[case].values, *CASES[case].beyond[:2]]


def rows_of(case: str, *verdicts) -> list[dict]:
    """Made-up rows: stated values first, then what is beyond."""
    values = [*CASES[case].values, *CASES[case].beyond]
    stated = len(CASES[case].values)
    return [
        {"case": case, "value": v, "verdict": w, "beyond_asked": k >= stated}
        for k, (v, w) in enumerate(zip(values, verdicts, strict=False))
    ]


@pytest.mark.parametrize(
    ("verdicts", "words"),
    [
        ((SOUND, SOUND), "not asked"),
        ((SOUND, FAILED), "failed at beta = 0.001"),
        ((SOUND, SOUND, SOUND, FAILED), "sound to 0.0001, failed at 1e-06"),
        ((SOUND, SOUND, UNSOUND), "sound to 0.001, unsound at 0.0001"),
        ((SOUND, SOUND, SOUND, SOUND), "sound to 1e-06, the last tried"),
    ],
)
def test_the_margin_is_told_in_words(verdicts, words):
    assert margin(CASES["current_sheet"], rows_of("current_sheet", *verdicts)) == words


def test_a_later_trial_replaces_the_same_earlier_one(tmp_path):
    record = Record(tmp_path, "f64")
    row = {**Task(CASES["noh"], BEST, 1e-6, 32).named(), "verdict": FAILED, "beyond": [], "t": 0.5, "seconds": inf}
    record.add(row)
    record.add({**row, "verdict": SOUND})
    Record(tmp_path, "f32").add(row)
    kept = Record(tmp_path, "f64").rows
    assert [(r["precision"], r["verdict"]) for r in kept] == [("f64", SOUND), ("f32", FAILED)]
    strange = ([1], [{}], [{**kept[0], "verdict": "fine"}], [{**kept[0], "case": "none"}], "rows", None)
    for rows in strange:
        (tmp_path / "stability.json").write_text(json.dumps({"rows": rows}))
        with pytest.raises(InputError, match="not the record"):
            Record(tmp_path, "f64")


def test_an_unknown_case_is_told_with_the_nearest():
    with pytest.raises(InputError, match="did you mean"):
        wanted(["orszag_tank"], CASES, "--only")


def test_the_command_writes_table_picture_and_record(capsys, tmp_path):
    words = ("stability", "--only", "doubled", "uniform_field", "--preset", "robust", "--out", tmp_path)
    assert spmhd(*words) == 0
    said = capsys.readouterr().out
    assert "2 trials: 2 sound" in said and "green" in said
    rows = json.loads((tmp_path / "stability.json").read_text())["rows"]
    assert {row["case"] for row in rows} == {"doubled", "uniform_field"} and all(row["dt"][0] > 0 for row in rows)
    assert "`doubled`" in (tmp_path / "stability.md").read_text()
    assert np.asarray(Image.open(tmp_path / "stability.png").convert("RGB")).std() > 20
    assert markdown(rows, "machine").count("green") == 2


def test_the_table_shows_the_whole_battery_where_it_was_made_and_else_the_quick_one(tmp_path):
    named = Task(CASES["noh"], BEST, 1e-6, 32).named()
    row = {**named, "verdict": SOUND, "beyond": [], "t": 1.0, "precision": "f64", "made": "here", "energy": 0.0}
    finish(tmp_path, [{**row, "verdict": FAILED}])
    assert "RED" in (tmp_path / "stability.md").read_text()
    finish(tmp_path, [{**row, "verdict": FAILED}, {**row, "whole": True}])
    assert "RED" not in (tmp_path / "stability.md").read_text()


def test_the_command_says_when_no_preset_stands(capsys, tmp_path):
    assert spmhd("stability", "--only", "uniform_field", "--preset", "textbook", "--out", tmp_path, "--quiet") == 3
    assert "no preset is sound" in capsys.readouterr().err
    assert "YELLOW" in (tmp_path / "stability.md").read_text()
