"""Recorder: pictures, films, states and scene files of a live run, in one folder and nowhere else.

Names are numbered and no file that is there is written over. The folder is made when the first thing is written.
"""

import io
from dataclasses import replace
from importlib.util import find_spec
from itertools import count
from pathlib import Path

import numpy as np
from PIL import Image

from ..errors import InputError
from ..library import slug
from ..outputs.files import make, write_text, writing
from ..render import Panels, columns, write_gif, write_mp4, write_png

MOST_FRAMES = 600  # of a film; then it ends by itself
SECONDS_PER_FRAME = 0.1
WIDTH = 1000  # pixels of a frame


class Recorder:
    """folder: where everything goes."""

    def __init__(self, folder: Path):
        self.folder = Path(folder)
        self.shots: list[bytes] = []  # PNGs of the film being recorded
        self.panels = None  # what draws its frames

    def free(self, stem: str, ending: str) -> Path:
        """The next name that is not taken."""
        if self.folder.exists() and not self.folder.is_dir():
            raise InputError(f"--out {self.folder}: this is a file; choose a folder")
        names = (self.folder / f"{stem}_{n:03d}.{ending}" for n in count(1))
        return next(path for path in names if not path.exists())

    def png(self, sims: dict, picture, limits: tuple[float, float], title: str) -> str:
        """A frame with axes, colours and the terms in words, as a run draws them; returns its name."""
        path = self.free("picture", "png")
        with writing(path):
            write_png(path, self.drawn(frames_of(sims, picture, limits, title), sims))
        return path.name

    def drawn(self, panels: Panels, sims: dict) -> np.ndarray:
        time = max(sim.time for sim in sims.values())
        return panels.frame(time, {label: columns(sim, panels.picture) for label, sim in sims.items()})

    def begin(self, sims: dict, picture, limits: tuple[float, float], title: str) -> None:
        """A film that looks from its first frame to its last as things look now."""
        self.shots, self.panels = [], frames_of(sims, picture, limits, title)

    def shoot(self, sims: dict) -> bool:
        """One more frame; False once the film is as long as films may be, or cannot go on with these panels."""
        if self.panels is None or list(sims) != self.panels.variants or len(self.shots) >= MOST_FRAMES:
            return False
        file = io.BytesIO()
        Image.fromarray(self.drawn(self.panels, sims)).save(file, "PNG", compress_level=1)
        self.shots.append(file.getvalue())
        return True

    def stop(self) -> list[str]:
        """Write the film that was recorded, as GIF and, where ffmpeg is installed, as MP4; the names."""
        shots, panels = self.shots, self.panels
        self.shots, self.panels = [], None
        if not shots:
            return []
        path = self.free("film", "gif")
        with writing(path):
            write_gif(path, map(pixels, shots), SECONDS_PER_FRAME, palette=panels.palette())
        if find_spec("imageio_ffmpeg") is None:
            return [path.name]
        with writing(path.with_suffix(".mp4")):
            write_mp4(path.with_suffix(".mp4"), map(pixels, shots), fps=1 / SECONDS_PER_FRAME)
        return [path.name, path.with_suffix(".mp4").name]

    def state(self, sim, label: str) -> list[str]:
        """All it takes to go on: `Simulation.load` with the recorded scene file."""
        path = self.free(f"state_{slug(label)}", "npz")
        make(self.folder)
        sim.save(path)
        return [path.name]

    def text(self, stem: str, content: str) -> str:
        """A scene file."""
        path = self.free(stem, "py")
        make(self.folder)
        write_text(path, content)
        return path.name


def pixels(shot: bytes) -> np.ndarray:
    """A frame (H, W, 3) from its PNG."""
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"))


def frames_of(sims: dict, picture, limits: tuple[float, float], title: str) -> Panels:
    """Panels that draw these simulations."""
    scene = next(iter(sims.values())).scene
    fixed = replace(picture, limits=tuple(limits), width=WIDTH)
    terms = {label: tuple(sim.scene.terms) for label, sim in sims.items()}
    return Panels(list(sims), scene.box, fixed, title=title, terms=terms, periodic=scene.boundary.periodic)
