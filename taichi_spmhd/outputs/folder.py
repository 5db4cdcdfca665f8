"""Folder: where the files of a run lie, whose they are, and whether a run in it can be taken up again."""

import os
from contextlib import suppress
from pathlib import Path

from ..errors import InputError
from ..library import slug
from ..replacing import replacing
from .files import as_json, folder_at, make, put, read_json, write_text, writing
from .record import sound

CURES = {
    "scene file": "the scene file has changed since the run was started; start anew without --resume",
    "scene": "choose that run's scene, or another folder with --out",
}


class Folder:
    """The files of a run: frames/0000.png, history_*.csv, state_*.npz, summary.json, table.md, film, and run.json.

    Beside a state stands the one before it, state_*.previous.npz, as long as the run has not ended; failure_*.png is
    the place where a variant went wrong. run.json says what the run is and so which files are its own.
    """

    def __init__(self, root):
        self.root = folder_at(root)
        self.record: dict = {}
        if self.frames.exists() and not self.frames.is_dir():
            raise InputError(f"--out {self.root}: {self.frames} is a file; remove it or give another folder")

    @property
    def frames(self) -> Path:
        return self.root / "frames"

    @property
    def summary(self) -> Path:
        return self.root / "summary.json"

    @property
    def table(self) -> Path:
        return self.root / "table.md"

    def frame(self, k: int) -> Path:
        return self.frames / f"{k:04d}.png"

    def history(self, label: str) -> Path:
        return self.root / f"history_{slug(label)}.csv"

    def state(self, label: str) -> Path:
        return self.root / f"state_{slug(label)}.npz"

    def failure(self, label: str) -> Path:
        """The place where a variant went wrong."""
        return self.root / f"failure_{slug(label)}.png"

    def previous(self, label: str) -> Path:
        """The state before the last, which a run keeps until it has ended."""
        return self.root / f"state_{slug(label)}.previous.npz"

    def film(self, record: dict) -> Path:
        return self.root / f"{record['scene']}.{record['movie']}"

    def earlier(self) -> dict | None:
        """What run.json says of the run in this folder."""
        record = read_json(self.root / "run.json")
        return record if sound(record) else None

    def own(self, record: dict) -> list[Path]:
        """Every file that a run with this record writes, run.json left out."""
        kinds = (self.history, self.state, self.previous, self.failure)
        each = [path(label) for label in record["variants"] for path in kinds]
        table = [self.table] if len(record["variants"]) > 1 else []
        return [self.summary, *table, self.film(record), *each, *map(self.frame, range(record["frames"]))]

    def check(self, record: dict) -> None:
        """Raises InputError where starting anew would touch what is not this scene's."""
        before = self.earlier()
        if before and before["scene"] != record["scene"]:
            raise InputError(f"--out {self.root} holds a run of {before['scene']}; choose another folder with --out")
        ours = (self.root / "run.json", *self.own(record))
        strange = [path for path in ours if path.exists()] if before is None else []
        if strange:
            raise InputError(f"{strange[0]} is there, but no run of ours made it; choose another folder with --out")

    def claim(self, record: dict) -> None:
        """Begin anew: what an earlier run of this scene left is removed, once the disk has taken the new run.json."""
        self.check(record)
        make(self.frames)
        with writing(self.root / "run.json"), replacing(self.root / "run.json") as part:
            put(part, as_json(record))
            before = self.earlier()
            for path in self.own(before) if before else []:
                path.unlink(missing_ok=True)
        self.record = dict(record)

    def update(self, **more) -> None:
        """Add to run.json."""
        self.record.update(more)
        write_text(self.root / "run.json", as_json(self.record))

    def take_up(self, record: dict) -> dict:
        """The record of the run to be continued. Raises InputError if there is none or if it was another."""
        before = self.earlier()
        if before is None and (self.root / "run.json").exists():
            raise InputError(
                f"--resume: {self.root / 'run.json'} is damaged, or of no run of ours; start anew elsewhere"
            )
        if before is None:
            raise InputError(f"--resume: there is no run in {self.root}; leave out --resume to start one")
        for name, value in record.items():
            if before.get(name) != value:
                raise InputError(f"--resume: {difference(name, before.get(name), value)}")
        self.record = before
        make(self.frames)
        self.sweep()
        return before

    def end(self) -> None:
        """The run has ended: run.json says so, and then the states before the last may go."""
        self.update(finished=True)
        self.sweep()

    def sweep(self) -> None:
        """Remove what killed runs left half written, and what only a run on its way needs."""
        over = map(self.previous, self.record["variants"]) if self.record.get("finished") else ()
        for part in (*self.root.glob(".*.part*"), *self.frames.glob(".*.part*"), *over):
            with suppress(OSError):
                os.remove(part)


def difference(name: str, before, now) -> str:
    """In words: what the started run had and what is asked now."""
    if name in CURES:
        own = f"the run in this folder is of {before}, not {now}; " if name == "scene" else ""
        return own + CURES[name]
    if name == "parameters":
        before = before if isinstance(before, dict) else {}
        name = next((key for key in {**now, **before} if now.get(key) != before.get(key)), "parameters")
        before, now = before.get(name), now.get(name)
    return f"the started run had {name} = {before}, now it is {now}; give the same, or start anew without --resume"
