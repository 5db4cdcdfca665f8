"""A live run over HTTP alone: slide, switch, poke, record, two panels, what goes wrong; and that nobody disturbs it."""

import io
import threading

import numpy as np
import pytest
from client import running
from hostile import requests, send
from PIL import Image
from tiny import EXPLODES

from taichi_spmhd import Simulation, load_scene

NX, T_END = 16, 1.0


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    return tmp_path_factory.mktemp("live")


@pytest.fixture(scope="module")
def live(out):
    """A small Alfven wave, shared by the tests; each begins with `fresh`."""
    with running("alfven_tensile", "--set", f"nx={NX}", f"t_end={T_END}", "--out", str(out)) as (client, _):
        yield client


@pytest.fixture
def fresh(live):
    """The run at rest at its start, with the settings it began with."""
    live.do(do="pause")
    live.do(do="panels", count=1)
    live.do(do="choose", scene="alfven_tensile", set={"nx": NX, "t_end": T_END}, variant="xi = 1", kernel="CubicSpline")
    live.do(do="speed", value=0)
    return live


def at_the_end(live) -> dict:
    """Play until the scene's end."""
    live.do(do="play")
    return live.until(lambda state: not state["playing"])


def close_pairs(live) -> float:
    """Of the last row of the plots."""
    rows = live.state(row=0)["rows"]["panels"][0]
    return rows[-1][live.get("setup")["columns"].index("close_pairs")]


def test_particles_clump_when_xi_slides_to_0_and_not_at_one_half(fresh):
    fresh.do(do="number", panel=0, part="DivBSource", name="xi", value=0.0)
    state = at_the_end(fresh)
    assert state["panels"][0]["t"] >= T_END and "t_end" in state["message"]["text"]
    # measured at the end: 24 % of all particles closer than half a spacing; the last row is a moment earlier
    assert close_pairs(fresh) > 0.05
    fresh.do(do="reset")
    fresh.do(do="number", panel=0, part="DivBSource", name="xi", value=0.5)
    at_the_end(fresh)
    assert close_pairs(fresh) == 0.0


def test_a_slider_acts_between_two_steps_and_compiles_nothing(fresh):
    fresh.do(do="step")
    state = fresh.do(do="number", panel=0, part="Viscosity", name="alpha", value=1.5)
    assert state["panels"][0]["steps"] == 1 and state["busy"] is None
    fresh.until(lambda state: state["setup"] > 0)
    setup = fresh.get("setup")
    while setup["version"] == state["setup"]:  # other pages hear of it a moment later
        setup = fresh.get("setup")
    part = next(part for part in setup["panels"][0]["parts"] if part["name"] == "Viscosity")
    assert part["numbers"][0] == {"name": "alpha", "value": 1.5, "start": 0.1, "low": 0.0, "high": 3.0}
    assert "Monaghan 1997" in part["advice"] and part["equation"].startswith("dv_i/dt")


def test_a_term_goes_off_and_on_with_the_state_kept(fresh):
    for _ in range(5):
        before = fresh.do(do="step")["panels"][0]
    there = fresh.get("particle?panel=0&x=0.5&y=0.5")
    for on in (False, True):
        state = fresh.do(do="switch", panel=0, part="Resistivity", on=on)
        parts = {part["name"]: part["on"] for part in fresh.get("setup")["panels"][0]["parts"]}
        assert parts["Resistivity"] is on
        assert (state["panels"][0]["t"], state["panels"][0]["steps"]) == (before["t"], before["steps"])
        again = fresh.get("particle?panel=0&x=0.5&y=0.5")
        assert again["id"] == there["id"] and again["members"]["x"] == there["members"]["x"]
    assert fresh.do(do="step")["panels"][0]["steps"] == 6


def test_a_term_that_no_variant_has_can_be_added(fresh):
    fresh.do(do="step")
    state = fresh.do(do="switch", panel=0, part="Cleaning", on=True)
    assert state["panels"][0]["steps"] == 1
    assert "y" in fresh.get("particle?panel=0&x=0&y=0")["members"]
    assert fresh.do(do="step")["panels"][0]["failed"] is None


def test_what_cannot_be_switched_off_says_why(fresh):
    parts = {part["name"]: part for part in fresh.get("setup")["panels"][0]["parts"]}
    assert parts["Stress"]["fixed"] and "Stress()" in parts["Stress"]["why"]
    status, answer = fresh.post(do="switch", panel=0, part="Induction", on=False)
    assert status == 400 and "cannot be switched off" in answer["error"]


def test_frames_come_in_the_size_asked_for_and_show_what_is_chosen(fresh):
    number, jpeg = fresh.frame(size=(200, 344))
    assert Image.open(io.BytesIO(jpeg)).size == (200, 344)
    for wish in ({"member": "rho", "draw": "sph"}, {"member": "gap", "draw": "nearest"}, {"lines": True}):
        state = fresh.do(do="draw", **wish)
        later, other = fresh.frame(after=number, size=(200, 344))
        assert later > number and other != jpeg and state["message"] is None
        number, jpeg = later, other
    draw = fresh.get("setup")["draw"]
    assert draw["member"] == "gap" and draw["lines"] and draw["limits"][0] < draw["limits"][1]


@pytest.mark.parametrize("kind", ["push", "pressure", "field"])
def test_a_poke_changes_the_gas_and_is_no_drift(fresh, kind):
    fresh.do(do="step")
    before = fresh.get("particle?panel=0&x=0.5&y=1")["members"]
    brush = {"dx": 0.2, "dy": 0.1} if kind == "push" else {"strength": 1.0}
    fresh.do(do="poke", panel=0, kind=kind, x=0.5, y=1.0, radius=0.3, **brush)
    after = fresh.get("particle?panel=0&x=0.5&y=1")["members"]
    changed = {"push": "v", "pressure": "P", "field": "B"}[kind]
    assert np.abs(np.subtract(after[changed], before[changed])).max() > 1e-3
    fresh.do(do="reset")
    fresh.do(do="step")
    assert fresh.get("particle?panel=0&x=0.5&y=1")["members"] == before  # gone with the reset, to the digit


def test_two_panels_go_in_lock_step_from_one_start(fresh):
    fresh.do(do="number", panel=0, part="DivBSource", name="xi", value=0.0)
    state = fresh.do(do="panels", count=2)
    assert [panel["label"] for panel in state["panels"]] == ["A", "B"]
    fresh.do(do="number", panel=1, part="DivBSource", name="xi", value=1.0)
    state = at_the_end(fresh)
    a, b = state["panels"]
    assert a["t"] == b["t"] and a["steps"] == b["steps"] and a["mean_gap"] < b["mean_gap"]
    assert fresh.frame(0)[1] != fresh.frame(1)[1]
    assert fresh.get("setup")["panels"][1]["parts"][4]["numbers"][0]["value"] == 1.0


def test_what_is_recorded_reproduces_the_settings_and_the_state(fresh, out):
    fresh.do(do="number", panel=0, part="DivBSource", name="xi", value=0.25)
    fresh.do(do="switch", panel=0, part="Resistivity", on=False)
    fresh.do(do="record", what="film")
    for _ in range(4):
        fresh.do(do="step")
    files = fresh.do(do="record", what="stop")["files"]
    for what in ("png", "state", "scene"):
        files = fresh.do(do="record", what=what)["files"]
    film, _, picture, state, scene = (out / name for name in files[-5:])
    with Image.open(film) as gif:
        assert gif.n_frames == 5  # the start and four steps, each longer than a hundredth of the time
    assert Image.open(picture).width > 400
    ((_, again),) = load_scene(scene).items()
    assert "xi=0.25" in again.sketch() and "Resistivity" not in again.sketch()
    with Simulation.load(state, again) as sim:
        assert sim.steps == 4
        sim.step()
        assert np.isfinite(sim["v"]).all()


def test_scene_parameters_and_kernel_are_chosen(fresh):
    state = fresh.do(do="choose", kernel="QuinticSpline")
    assert fresh.get("setup")["panels"][0]["kernel"] == "QuinticSpline" and state["message"] is None
    fresh.do(do="choose", scene="sound_wave", set={"nx": 20})
    setup = fresh.get("setup")
    assert setup["scene"] == "sound_wave" and setup["box"]["profile"] and "field" not in setup["pokes"]
    assert {"name": "nx", "kind": "int", "value": 20, "choices": []} in setup["parameters"]
    fresh.do(do="step")


def test_what_the_scene_refuses_is_said_and_all_stays(fresh):
    fresh.do(do="step")
    status, answer = fresh.post(do="choose", set={"nx": 2})
    assert status == 200
    state = fresh.until(lambda state: state["applied"] >= answer["id"])
    assert state["message"]["kind"] == "error" and "raise nx" in state["message"]["text"]
    assert state["panels"][0]["steps"] == 1 and state["panels"][0]["particles"] == 512


def test_a_run_that_goes_wrong_says_so_keeps_the_picture_and_begins_again(tmp_path):
    path = tmp_path / "bang.py"
    path.write_text(EXPLODES, encoding="utf-8")
    with running(str(path), "--out", str(tmp_path / "out")) as (client, _):
        state = client.until(lambda state: state["panels"][0]["failed"])
        assert "not finite" in state["panels"][0]["failed"] and not state["playing"]
        assert state["message"]["kind"] == "error" and client.frame()[1][:2] == b"\xff\xd8"
        client.do(do="reset")
        state = client.do(do="step")
        assert state["panels"][0]["failed"] is None and state["panels"][0]["steps"] == 1
        client.do(do="choose", variant="calm")
        assert client.do(do="step")["panels"][0]["steps"] == 1
        client.do(do="choose", scene="sound_wave", set={"nx": 16})
        client.do(do="choose", scene="bang")  # the file of the command can be chosen again
        assert client.get("setup")["scene"] == "bang" and client.get("setup")["panels"][0]["variant"] == "bang"
    assert not (tmp_path / "out").exists()  # nothing was recorded, so nothing is on the disk


def test_a_thousand_hostile_requests_change_no_bit(tmp_path):
    values = {"nx": NX, "t_end": 40.0}  # 1800 steps: half a minute at 60 a second, longer than the requests take
    words = ("alfven_tensile", "--set", *(f"{name}={value}" for name, value in values.items()), "--out", str(tmp_path))
    with running(*words) as (client, process):
        client.do(do="speed", value=60)
        begun = client.until(lambda state: state["panels"][0]["steps"] > 5)["panels"][0]["steps"]
        threading.Thread(target=lambda: [client.frame(after=k) for k in range(20)], daemon=True).start()
        rounds, meanwhile = 0, begun
        while rounds < 1 or meanwhile < begun + 500:
            for request in requests(client.token, 1000, seed=rounds):
                send(client.port, request)
            rounds, meanwhile = rounds + 1, client.state()["panels"][0]["steps"]
        client.do(do="speed", value=0)
        end = client.until(lambda state: not state["playing"], 120)
        assert end["panels"][0]["steps"] > meanwhile >= begun + 500  # all of it happened while the run went on
        assert process.poll() is None
        (name,) = client.do(do="record", what="state")["files"]
    variants = load_scene("alfven_tensile", **values)
    spare = tuple(part.at(2) for scene in variants.values() for part in scene.parts)
    with (
        Simulation(variants["xi = 1"], spare=spare) as alone,
        Simulation.load(tmp_path / name, variants["xi = 1"], spare=spare) as found,
    ):
        while alone.time < values["t_end"]:
            alone.step()
        assert alone.steps == found.steps and alone.time == found.time
        for member, column in alone.columns().items():
            assert np.array_equal(column, found[member]), member


def test_the_command_ends_with_one_line_and_refuses_nonsense(capsys):
    from tiny import spmhd

    for words, why in (
        (("live", "alfven_tensle"), "did you mean"),
        (("live", "alfven_tensile", "--port", "99999"), "from 0"),
        (("live", "alfven_tensile", "--host", "203.0.113.1", "--no-browser"), "cannot listen"),
        (("live", "alfven_tensile", "--variant", "xi = 2"), "no 'xi = 2'"),
        (("live", "alfven_tensile", "--set", "nx=few"), "whole number"),
    ):
        assert spmhd(*words) == 2
        error = capsys.readouterr().err
        assert why in error and error.count("\n") == 1
