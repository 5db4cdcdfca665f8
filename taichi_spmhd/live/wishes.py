"""Wishes that wait for the main thread: in order, few, and each worth granting."""

import time

MOST, MOST_PUSHES = 256, 64
SAME = {"number": ("do", "panel", "part", "name"), "draw": ("do",), "speed": ("do",)}  # a later one of these replaces
VOID = {"member": ("axis", "limits"), "axis": ("limits",), "log": ("limits",)}  # what a "draw" sets back by itself


class Full(Exception):
    """More than the run can grant."""


class Wishes:
    """Numbers rise along the queue, so whoever is told that number n was granted knows it of all before.

    Not safe by itself: the desk holds its lock around every call.
    """

    def __init__(self):
        self.waiting, self.given = [], 0

    def put(self, wish: dict) -> int:
        """At the end; in place of one it makes pointless. Returns its number. Raises Full."""
        before = pointless(wish, self.waiting)
        if before is None and (len(self.waiting) >= MOST or too_many_pushes(wish, self.waiting)):
            raise Full
        older = self.waiting.pop(before) if before is not None else {}
        self.given += 1
        self.waiting.append({**merged(older, wish), "id": self.given, "at": time.monotonic()})
        return self.given

    def take(self) -> list[dict]:
        """All of them."""
        taken, self.waiting = self.waiting, []
        return taken


def pointless(wish: dict, waiting: list) -> int | None:
    """Which waiting wish a later one makes pointless: a slider dragged on, other colour limits.

    Never across a wish of another kind: "xi = 0, step, xi = 1" is a step with xi = 0.
    """
    keys = SAME.get(wish["do"])
    for k in reversed(range(len(waiting)) if keys else ()):
        if all(wish.get(key) == waiting[k].get(key) for key in keys):
            return k
        if waiting[k]["do"] not in SAME:
            return None
    return None


def merged(older: dict, wish: dict) -> dict:
    """Both as one: a "draw" adds to what waits, less what it would have set back."""
    back = {key for name in VOID if name in wish for key in VOID[name]} if wish["do"] == "draw" else set()
    return {**{key: value for key, value in older.items() if key not in back}, **wish}


def too_many_pushes(wish: dict, waiting: list) -> bool:
    """A pointer dragged while the run compiles must leave room for "pause"."""
    return wish.get("kind") == "push" and sum(other.get("kind") == "push" for other in waiting) >= MOST_PUSHES
