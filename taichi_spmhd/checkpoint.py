"""The state of a run on disk: all it takes to go on with the same bits, written whole or not at all."""

from pathlib import Path

import numpy as np

from .diagnostics.ledger import Ledger
from .errors import InputError, RunError
from .neighbours import STORY
from .particles import COLD, HOT
from .replacing import replacing
from .stored import COUNTS, CURE, FORMAT, LEDGER, NUMBERS, Lost, check_alike, number, read

WORDS = {8: "f64", 4: "f32"}


def save(sim, path, previous=None) -> None:
    """Write the state to `path` (.npz); a file that is there stays as it was until the new one is complete.

    previous: where it stays after that. Members are kept in memory order with the positions x0 of the last list build,
    so the list can be made again as it was; rates of the last evaluation belong to the state too. Raises InputError
    where the disk refuses.
    """
    sim.begin()
    path = Path(path)
    try:
        with replacing(path, previous=previous) as part, open(part, "wb") as file:
            np.savez(file, **content(sim))
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

    Raises Lost for a file that is missing or damaged, InputError for one of another scene or precision.
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


def admit(sim, path, saved: dict) -> None:
    """Put a checked file into a simulation just built."""
    check_same(sim, path, saved)
    numbers = check_whole(sim, path, saved)
    p, kept = sim.particles, own(sim)
    table = np.zeros((p.n, p.width), saved["table"].dtype)
    table[:, kept] = saved["table"]
    p.admit(table, saved["ids"])
    p.admit_rates({name: saved.get(f"rate_{name}", rate) for name, rate in p.rates().items()})
    sim.neighbours.retell(numbers)
    try:
        sim.neighbours.rebuild()
    except RunError as error:
        raise Lost(f"{path}: {error}; {CURE}") from error
    sim.ledger = Ledger(numbers["E0"], saved["p0"], numbers["v_rms"], numbers["widest"])
    sim.watch.before = numbers["before"]
    for name in NUMBERS + COUNTS:
        setattr(sim, name, numbers[name])


def check_same(sim, path, saved: dict) -> None:
    """Raises InputError for a state of another precision, scene or set of members."""
    runs = WORDS[sim.particles.word().itemsize]
    if str(saved["precision"]) != runs:
        raise InputError(
            f"{path}: saved in {saved['precision']}, this process runs {runs}; add --precision {saved['precision']}"
        )
    if str(saved["scene"]) != sim.scene.sketch():
        raise InputError(f"{path}: saved by another scene, {saved['scene']}; give the scene and parameters the run had")
    mine = columns(sim)[own(sim)]
    if list(saved["columns"]) != list(mine):
        other = sorted(set(saved["columns"]) ^ set(mine))
        raise InputError(
            f"{path}: saved by a scene with other members ({', '.join(other)}); list the terms the run had"
        )


def check_whole(sim, path, saved: dict) -> dict[str, float | int]:
    """The numbers of a state. Raises Lost where one is missing, or an array is, or is of another shape."""
    p = sim.particles
    rates, (now, ids) = p.rates(), p.table()
    wanted = {f"rate_{name}": rates[name] for name in own_rates(sim)}
    check_alike(path, saved, {"table": now[:, own(sim)], "ids": ids, "p0": np.zeros(3), **wanted})
    return {name: number(path, saved, name) for name in (*NUMBERS, *COUNTS, *STORY, *LEDGER)}
