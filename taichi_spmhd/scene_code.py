"""Running the code of a scene file, and laying what goes wrong in it at its door: file, line, one sentence."""

import re
import sys
from contextlib import contextmanager
from pathlib import Path
from types import CodeType

from .errors import InputError, RunError


def line_of(error: BaseException, path: Path) -> int | None:
    """The last line of the scene file that had to do with an error, or None: then it is not the file's doing."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno
    line, trace = None, error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(path):
            line = trace.tb_lineno
        trace = trace.tb_next
    inside = re.findall(rf'File "{re.escape(str(path))}", line (\d+)', str(error))  # as Taichi's messages say it
    return int(inside[-1]) if inside else line


def compiled(path: Path) -> CodeType:
    """The code of a scene file. Raises SyntaxError with a line, or InputError where Python names none."""
    try:
        return compile(path.read_bytes(), str(path), "exec")
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        if isinstance(error, SyntaxError) and error.filename == str(path) and error.lineno:
            raise
        raise InputError(f"{path.name} is no Python file: {error or 'it is nested too deeply'}") from error


@contextmanager
def code_of(path: Path):
    """Whatever the code of a scene file raises becomes an InputError of one line, with file name and line."""
    try:
        yield
    except (RunError, MemoryError):
        raise
    except (Exception, SystemExit) as error:
        line = line_of(error, path)
        if line is None:
            raise
        lines = [text.strip() for text in str(error).splitlines() if text.strip()]
        what = error.msg if isinstance(error, SyntaxError) else lines[-1] if lines else ""
        kind = "" if isinstance(error, InputError) else f"{type(error).__name__}: "
        raise InputError(f"{path.name}, line {line}: {kind}{what}") from error


@contextmanager
def beside(path: Path):
    """Modules in the scene file's folder can be imported while it runs; installed ones come first."""
    sys.path.append(str(path.parent))
    try:
        yield
    finally:
        sys.path.remove(str(path.parent))
