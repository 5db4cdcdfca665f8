"""Look: what the panels draw, and with which colours."""

from dataclasses import replace

import numpy as np

from ..picture import Picture
from . import view

KEYS = ("member", "axis", "draw", "limits", "log")


class Look:
    """A Picture and whether field lines go over it; `limits` are those in force, chosen or taken from the particles."""

    def __init__(self, picture: Picture):
        self.picture, self.lines, self.limits = picture, False, picture.limits

    def change(self, wish: dict) -> None:
        """Other settings, of which any may be left out. Raises InputError for what cannot be drawn."""
        given = {key: wish[key] for key in KEYS if key in wish}
        if "limits" in given and given["limits"] is not None:
            given["limits"] = tuple(given["limits"])
        if {"member", "axis", "log"} & set(given):  # other numbers want other colours
            given = {"limits": None, "colours": None, **given}
            given = {"axis": None, **given} if "member" in given else given
        self.picture = replace(self.picture, **given)
        self.lines = bool(wish.get("lines", self.lines))
        if given:
            self.limits = self.picture.limits

    def settle(self, sims: list) -> tuple[float, float]:
        """The limits in force, from the particles where none were chosen; they stay until something else is drawn."""
        if self.limits is None:
            self.limits = tuple(float(limit) for limit in view.limits(sims, self.picture))
        return self.limits

    def fits(self, sim) -> bool:
        """Whether the simulation has what is drawn."""
        return self.picture.member in {entry["name"] for entry in view.names(sim)}

    def image(self, sim, sims: list, size: tuple[int, int]) -> np.ndarray:
        """The pixels of one panel, (H, W, 3)."""
        return view.image(sim, self.picture, self.settle(sims), size, self.lines)

    def colour_map(self) -> str:
        return self.picture.colour_map(self.limits or (0.0, 1.0))

    def described(self) -> dict:
        """For the page."""
        p = self.picture
        return {
            "member": p.member,
            "axis": p.axis,
            "draw": p.draw,
            "limits": list(self.limits) if self.limits else None,
            "automatic": p.limits is None,
            "log": p.log,
            "lines": self.lines,
            "symbol": p.symbol,
        }

    def names(self, sim) -> list[dict]:
        """What can be drawn."""
        return view.names(sim)
