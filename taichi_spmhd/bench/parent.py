"""Starting the children and reading their rows."""

import contextlib
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from .. import runtime
from ..errors import InputError, RunError
from .child import MARK

PACKAGE = Path(__file__).resolve().parents[2]  # where a child finds this package, installed or not


def measured(args, chosen, scale: bool) -> Iterator[dict]:
    """Rows, one child for each precision and number of threads."""
    for precision in runtime.PRECISIONS:
        mine = [case for case in chosen if case.endswith(precision)]
        for threads in counts(args, scale) if mine else ():
            yield from child(words(args, precision, threads, mine, scale))


def counts(args, scale: bool) -> list[int | None]:
    """Threads to measure with: what is asked for, else one and all; a GPU has no such number."""
    if args.arch in ("cuda", "vulkan", "metal"):
        return [None]
    if args.threads or scale:
        return [args.threads or 1]
    return sorted({1, os.cpu_count() or 1})


def words(args, precision: str, threads, mine, scale: bool) -> list[str]:
    """The command line of a child; `auto` is the CPU, whose numbers can be compared."""
    arch = "cpu" if args.arch == "auto" else args.arch
    out = ["--arch", arch, "--precision", precision, *(["--threads", str(threads)] if threads else [])]
    out += ["--quick"] * bool(args.quick) + ["--scale"] * scale
    given = getattr(args, "sizes", None)
    return [*out, *(["--sizes", *given] if given else []), "--cases", *mine]


def child(given: list[str]) -> Iterator[dict]:
    """Rows of one child, as they come. Raises InputError or RunError with its last line where it fails."""
    command = [sys.executable, "-m", "taichi_spmhd.bench", *given]
    path = os.pathsep.join([str(PACKAGE), *filter(None, [os.environ.get("PYTHONPATH")])])
    environment = {**os.environ, "PYTHONPATH": path, "PYTHONUNBUFFERED": "1"}
    with started(command, environment) as running:
        for line in running.stdout:
            if line.startswith(MARK):
                yield json.loads(line[len(MARK) :])
        said = running.stderr.read().strip().splitlines()
        if running.wait():
            kind = InputError if said and "InputError" in said[-1] else RunError
            raise kind(f"bench: {said[-1].split(': ', 1)[-1] if said else 'a child ended without a word'}")


@contextlib.contextmanager
def started(command, environment):
    """A running child, which does not outlive an interrupted parent."""
    pipe = subprocess.PIPE
    with subprocess.Popen(command, env=environment, stdout=pipe, stderr=pipe, text=True, encoding="utf-8") as running:
        try:
            yield running
        finally:
            running.kill()  # nothing happens to one that has ended


def hardware() -> str:
    """The machine."""
    return runtime.hardware()


def version() -> str:
    """The package's version."""
    from .. import __version__

    return __version__
