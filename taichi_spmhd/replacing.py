"""A file that takes its place whole or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def replacing(path, ending: str = "") -> Iterator[Path]:
    """A temporary name beside `path`, which takes its place when all went well and vanishes otherwise.

    ending: of the temporary name, for writers that read the format from it.
    """
    path = Path(path)
    part = path.with_name(f".{path.name}.{os.getpid()}.part{ending}")
    try:
        yield part
        os.replace(part, path)
    finally:
        with suppress(OSError):  # the folder itself may be gone, or be no folder
            part.unlink(missing_ok=True)
