"""Progress of a run: a bar on a terminal, plain lines elsewhere, or nothing."""

import sys
import time

from .words import duration, rate, say

EVERY = 0.1  # share of the run between plain lines


class Silent:
    """Says nothing."""

    def note(self, text: str) -> None:
        """A line that is not progress."""

    def show(self, done: float, speed: float) -> None:
        """done: share of the run, 0 to 1; speed: particle updates per second, 0 where that has no meaning."""

    def end(self) -> None:
        """Nothing more will come."""


class Lines(Silent):
    """A line for every tenth of the run."""

    def __init__(self):
        self.last, self.first, self.clock = None, 0.0, 0.0

    def note(self, text: str) -> None:
        say(text)

    def show(self, done: float, speed: float) -> None:
        now = time.monotonic()
        if self.last is None:
            self.last, self.first, self.clock = done, done, now
        elif done >= self.last + EVERY or (done >= 1 > self.last):
            left = (now - self.clock) * (1 - done) / (done - self.first)
            self.last = done
            words = [f"{100 * done:4.0f} %", *([rate(speed)] if speed else [])]
            say(", ".join([*words, *([f"about {duration(left)} left"] if done < 1 else [])]))


class Bar(Silent):
    """Percent, time left and speed in one line that stays where it is."""

    def __init__(self):
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

        speed, left = TextColumn("{task.fields[speed]}"), TextColumn("left")
        self.bar = Progress(BarColumn(), TaskProgressColumn(), TimeRemainingColumn(), left, speed)
        self.task = self.bar.add_task("", total=1.0, speed="")
        self.bar.start()

    def note(self, text: str) -> None:
        self.bar.console.print(text, markup=False, highlight=False)

    def show(self, done: float, speed: float) -> None:
        self.bar.update(self.task, completed=done, speed=rate(speed) if speed else "")

    def end(self) -> None:
        self.bar.stop()


def progress(quiet: bool) -> Silent:
    """What suits the output."""
    if quiet:
        return Silent()
    return Bar() if sys.stdout.isatty() else Lines()
