"""Study: the grid of settings that teaches something about a scene, declared in its file as STUDY.

    STUDY = Study({"nx": (16, 32, 64), "kernel": ("cubic", "quintic")}, variants=("xi = 1/2",), error="B")

`spmhd cost` runs it where the command line gives no grid of its own.
"""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Anchor:
    """Somebody else's curve, drawn beside ours: (resolution, seconds, error) a point; source: whose, where measured."""

    label: str
    points: tuple[tuple[float, float, float], ...]
    source: str


@dataclass(frozen=True)
class Study:
    """vary: {name: values} as `--vary` takes them; variants: labels (all by default); error: the one to quote
    (default: the scene's measure); anchors: curves to compare that error with, at the scene's t_end."""

    vary: dict[str, tuple] = field(default_factory=dict)
    variants: tuple[str, ...] = ()
    error: str | None = None
    anchors: tuple[Anchor, ...] = ()
