"""The desk between the main thread, which simulates, and the server's threads, which speak with browsers.

Wishes and questions are put on it, what was published lies on it; everything is bounded. Nobody who looks or asks can
hold up the main thread: it takes what is there and goes on.
"""

import threading
import time
from collections.abc import Callable

from .frames import Frame, Frames
from .plots import Plots
from .wishes import Full, Wishes

MOST_QUESTIONS = 32
GLANCE = 0.5  # seconds between two looks whether the one who waits is still there


def patient() -> bool:
    """Whoever never leaves."""
    return False


class Desk:
    """All methods may be called from any thread."""

    def __init__(self):
        self.changed = threading.Condition()
        self.wishes, self.questions_asked = Wishes(), []
        self.setup, self.state, self.seq = {}, {}, 0
        self.frames, self.plots = Frames(), Plots()
        self.stirred, self.closed = False, False

    # what the main thread does

    def take(self) -> list[dict]:
        """The wishes, in the order in which they came; each with its "id" and when it came, "at"."""
        with self.changed:
            return self.wishes.take()

    def questions(self) -> list[tuple[dict, Callable]]:
        """(question, answer) for each that waits: call answer(whatever)."""
        with self.changed:
            asked, self.questions_asked = self.questions_asked, []
            return asked

    def wait(self, seconds: float) -> None:
        """Sleep until a wish, a question or a look comes, or the time is over."""
        with self.changed:
            self.changed.wait_for(lambda: self.stirred or self.closed, seconds)
            self.stirred = False

    def publish_setup(self, setup: dict) -> None:
        """What can be chosen."""
        with self.changed:
            self.setup = setup

    def publish_state(self, state: dict) -> None:
        """What goes on; it gets the next number."""
        with self.changed:
            self.seq += 1
            self.state = {"seq": self.seq, **state}
            self.changed.notify_all()

    def add_rows(self, rows: list) -> None:
        """One row of the plots, a list of numbers for each panel."""
        with self.changed:
            self.plots.add(rows)

    def clear_rows(self) -> None:
        """The plots begin anew."""
        with self.changed:
            self.plots.clear()

    def wanted(self) -> list[tuple[int, int, int]]:
        """(panel, width, height) of the frames somebody looks at."""
        with self.changed:
            return self.frames.wanted(time.monotonic())

    def drawn(self, panel: int, size: tuple[int, int]) -> int:
        """The number of the last frame of this size, -1 for none."""
        with self.changed:
            return self.frames.number(panel, size)

    def publish_frame(self, panel: int, size: tuple[int, int], number: int, rgb) -> None:
        """A picture (H, W, 3) uint8; whoever reads it first makes a JPEG of it."""
        with self.changed:
            self.frames.add(panel, size, Frame(number, rgb))
            self.changed.notify_all()

    # what the server's threads do

    def put(self, wish: dict) -> int:
        """A wish for the main thread; returns its number. Raises Full."""
        with self.changed:
            number = self.wishes.put(wish)
            self.stir()
            return number

    def ask(self, question: dict, seconds: float):
        """The main thread's answer, or None if none came in time. Raises Full."""
        done, answer = threading.Event(), []

        def reply(value) -> None:
            answer.append(value)
            done.set()

        asked = (question, reply)
        with self.changed:
            if len(self.questions_asked) >= MOST_QUESTIONS:
                raise Full
            self.questions_asked.append(asked)
            self.stir()
        if not done.wait(seconds):
            self.withdraw(asked)
        return answer[0] if answer else None

    def withdraw(self, asked: tuple) -> None:
        """Nobody waits for this answer any more."""
        with self.changed:
            if asked in self.questions_asked:
                self.questions_asked.remove(asked)

    def state_after(self, seq: int, row: int, seconds: float, gone: Callable = patient) -> dict:
        """The state once its number is above `seq`, or when the time is over; with the plots' rows from `row` on.

        Before the first one was published there is none to be newer than anything: whoever asks waits, and is answered
        with number 0 and no more where it took too long.
        """
        with self.changed:
            self.until(lambda: self.seq > max(seq, 0), seconds, gone)
            return {"seq": self.seq, **self.state, "rows": self.plots.since(row)}

    def frame_after(
        self, panel: int, size: tuple[int, int], number: int, seconds: float, gone: Callable = patient
    ) -> Frame | None:
        """The frame once its number is above `number`, else the last one of this size; None if there is none."""
        with self.changed:
            with self.frames.look(panel, size):
                if self.frames.number(panel, size) <= number:
                    self.stir()
                    self.until(lambda: self.frames.number(panel, size) > number, seconds, gone)
            return self.frames.get(panel, size)

    def until(self, true: Callable, seconds: float, gone: Callable) -> None:
        """Sleep until it is true, the time is over, or nobody waits for it any more."""
        end = time.monotonic() + seconds
        while not (true() or self.closed or gone()) and (left := end - time.monotonic()) > 0:
            self.changed.wait(min(left, GLANCE))

    def stir(self) -> None:
        """Wake the main thread, if it sleeps."""
        self.stirred = True
        self.changed.notify_all()

    def close(self) -> None:
        """Let everybody go who waits."""
        with self.changed:
            self.closed = True
            self.changed.notify_all()
