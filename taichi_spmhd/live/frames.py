"""Frames that wait to be fetched, and who looks at which size."""

import io
import threading
import time
from contextlib import contextmanager

from PIL import Image

QUALITY = 88  # of the JPEGs: dots of two pixels stay dots
LOOKING = 1.0  # seconds after its last request that a browser still counts as looking
MOST_SIZES = 3  # of one panel, drawn at a time


class Frame:
    """One picture; its JPEG is made by the first thread that reads it, not by the one that simulates."""

    def __init__(self, number: int, rgb):
        self.number, self.rgb, self.bytes, self.lock = number, rgb, None, threading.Lock()

    def jpeg(self) -> bytes:
        with self.lock:
            if self.bytes is None:
                file = io.BytesIO()
                Image.fromarray(self.rgb).save(file, "JPEG", quality=QUALITY)
                self.bytes, self.rgb = file.getvalue(), None
            return self.bytes


class Frames:
    """The last frame of each panel and size. Not safe by itself: the desk holds its lock around every call."""

    def __init__(self):
        self.last: dict[tuple, Frame] = {}
        self.seen: dict[tuple, float] = {}  # when somebody last asked
        self.waiting: dict[tuple, int] = {}

    def number(self, panel: int, size: tuple[int, int]) -> int:
        frame = self.last.get((panel, *size))
        return frame.number if frame else -1

    def get(self, panel: int, size: tuple[int, int]) -> Frame | None:
        return self.last.get((panel, *size))

    def add(self, panel: int, size: tuple[int, int], frame: Frame) -> None:
        """A new frame; those of sizes nobody looks at are dropped."""
        now, own = time.monotonic(), (panel, *size)
        self.last[own] = frame
        for key in [key for key in self.last if not self.looked_at(key, now) and key != own]:
            self.last.pop(key)
            self.seen.pop(key, None)

    def looked_at(self, key: tuple, now: float) -> bool:
        return bool(self.waiting.get(key)) or now - self.seen.get(key, -1e9) < LOOKING

    def wanted(self, now: float) -> list[tuple]:
        """The sizes somebody looks at, the newest three of each panel."""
        keys = sorted((key for key in self.seen if self.looked_at(key, now)), key=lambda key: -self.seen[key])
        return [key for n, key in enumerate(keys) if sum(other[0] == key[0] for other in keys[:n]) < MOST_SIZES]

    @contextmanager
    def look(self, panel: int, size: tuple[int, int]):
        """Somebody waits for this size."""
        key = (panel, *size)
        self.seen[key] = time.monotonic()
        self.waiting[key] = self.waiting.get(key, 0) + 1
        try:
            yield
        finally:
            self.waiting[key] -= 1
            if not self.waiting[key]:
                del self.waiting[key]
            self.seen[key] = time.monotonic()
            for old in [k for k, seen in self.seen.items() if k not in self.waiting and time.monotonic() - seen > 60]:
                del self.seen[old]
