"""Plan: what a run was asked to do, as frozen settings; it is written to run.json so that --resume can compare."""

import hashlib
import importlib.util
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from .. import library
from ..errors import InputError
from ..scene import Scene
from .files import plain

MOVIES = ("gif", "mp4", "none")
MOST_FRAMES = 100_000  # a day of film; more is a slip of the pen


@dataclass(frozen=True, eq=False)
class Plan:
    """scene: name of the file without .py; variants: {label: Scene}; device: {"arch", "precision", "threads"}.

    Raises InputError for whatever can be seen to be wrong before anything is computed.
    """

    path: Path
    parameters: dict
    variants: dict[str, Scene]
    device: dict
    frames: int = 26
    movie: str = "gif"

    def __post_init__(self):
        if self.frames < 1:
            raise InputError(f"--frames {self.frames}: give at least 1 (the last state alone)")
        if self.frames > MOST_FRAMES:
            raise InputError(f"--frames {self.frames}: give at most {MOST_FRAMES}")
        if self.movie not in MOVIES:
            raise InputError(f"--movie {self.movie}: choose one of {', '.join(MOVIES)}")
        if self.movie == "mp4" and importlib.util.find_spec("imageio_ffmpeg") is None:
            raise InputError("--movie mp4 needs ffmpeg: pip install 'taichi-spmhd[movie]', or take --movie gif")
        ends = {label: scene.t_end for label, scene in self.variants.items()}
        if len(set(ends.values())) > 1:
            raise InputError(f"the variants end at different times {ends}; give one with --t-end")

    @property
    def name(self) -> str:
        return self.path.stem

    @property
    def t_end(self) -> float:
        return float(next(iter(self.variants.values())).t_end)

    @property
    def times(self) -> list[float]:
        """When frames are drawn, the start included; a single frame shows the end."""
        return [float(t) for t in np.linspace(0.0, self.t_end, self.frames)] if self.frames > 1 else [self.t_end]

    @property
    def title(self) -> str:
        """The first line of the scene file's docstring."""
        return library.sight(self.path).rstrip(".") or self.name

    def record(self) -> dict:
        """What --resume compares, under the names of the options."""
        return plain(
            {
                "scene": self.name,
                "scene file": hashlib.sha256(self.path.read_bytes()).hexdigest(),
                "parameters": self.parameters,
                "variants": list(self.variants),
                "frames": self.frames,
                "movie": self.movie,
                "t_end": self.t_end,
                "arch": self.device["arch"],
                "precision": self.device["precision"],
            }
        )


def chosen(variants: dict[str, Scene], wanted, t_end: float | None = None) -> dict[str, Scene]:
    """The variants asked for (all by default), in the scene's order, to end at t_end where that is given."""
    for label in wanted or ():
        if label not in variants:
            near = get_close_matches(label, variants, n=1, cutoff=0.4)
            hint = f" (did you mean {near[0]!r}?)" if near else ""
            raise InputError(f"--variant: no {label!r}{hint}; there are {', '.join(map(repr, variants))}")
    if t_end is not None and not 0 < t_end < float("inf"):
        raise InputError(f"--t-end {t_end:g}: give a time after the start, 0")
    kept = {label: scene for label, scene in variants.items() if not wanted or label in wanted}
    return kept if t_end is None else {label: scene.but(t_end=t_end) for label, scene in kept.items()}
