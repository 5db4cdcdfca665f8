"""The picture of the place where a variant went wrong; nothing that happens here may hide what went wrong itself."""

from pathlib import Path

from ..errors import RunError
from .words import one_line


def photograph(sim, error: RunError, path: Path) -> str:
    """Write it from the state as it is. Returns nothing, or, to be added to the error, why there is no picture."""
    if error.particle is None:
        return ""
    try:
        from ..render import write_png
        from ..render.place import place

        write_png(path, place(sim, error))
        return ""
    except Exception as problem:  # a full disk, or whatever else: the error that is being told matters more
        return f"; no picture of the place: {one_line(getattr(problem, 'strerror', None) or problem)}"
