"""What has a price: every term the scene lists, sets of terms one after the other, kernels, steppers."""

from dataclasses import dataclass

from ...choices import KERNELS, STEPPERS
from ...scene import Scene

OTHERS = ("cubic", "quintic", "wendland_c4")  # kernels beside the scene's own


@dataclass(frozen=True)
class Entry:
    """kind: whole, without (a term), upto (the terms so far), kernel or stepper; name: which; changes: choices.py."""

    kind: str
    name: str
    changes: tuple[tuple[str, object], ...] = ()


def entries(scene: Scene) -> list[Entry]:
    """All of a scene, the whole first."""
    terms = [type(term).__name__ for term in scene.terms]
    out = [Entry("whole", "")]
    out += [Entry("without", name, ((name, False),)) for name in terms]
    out += [Entry("upto", name, tuple((rest, False) for rest in terms[k:])) for k, name in enumerate(terms[:-1], 1)]
    out += [Entry("kernel", name, (("kernel", name),)) for name in OTHERS if KERNELS[name] is not type(scene.kernel)]
    return out + [
        Entry("stepper", name, (("stepper", name),))
        for name, kind in STEPPERS.items()
        if kind is not type(scene.stepper)
    ]
