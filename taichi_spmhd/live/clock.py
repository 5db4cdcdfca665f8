"""When the next step is due, and what share of the time stepping takes."""

import time

WINDOW = 2.0  # seconds over which shares are taken


class Clock:
    """Seconds spent in steps and frames drawn, over the last two seconds."""

    def __init__(self):
        self.last, self.begun, self.spent, self.frames = 0.0, time.monotonic(), 0.0, 0
        self.share, self.frames_per_s, self.answer_ms = 0.0, 0.0, 0.0

    def due(self, speed: float) -> bool:
        """Whether a step may begin: at most `speed` a second, 0 for no limit."""
        return not speed or time.monotonic() - self.last >= 1 / speed

    def rest(self, speed: float, most: float) -> float:
        """Seconds until one is due."""
        wait = 1 / speed - (time.monotonic() - self.last) if speed else 0.0
        return min(max(wait, 0.0), most)

    def stepped(self, seconds: float) -> None:
        """A step ended."""
        self.last, self.spent = time.monotonic(), self.spent + seconds
        self.turn()

    def granted(self, asked: float) -> None:
        """A wish that was put on the desk at that moment has been granted."""
        self.answer_ms = 1e3 * (time.monotonic() - asked)

    def drew(self) -> None:
        """A frame was drawn."""
        self.frames += 1
        self.turn()

    def turn(self) -> None:
        """Close the window when it is full."""
        passed = time.monotonic() - self.begun
        if passed > WINDOW:
            self.share, self.frames_per_s = self.spent / passed, self.frames / passed
            self.begun, self.spent, self.frames = time.monotonic(), 0.0, 0

    def figures(self) -> dict:
        """share of the time in steps; frames drawn a second; milliseconds until the last wish was granted."""
        return {"share": self.share, "frames_per_s": self.frames_per_s, "answer_ms": self.answer_ms}
