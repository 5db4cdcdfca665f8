"""Film: the frames of a run, all variants side by side, and the film made of them."""

from dataclasses import replace

from .files import writing
from .folder import Folder
from .plan import Plan

SECONDS_PER_FRAME = 0.1


class Film:
    """Draws frames into the folder. Colour limits are those of the first frame and are kept in run.json."""

    def __init__(self, plan: Plan, folder: Folder):
        self.plan, self.folder = plan, folder
        self.scene = next(iter(plan.variants.values()))
        self.ended: dict[str, str] = {}  # labels of variants that went wrong, with what stands above their panel
        self.panels = self.arrange()

    def arrange(self):
        """Panels with the limits known so far."""
        from ..render import Panels

        picture, limits = self.scene.picture, self.folder.record.get("limits") or self.scene.picture.limits
        if limits:
            picture = replace(picture, limits=tuple(limits))
        scenes = {self.shown(label): scene for label, scene in self.plan.variants.items()}
        terms = {label: tuple(scene.terms) for label, scene in scenes.items()}
        periodic = self.scene.boundary.periodic
        return Panels(list(scenes), self.scene.box, picture, title=self.plan.title, terms=terms, periodic=periodic)

    def shown(self, label: str) -> str:
        """What stands above a variant's panel."""
        return self.ended.get(label, label)

    def stop(self, label: str, time: float) -> None:
        """From now on this variant's panel shows its last good state and says so."""
        self.ended[label] = f"{label}: went wrong, last good state t = {time:.3g}"
        self.panels = self.arrange()

    def check(self, sims: dict) -> None:
        """Raises InputError for a picture that cannot be drawn."""
        from ..render import columns

        for sim in sims.values():
            columns(sim, self.scene.picture)

    def draw(self, k: int, time: float, sims: dict) -> None:
        """Write frame k."""
        from ..render import columns, write_png

        picture = self.scene.picture
        rgb = self.panels.frame(time, {self.shown(label): columns(sim, picture) for label, sim in sims.items()})
        if "limits" not in self.folder.record:
            self.folder.update(limits=[float(limit) for limit in self.panels.limits])
        path = self.folder.frame(k)
        with writing(path):
            write_png(path, rgb)

    def write(self) -> None:
        """Make the film of the frames on the disk."""
        from ..render import write_gif, write_mp4

        frames = [path for path in map(self.folder.frame, range(self.plan.frames)) if path.exists()]
        path = self.folder.film(self.folder.record)
        if self.plan.movie == "none" or not frames:
            return
        with writing(path):
            if self.plan.movie == "gif":
                write_gif(path, frames, SECONDS_PER_FRAME, palette=self.panels.palette())
            else:
                write_mp4(path, frames, fps=1 / SECONDS_PER_FRAME)
