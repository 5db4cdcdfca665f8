"""Session: the loop of a live run. Taichi and the simulations live here, on the main thread; wishes come from the desk.

What is simulated depends on the wishes that were granted and on nothing else: not on who looks, how often, or at what
size. A run that nobody steers has the bits of `Simulation.step` called as often.
"""

import time
import traceback
from contextlib import ExitStack
from pathlib import Path

from ..errors import InputError, RunError
from ..library import find, load_scene, parameters_of, sight
from ..outputs.signals import Stop
from ..outputs.words import one_line
from ..picture import Picture
from ..scene_code import code_of
from . import deeds, pokes
from .clock import Clock
from .look import Look
from .panel import Panel
from .recorder import Recorder
from .setup import setup
from .shown import Shown

WATCH, SMOOTH = 10.0, 15.0  # seconds that a scene should last at least; steps a second below which it jerks
REST = 0.2  # seconds a run with nothing to do sleeps before it looks at Ctrl-C again
ANSWER = 0.003  # seconds the server gets to answer before kernels hold Python's lock again
QUIET = 0.4  # seconds after a slider's last move before other pages hear of it


class Session:
    """path: the scene file; parameters: what --set gave; variant: where to begin, the last one if None."""

    def __init__(self, path: Path, given: dict, variant: str | None, device: dict, out: Path, desk):
        self.device, self.desk, self.recorder = device, desk, Recorder(Path(out))
        self.version, self.playing, self.speed, self.applied = 0, True, 0.0, 0
        self.message, self.busy, self.arrived = None, None, False
        self.slid = 0.0  # when a slider last moved, until the page has been told
        self.panels: list[Panel] = []
        self.clock, self.shown, self.home = Clock(), Shown(self), path
        self.open(path, given, variant)

    @property
    def first(self) -> Panel:
        return self.panels[0]

    @property
    def sims(self) -> list:
        return [panel.sim for panel in self.panels]

    @property
    def shots(self) -> dict:
        """The simulations by what stands above their panels."""
        several = len(self.panels) > 1
        return {f"{p.label}: {p.variant}" if several else p.variant: p.sim for p in self.panels}

    @property
    def title(self) -> str:
        return sight(self.path).rstrip(".")

    def find(self, name: str) -> Path:
        """The scene file of this name: the one the command was given, or one that ships."""
        return self.home if name == self.home.stem else find(name)

    @property
    def scene_name(self) -> str:
        return self.path.stem

    def open(self, path: Path, given: dict, variant: str | None = None) -> None:
        """A scene from its start, in every panel; where it cannot be, all stays as it was. Raises InputError."""
        with code_of(path):
            variants = load_scene(path, **given)
            values = parameters_of(path, **given)
            kept = variant if variant in variants else list(variants)[-1]
            fresh = opened(variants, kept, max(1, len(self.panels)))
        for panel in self.panels:
            panel.close()
        self.path, self.parameters, self.panels = path, values, fresh
        self.look = Look(self.first.scene.picture)
        self.speed = unhurried(self.first)
        self.changed()
        self.shown.anew()

    def pokes(self) -> list[str]:
        """The ways in which this scene may be poked."""
        return pokes.allowed(self.first.sim)

    def changed(self) -> None:
        """Something the page chooses from is different."""
        for picture in (self.first.scene.picture, Picture()):
            if not self.look.fits(self.first.sim):
                self.look = Look(picture)
        self.look.settle(self.sims)
        self.version, self.slid = self.version + 1, 0.0
        self.desk.publish_setup(setup(self))

    def run(self, stop: Stop) -> None:
        """Until somebody asks to stop."""
        try:
            while not stop.asked:
                self.round()
        finally:
            for panel in self.panels:
                panel.close()
            self.recorder.stop()

    def round(self) -> None:
        """Wishes, a step, a look."""
        wishes = self.desk.take()
        for wish in wishes:
            self.grant(wish)
        if wishes:
            time.sleep(ANSWER)
        if self.slid and time.monotonic() - self.slid > QUIET:
            self.changed()
            self.shown.stale = True  # a run at rest must say so, too
        for question, answer in self.desk.questions():
            answer(deeds.particle(self, question))
        stepped = self.playing and self.clock.due(self.speed) and self.advance()
        self.shown.update()
        if not stepped:
            self.desk.wait(self.clock.rest(self.speed, REST) if self.playing and self.going else REST)

    @property
    def going(self) -> list[Panel]:
        """Panels that have not failed."""
        return [panel for panel in self.panels if panel.failed is None]

    def advance(self) -> bool:
        """One step of all panels, in lock step: the longest that is stable in each."""
        going = self.going
        if not going:
            return False
        dt = min(panel.sim.longest for panel in going)
        self.clock.stepped(sum(panel.step(dt) for panel in going))
        for panel in going:
            if panel.failed:
                self.say(f"{panel.label}: {panel.failed}", "error")
        if not self.going:
            self.playing = False
        self.stop_at_the_end()
        self.shown.stepped()
        return True

    def stop_at_the_end(self) -> None:
        """Pause once at the scene's t_end; play goes on beyond it."""
        t_end = self.first.scene.t_end
        if not self.arrived and self.going and self.going[0].sim.time >= t_end:
            self.arrived, self.playing = True, False
            self.say(f"t_end = {t_end:g} is reached; play goes on beyond it")

    def grant(self, wish: dict) -> None:
        """Do what was asked, or say why not."""
        self.message = None
        try:
            if wish.get("panel", 0) >= len(self.panels):
                raise InputError("that panel is no longer there")
            with code_of(self.path):
                deeds.DEEDS[wish["do"]](self, wish)
        except (InputError, RunError) as error:
            self.say(one_line(error), "error")
        except MemoryError:
            self.say("not enough memory for this many particles; lower nx", "error")
        except Exception as error:  # a mistake of ours: the class goes on, and whoever reads the terminal sees it
            traceback.print_exc()
            self.say(f"{type(error).__name__}: {one_line(error)}", "error")
        self.applied = max(self.applied, wish["id"])
        self.clock.granted(wish["at"])
        self.busy = None
        self.shown.touched()

    def say(self, text: str, kind: str = "info") -> None:
        """One line for the page."""
        self.message = {"kind": kind, "text": text}

    def compiling(self) -> None:
        """Tell the page before the main thread is busy for a second."""
        self.busy = "compiling"
        self.shown.publish()


def opened(variants: dict, variant: str, count: int) -> list[Panel]:
    """Panels at their start; if one cannot be, none stays behind."""
    with ExitStack() as stack:
        made = []
        for label in ("A", "B")[:count]:
            made.append(Panel(label, variants, variant))
            stack.callback(made[-1].close)
        stack.pop_all()
    return made


def unhurried(panel: Panel) -> float:
    """Steps a second at which there is time to watch: small scenes are over in a second otherwise. It only limits."""
    steps = panel.scene.t_end / panel.sim.longest if panel.sim.longest > 0 else 0.0
    return float(min(max(SMOOTH, round(steps / WATCH)), 1000.0))
