"""The state of a run on disk: all it takes to go on with the same bits, written whole or not at all."""

import os
import zipfile
import zlib
from pathlib import Path

import numpy as np

from .diagnostics.ledger import Ledger
from .errors import InputError
from .neighbours import STORY
from .particles import COLD, HOT
from .replacing import replacing

FORMAT = 2  # 2: the largest h at the start, and the step at the last look
WORDS = {8: "f64", 4: "f32"}
NUMBERS = ("time", "dt", "longest", "seconds", "seconds_compile")
COUNTS = ("steps", "timed", "floors")
UNREADABLE = (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile, zlib.error, NotImplementedError)


def save(sim, path) -> None:
    """Write the state to `path` (.npz); a file that is there stays as it was until the new one is complete.

    Members are kept in memory order with the positions x0 of the last list build, so the list can be made again as it
    was; rates of the last evaluation belong to the state too. Raises InputError where the disk refuses.
    """
    sim.begin()
    path = Path(path)
    try:
        with replacing(path) as part, open(part, "wb") as file:
            np.savez(file, **content(sim))
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        why = error.strerror or error
        raise InputError(f"cannot write {path}: {why}; free space or choose another folder (--out DIR)") from error


def content(sim) -> dict[str, np.ndarray]:
    """The arrays of the file by name."""
    table, ids = sim.particles.table()
    ledger, kept = sim.ledger, own(sim)
    out = {"format": FORMAT, "precision": WORDS[table.itemsize], "columns": columns(sim)[kept], "ids": ids}
    out["table"] = table[:, kept]
    out.update({name: getattr(sim, name) for name in NUMBERS + COUNTS})
    out["scene"] = sim.scene.sketch()
    out.update({**vars(ledger), "before": sim.watch.before})
    out.update(sim.neighbours.story())
    out.update({f"rate_{name}": rate for name, rate in sim.particles.rates().items() if name in own_rates(sim)})
    return {name: np.asarray(value) for name, value in out.items()}


def columns(sim) -> np.ndarray:
    """Names of the table's columns: a member of several components repeats."""
    return np.array([name for name, kind, _ in sim.particles.layout for _ in range(kind)])


def own(sim) -> np.ndarray:
    """Which columns of the table belong to the scene's parts: a live run has room for other parts', too."""
    names = {name for part in sim.parts for name in part.members()} | {*HOT, *COLD, "held"}
    return np.isin(columns(sim), list(names))


def own_rates(sim) -> set:
    """The members that the scene's parts evolve."""
    return {name for part in sim.parts for name in part.evolves}


def load(cls, path, scene, spare=None):
    """A Simulation of `scene` that goes on where save stopped, to the same bits.

    Raises InputError for a file that is missing, damaged, foreign, or of another scene or precision.
    """
    saved = read(path)
    count, given = len(saved["table"]), len(scene.positions)
    if count != given:
        raise InputError(f"{path}: holds {count} particles, the scene has {given}; give the parameters the run had")
    sim = cls(scene, spare=spare)
    try:
        admit(sim, path, saved)
        sim.begun = True
    except BaseException:
        sim.close()
        raise
    return sim


def read(path) -> dict[str, np.ndarray]:
    """All arrays of the file, checked for what can be checked without a scene."""
    try:
        with np.load(path, allow_pickle=False) as file:
            saved = {name: file[name] for name in file.files}
        version, table = int(saved["format"]), saved["table"]
        whole = table.ndim == 2 and np.array_equal(np.sort(saved["ids"]), np.arange(len(table)))
    except FileNotFoundError as error:
        raise InputError(f"{path}: there is no such state; leave out --resume to start anew") from error
    except (*UNREADABLE, AttributeError, TypeError) as error:
        raise InputError(
            f"{path}: not a state of a run, or damaged; remove it and start anew without --resume"
        ) from error
    if version != FORMAT:
        raise InputError(f"{path}: state format {version}, this version reads {FORMAT}; start anew without --resume")
    bad = [name for name, values in saved.items() if values.dtype.kind == "f" and not np.isfinite(values).all()]
    if bad or not whole:
        what = f"{bad[0]} is not finite" if bad else "particles are missing or double"
        raise InputError(f"{path}: {what}; remove it and start anew without --resume")
    return saved


def admit(sim, path, saved: dict) -> None:
    """Put a checked file into a simulation just built."""
    p = sim.particles
    runs = WORDS[p.word().itemsize]
    if str(saved["precision"]) != runs:
        raise InputError(
            f"{path}: saved in {saved['precision']}, this process runs {runs}; add --precision {saved['precision']}"
        )
    if str(saved.get("scene")) != sim.scene.sketch():
        raise InputError(
            f"{path}: saved by another scene, {saved.get('scene')}; give the scene and parameters the run had"
        )
    try:
        rates = {**p.rates(), **{name: saved[f"rate_{name}"] for name in own_rates(sim)}}
        numbers = {name: saved[name].item() for name in (*NUMBERS, *COUNTS, *STORY, "E0", "v_rms", "widest", "before")}
        ledger = Ledger(numbers["E0"], saved["p0"], numbers["v_rms"], numbers["widest"])
    except (KeyError, ValueError) as error:
        raise InputError(f"{path}: {error} is missing; give the scene and parameters the run had") from error
    kept = own(sim)
    if list(saved["columns"]) != list(columns(sim)[kept]) or saved["table"].shape != (p.n, kept.sum()):
        other = sorted(set(saved["columns"]) ^ set(columns(sim)[kept]))
        raise InputError(
            f"{path}: saved by a scene with other members ({', '.join(other)}); list the terms the run had"
        )
    table = np.zeros((p.n, p.width), saved["table"].dtype)
    table[:, kept] = saved["table"]
    p.admit(table, saved["ids"].astype(np.int32))
    p.admit_rates(rates)
    sim.neighbours.retell(numbers)
    sim.neighbours.rebuild()
    sim.ledger, sim.watch.before = ledger, numbers["before"]
    for name in NUMBERS + COUNTS:
        setattr(sim, name, numbers[name])
