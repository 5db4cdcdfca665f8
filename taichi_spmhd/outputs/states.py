"""state_<variant>.npz and the one before it: a state that is lost costs a run one frame."""

import os
from collections.abc import Callable

from ..checkpoint import Lost
from ..replacing import sync_folder
from ..simulation import Simulation
from .files import writing
from .folder import Folder


def any_of(folder: Folder, label: str) -> bool:
    """Whether a variant has been saved."""
    return folder.state(label).exists() or folder.previous(label).exists()


def load(folder: Folder, label: str, scene, note: Callable[[str], None]) -> tuple[Simulation, bool]:
    """A variant as it was last saved, and False; or as it was saved before, and True, where the last state is lost.

    note: told so in one line. Raises InputError where neither can be used.
    """
    state, previous = folder.state(label), folder.previous(label)
    try:
        return Simulation.load(state, scene), False
    except Lost as lost:
        if not previous.exists():
            raise
        sim, said = before(previous, scene, lost), why(lost)
    with writing(state):  # at once: the next state to be written must not push out the good one
        os.replace(previous, state)
        sync_folder(folder.root)
    note(f"{said}; going on from the state before it, t = {sim.time:.6g}")
    return sim, True


def before(previous, scene, lost: Lost) -> Simulation:
    """The state before. Raises Lost, which names both, where it cannot be used either."""
    try:
        return Simulation.load(previous, scene)
    except Lost as error:
        raise Lost(f"{why(lost)}; {why(error)}; start anew without --resume") from error


def why(lost: Lost) -> str:
    """What is wrong, without the cure."""
    return str(lost).rsplit("; ", 1)[0]
