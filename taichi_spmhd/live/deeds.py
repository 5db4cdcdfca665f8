"""What the page may ask for, one small function each. They run on the main thread, between two steps."""

import time

import numpy as np

from .. import kernels, library
from ..errors import InputError
from . import pokes
from .panel import Panel, kind
from .script import script


def play(session, wish: dict) -> None:
    if not session.going:
        raise InputError("the run went wrong; reset starts it anew")
    session.playing = True


def pause(session, wish: dict) -> None:
    session.playing = False


def step(session, wish: dict) -> None:
    """One step, then rest."""
    session.playing = False
    session.advance()


def reset(session, wish: dict) -> None:
    """All panels back to the start, with the settings of now."""
    for panel in session.panels:
        panel.reset()
    session.shown.anew()


def speed(session, wish: dict) -> None:
    session.speed = float(wish["value"])


def number(session, wish: dict) -> None:
    """A slider."""
    session.panels[wish["panel"]].slide(wish["part"], wish["name"], wish["value"])
    session.slid = time.monotonic()


def switch(session, wish: dict) -> None:
    """A term on or off."""
    session.compiling()
    session.panels[wish["panel"]].switch(wish["part"], wish["on"])
    session.changed()


def choose(session, wish: dict) -> None:
    """Scene, parameters, variant, kernel: whichever is given."""
    session.compiling()
    panel = session.panels[wish.get("panel", 0)]
    other = wish.get("scene", session.scene_name) != session.scene_name
    path = session.find(wish["scene"]) if other else session.path
    values = library.parameters_of(path, **{**({} if other else session.parameters), **wish.get("set", {})})
    if other or values != session.parameters:
        session.open(path, values, wish.get("variant", None if other else panel.variant))
        panel = session.panels[wish.get("panel", 0)]
    elif {"variant", "scene", "set"} & set(wish):
        panel.begin_with(panel.variants, among(panel, wish.get("variant", panel.variant)))
        reset(session, wish)
    if wish.get("kernel", kind(panel.scene.kernel)) != kind(panel.scene.kernel):
        panel.change(panel.scene.but(kernel=getattr(kernels, wish["kernel"])()))
    session.changed()


def among(panel: Panel, variant: str) -> str:
    """A variant that the scene has."""
    if variant not in panel.variants:
        raise InputError(f"variant: there is no {variant!r}; there are {', '.join(panel.variants)}")
    return variant


def panels(session, wish: dict) -> None:
    """One panel, or two: the second begins with the first one's settings."""
    first, count = session.first, wish["count"]
    if count == 2 and len(session.panels) == 1:
        session.compiling()
        session.panels.append(Panel("B", first.variants, first.variant, first.scene))
        reset(session, wish)
    elif count == 1 and len(session.panels) == 2:
        session.panels.pop().close()
    session.changed()


def draw(session, wish: dict) -> None:
    """What is drawn."""
    session.look.change(wish)
    session.changed()


def poke(session, wish: dict) -> None:
    """Push the particles around a place, or add a pulse of pressure or field."""
    panel = session.panels[wish["panel"]]
    sim, place = panel.sim, np.array([wish["x"], wish.get("y", 0.0), wish.get("z", 0.0)][: panel.sim.dim])
    if wish["kind"] not in pokes.allowed(sim):
        raise InputError(f"this scene cannot be poked with {wish['kind']}")
    if wish["kind"] == "push":
        moved = np.array([wish["dx"], wish.get("dy", 0.0), 0.0][: sim.dim])
        scale = float(np.asarray(sim["vw"]).max()) / max(sim.scene.box.size)
        pokes.push(sim, place, moved * scale, wish["radius"])
    else:
        getattr(pokes, wish["kind"])(sim, place, wish["strength"], wish["radius"])


def record(session, wish: dict) -> None:
    """Write a picture, a film, the state, or the settings as a scene file."""
    session.shown.note(RECORDS[wish["what"]](session))


def png(session) -> list[str]:
    look = session.look
    return [session.recorder.png(session.shots, look.picture, look.settle(session.sims), session.title)]


def film(session) -> list[str]:
    session.shown.film()
    return []


def stop(session) -> list[str]:
    return session.shown.end_film()


def state(session) -> list[str]:
    return [name for panel in session.panels for name in session.recorder.state(panel.sim, panel.label)]


def scene(session) -> list[str]:
    text = script(session.path, session.parameters, session.panels, session.look.picture, session.title)
    return [session.recorder.text(f"{session.scene_name}_live", text)]


def particle(session, question: dict) -> dict | None:
    """The particle nearest to a place, with all its members; None where there is no such panel."""
    if question["panel"] >= len(session.panels):
        return None
    sim = session.panels[question["panel"]].sim
    columns, box = sim.columns(), sim.scene.box
    apart = columns["x"][:, :2].astype(float) - np.array([question["x"], question["y"]])[: min(2, sim.dim)]
    for a in range(apart.shape[1]):
        if sim.scene.boundary.periodic[a]:
            apart[:, a] -= box.size[a] * np.round(apart[:, a] / box.size[a])
    k = int(np.argmin((apart**2).sum(axis=1)))
    return {"id": k, "members": {name: plain(values[k]) for name, values in columns.items()}}


def plain(value):
    """A number or a list of numbers for JSON; None for what is not finite."""
    rounded = np.round(np.asarray(value, float), 9)
    return np.where(np.isfinite(rounded), rounded, None).tolist()


RECORDS = {"png": png, "film": film, "stop": stop, "state": state, "scene": scene}
DEEDS = {
    "play": play, "pause": pause, "step": step, "reset": reset, "speed": speed, "number": number, "switch": switch,
    "choose": choose, "panels": panels, "draw": draw, "poke": poke, "record": record,
}  # fmt: skip
