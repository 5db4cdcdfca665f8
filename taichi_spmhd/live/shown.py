"""What the page sees of a session: frames, state and rows of the plots, handed to the desk."""

import math
import time

from ..errors import InputError
from ..outputs.words import one_line
from .readings import COLUMNS

RARELY = 1.0  # seconds between two rows, at the most
FRAME, STATE, ROW = 1 / 30, 0.1, 0.25  # seconds between two frames, states and rows, at the least
EFFORT = 0.06  # share of the time that rows may take
LOOKING, SMOOTH = 0.35, 1 / 20  # share of the time that frames may take; seconds between two that look smooth
FILM_FRAMES = 100  # of a film that covers the scene's whole time
MOST_FILES = 50


class Shown:
    """`number` counts what can be seen: it rises with every step and every wish granted."""

    def __init__(self, session):
        self.session, self.desk = session, session.desk
        self.number, self.files = 0, []
        self.due = {"frame": 0.0, "state": 0.0, "row": 0.0}
        self.stale, self.filming, self.next_shot = True, False, 0.0

    def stepped(self) -> None:
        """After every step; where the run rests after it, its last state is measured, too."""
        self.number += 1
        self.stale = True
        if not self.session.playing:
            self.due["row"] = 0.0
        for panel in self.session.going:
            panel.readings.listen(panel.sim)
        self.measure()
        self.shoot()

    def update(self) -> None:
        """After every round of the loop."""
        self.draw()
        if self.stale and self.ready("state", STATE):
            self.publish()

    def touched(self) -> None:
        """A wish was granted: show it at once."""
        self.number += 1
        self.due["frame"] = 0.0
        self.publish()

    def anew(self) -> None:
        """The run begins again: empty plots, with their first row."""
        self.number += 1
        self.desk.clear_rows()
        self.session.arrived = False
        self.due["row"] = 0.0
        self.measure()

    def ready(self, what: str, apart: float) -> bool:
        """Whether it is time again for one of these."""
        now = time.monotonic()
        if now < self.due[what]:
            return False
        self.due[what] = now + apart
        return True

    def measure(self) -> None:
        """A row of the plots, as often as a tenth of the time allows."""
        if not self.ready("row", ROW):
            return
        clock = time.monotonic()
        self.desk.add_rows([self.row(panel) for panel in self.session.panels])
        wait = (time.monotonic() - clock) / EFFORT  # the first row compiles: that must not keep the next one away
        self.due["row"] = max(self.due["row"], clock + min(wait, RARELY))

    def row(self, panel) -> list:
        """The readings of one panel; numbers that are none become null."""
        if panel.failed:
            return [None] * len(COLUMNS)
        return [whole(value) for value in panel.readings.row(panel.sim, panel.ms, panel.updates)]

    def draw(self) -> None:
        """The frames somebody waits for."""
        panels, sims = self.session.panels, self.session.sims
        wanted = [
            (k, w, h) for k, w, h in self.desk.wanted() if k < len(panels) and self.desk.drawn(k, (w, h)) != self.number
        ]
        if not wanted or not self.ready("frame", FRAME):
            return
        clock = time.monotonic()
        for k, w, h in wanted:
            rgb = self.session.look.image(panels[k].sim, sims, (w, h))
            self.desk.publish_frame(k, (w, h), self.number, rgb)
        cost = time.monotonic() - clock
        self.due["frame"] = clock + max(FRAME, min(cost / LOOKING, SMOOTH), 1.5 * cost)
        self.session.clock.drew()

    def publish(self) -> None:
        """The state, as plain data."""
        session, self.stale = self.session, False
        self.desk.publish_state(
            {
                "setup": session.version,
                "playing": session.playing,
                "speed": session.speed,
                "applied": session.applied,
                "frame": self.number,
                "busy": session.busy,
                "message": session.message,
                "recording": self.filming,
                "files": self.files[-MOST_FILES:],
                "clock": session.clock.figures(),
                "panels": [self.figures(panel) for panel in session.panels],
            }
        )

    def figures(self, panel) -> dict:
        """What stands under a panel."""
        sim, readings = panel.sim, panel.readings
        numbers = {"ms": panel.ms, "updates": panel.updates, "growth": readings.growth()}
        numbers |= {name: readings.last.get(name) for name in ("mean_gap", "smallest_gap", "close_pairs")}
        return {
            "label": panel.label,
            "t": sim.time,
            "steps": sim.steps,
            "dt": whole(sim.dt),
            "particles": len(sim),
            "failed": panel.failed,
            "growth_predicted": None,
            **{name: whole(value) for name, value in numbers.items()},
        }

    def note(self, names: list[str]) -> None:
        """Files that were written."""
        self.files += names
        if names:
            self.session.say(f"written: {', '.join(names)} in {self.session.recorder.folder}")

    def film(self) -> None:
        """Begin a film; its frames are evenly spaced in the scene's time."""
        if self.filming:
            raise InputError("a film is being recorded; stop it first")
        session = self.session
        limits = session.look.settle(session.sims)
        session.recorder.begin(session.shots, session.look.picture, limits, session.title)
        self.filming, self.next_shot = True, -1.0
        self.shoot()

    def shoot(self) -> None:
        """A frame of the film, when its time has come; the film ends where it cannot go on."""
        session, now = self.session, self.session.first.sim.time
        if not self.filming or (0 <= self.next_shot - now <= session.first.scene.t_end / FILM_FRAMES):
            return
        self.next_shot = now + session.first.scene.t_end / FILM_FRAMES
        try:
            if not session.recorder.shoot(session.shots):
                self.note(self.end_film())
        except InputError as error:  # nobody asked just now: the run goes on without its film
            self.filming = False
            session.say(one_line(error), "error")

    def end_film(self) -> list[str]:
        """Write the film; its names."""
        self.filming = False
        return self.session.recorder.stop()


def whole(value):
    """A number for JSON: None where it is none."""
    return None if value is None or not math.isfinite(value) else float(value)
