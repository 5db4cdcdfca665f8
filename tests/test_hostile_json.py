"""run.json and cost.json, damaged or made by somebody else: a command goes on, or refuses them in one line."""

import json
import shutil

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tiny import DEVICE, WAVE, Killed, kill_at, one_line, refused, run, write

from taichi_spmhd import InputError
from taichi_spmhd.cost.places import tasks
from taichi_spmhd.cost.plan import planned
from taichi_spmhd.cost.record import Record
from taichi_spmhd.cost.report import finish
from taichi_spmhd.machine import machine
from taichi_spmhd.outputs.film import Film
from taichi_spmhd.outputs.record import MAY, MUST

VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(-2, 10**20), st.floats(), st.text(max_size=5)),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=4), inner, max_size=3)),
    max_leaves=6,
)


@pytest.fixture(scope="module")
def halted(tmp_path_factory):
    """A scene, and the folder of a run of it that had not ended."""
    root = tmp_path_factory.mktemp("halted")
    scene = write(root, WAVE)
    with pytest.MonkeyPatch.context() as patch, pytest.raises(Killed):
        kill_at(patch, Film, "draw", 2)
        run(scene, root / "out", "--variant", "xi = 0", "--frames", 2)
    return scene, root


def resumed(halted, text: str) -> str:
    """What is said when the run is taken up with this run.json."""
    scene, root = halted
    shutil.rmtree(root / "copy", ignore_errors=True)
    shutil.copytree(root / "out", root / "copy")
    (root / "copy" / "run.json").write_text(text, encoding="utf-8", errors="surrogatepass")
    return one_line("run", scene, "--out", root / "copy", *DEVICE, "--resume", codes=(0, 2, 3))


@settings(max_examples=20)
@given(name=st.sampled_from([*MUST, *MAY, "scene file", "arch", "precision"]), value=VALUES, text=st.text(max_size=9))
def test_a_run_json_with_another_value_goes_on_or_is_refused_in_one_line(halted, name, value, text):
    record = json.loads((halted[1] / "out" / "run.json").read_text())
    resumed(halted, json.dumps({**record, name: value}))
    resumed(halted, json.dumps({key: value for key, value in record.items() if key != name}))
    resumed(halted, text)


@pytest.mark.parametrize("text", ["", "[" * 100_000, '{"scene": ' * 5000, "null", "9" * 10000, "\ud800"])
def test_a_run_json_that_is_none_is_refused(halted, text):
    assert "run.json is damaged" in resumed(halted, text)


def test_a_run_json_cannot_name_files_elsewhere(halted, capsys):
    """Files of an earlier run are removed: only those that are its own by their kind."""
    scene, root = halted
    record = json.loads((root / "out" / "run.json").read_text())
    out = root / "elsewhere" / "out"
    (out / "wave.gif").mkdir(parents=True)
    precious = root / "elsewhere" / "precious"
    precious.write_text("mine")
    (out / "run.json").write_text(json.dumps({**record, "movie": "gif/../../precious"}))
    assert "no run of ours" in refused(capsys, "run", scene, "--out", out, *DEVICE)
    assert precious.read_text() == "mine"


FIGURES = {
    "seconds": 0.002, "calibration": 0.0017, "cores": 0.84, "load": 0.8, "particles": 16, "steps": 3, "t": 0.05,
    "bytes_per_particle": 524, "errors": {"rho": 1e-6, "v_x": 0.03}, "energy_drift": 1e-13,
    "energy_drift_predicted": 0.0, "momentum_drift": 1e-14, "momentum_drift_predicted": 0.0, "close_pairs": 0.0,
    "floors": 0, "digest": "2e09b3e842b51b10", "seconds_compile": 1.3, "arch": "cpu", "precision": "f64", "threads": 1,
}  # fmt: skip


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A plan, the folder of a study of it, and what its cost.json says."""
    place = {"arch": "cpu", "precision": "f64", "threads": 1, "repeat": 1, "budget": None}
    plan, root = planned("sound_wave", {}, ["nx=16,24"], None, None, 0.05, **place), tmp_path_factory.mktemp("study")
    record = Record(root, plan, machine())
    for task in tasks(plan, set()):
        record.add(task, FIGURES)
    return plan, root, json.loads((root / "cost.json").read_text())


def taken_up(study, text: str) -> None:
    """A study goes on from this cost.json to its report, or says in one line why not."""
    plan, root, _ = study
    (root / "cost.json").write_text(text, encoding="utf-8", errors="surrogatepass")
    record = Record(root, plan, machine())
    try:
        record.take_up()
        record.done()
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("taichi_spmhd.cost.picture.draw", lambda *given: given[-1].touch())  # a second each
            finish(record, quiet=True)
    except InputError as error:
        assert str(error).isprintable()


@settings(max_examples=100)
@given(name=st.sampled_from([*FIGURES, "key", "round", "wrong", "div_B"]), value=VALUES)
def test_a_run_in_cost_json_with_another_value_counts_or_is_refused(study, name, value):
    made = study[2]
    other = {**made["runs"][1], name: value}
    taken_up(study, json.dumps({**made, "runs": [made["runs"][0], other]}))
    taken_up(study, json.dumps({**made, "runs": [{k: v for k, v in other.items() if k != name}]}))


@settings(max_examples=60)
@given(
    name=st.sampled_from(["scene", "parameters", "vary", "machine", "error", "rows", "runs", "places"]), value=VALUES
)
def test_a_cost_json_with_another_value_goes_on_or_is_refused(study, name, value):
    taken_up(study, json.dumps({**study[2], name: value}))
    taken_up(study, json.dumps({**study[2], "machine": {**study[2]["machine"], "commit": value}}))
    taken_up(study, json.dumps(value))


def test_a_sound_cost_json_is_taken_up(study):
    plan, root, made = study
    (root / "cost.json").write_text(json.dumps(made))
    record = Record(root, plan, machine())
    record.take_up()
    assert len(record.done()) == 2


@pytest.mark.parametrize("runs", ["[{}]", '[{"key": 1}]', "{}", "[null]"])
def test_runs_that_are_none_are_told(study, runs):
    plan, root, made = study
    (root / "cost.json").write_text(json.dumps({**made, "runs": json.loads(runs)}))
    with pytest.raises(InputError, match="is damaged; start anew"):
        Record(root, plan, machine()).take_up()
