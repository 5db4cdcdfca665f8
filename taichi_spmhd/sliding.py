"""Numbers that slide while a run goes on: xi of a term, read from the device instead of being compiled in.

A term is written as ever, `self.xi`. In a headless run that is a constant of the compiled step. In a live run the term
is replaced by one that looks the same but whose numbers, those its class names in `live`, are read from a small field:
inside a kernel `self.xi` is the field's entry, in Python the number it holds. So a slider acts at the next step without
compiling anything, and a run without sliders pays nothing: it does not know of them.
"""

from numbers import Real

import numpy as np

from .runtime import ti


def numbers(part) -> dict[str, float]:
    """The numbers of a part that can slide, with their values; a rule or a choice in place of a number cannot."""
    values = {name: getattr(part, name) for name in part.live}
    return {name: float(value) for name, value in values.items() if isinstance(value, Real)}


@ti.data_oriented
class Sliding:
    """The sliding numbers of some parts: the device's field, and what it holds by (class name, number's name)."""

    def __init__(self, parts: tuple, tree):
        self.slots, self.held = {}, []
        for part in parts:
            for name, value in numbers(part).items():
                if self.slots.setdefault((type(part).__name__, name), len(self.held)) == len(self.held):
                    self.held.append(value)
        self.field = ti.field(float)
        tree.dense(ti.i, max(1, len(self.held))).place(self.field)

    def write(self) -> None:
        """Bring the numbers to the device, once its memory is there."""
        word = np.float64 if self.field.dtype == ti.f64 else np.float32
        self.field.from_numpy(np.array(self.held or [0.0], word))

    def put(self, part: str, name: str, value: float) -> None:
        """A new value, from the next evaluation on."""
        slot = self.slots[part, name]
        self.held[slot] = self.field[slot] = float(value)

    def take(self, part) -> None:
        """The values a part has."""
        for name, value in numbers(part).items():
            self.put(type(part).__name__, name, value)

    @ti.func
    def load(self, slot: ti.template()):
        return self.field[slot]

    def read(self, slot: int):
        """Inside a kernel the field's entry, outside the number."""
        return self.load(slot) if ti.lang.impl.inside_kernel() else self.held[slot]

    def knows(self, part) -> bool:
        """Whether all numbers of this part have a place here."""
        return all((type(part).__name__, name) in self.slots for name in numbers(part))

    def loose(self, part):
        """The same part with numbers that slide."""
        kind = type(part)
        slots = {name: self.slots[kind.__name__, name] for name in numbers(part)}
        if not slots:
            return part
        body = {name: property(lambda _, slot=slot: self.read(slot)) for name, slot in slots.items()}
        # equal numbers are not equal parts: each belongs to its own field
        same = {"__eq__": object.__eq__, "__hash__": object.__hash__, "__doc__": kind.__doc__}
        made = object.__new__(type(kind.__name__, (kind,), {**body, **same, "__module__": kind.__module__}))
        made.__dict__.update(part.__dict__)
        return made
