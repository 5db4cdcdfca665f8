"""The command: children one after another, a table, a JSON file."""

import datetime
import os
from pathlib import Path

from ..errors import InputError
from ..outputs.files import as_json, write_text
from ..outputs.words import say
from . import cases, parent, report

SCALE_CASES = ("mhd3d_f64", "mhd2d_f64")


def add_options(parser) -> None:
    """The options of `spmhd bench` beside those all commands have."""
    parser.add_argument("--json", metavar="FILE", help="write the rows to this file as well")
    parser.add_argument("--quick", action="store_true", help="fewer particles and runs")
    parser.add_argument("--cases", nargs="+", metavar="CASE", help="for example mhd3d_f64 hydro2d_f32 (default: all)")
    parser.add_argument("--sizes", nargs="+", metavar="2d=NX", help="particles along an axis (default 3d=32 2d=180)")
    parser.add_argument("--scale", action="store_true", help="time a particle at 3 10^4 and at 10^6 particles instead")


def main(args) -> int:
    """Measure and tell; returns 0. Raises InputError for unknown cases, sizes and files that cannot be written."""
    scale = getattr(args, "scale", False)
    chosen = cases.known(args.cases or (SCALE_CASES if scale else None))
    cases.sizes(getattr(args, "sizes", None), args.quick)
    path = target(args.json)
    made = {"hardware": parent.hardware(), "version": parent.version(), "date": now(), "scale" if scale else "rows": []}
    rows = made["scale" if scale else "rows"]
    if not args.quiet:
        say(f"{made['hardware']}; taichi_spmhd {made['version']}, {made['date']}")
    for row in parent.measured(args, chosen, scale):
        rows.append(row)
        if path:
            write_text(path, as_json(made))  # what is measured is kept, whatever happens next
        if not args.quiet and not scale:
            say(report.line(row))
    if not args.quiet:
        report.scale_table(rows) if scale else report.tables(rows)
    return 0


def target(name) -> Path | None:
    """The JSON file, refused before minutes are spent."""
    if not name:
        return None
    path = Path(name)
    if path.is_dir():
        raise InputError(f"--json {name}: this is a folder; name a file in it, as in {path / 'bench.json'}")
    if not path.parent.is_dir() or not os.access(path.parent, os.W_OK):
        raise InputError(f"--json {name}: the folder {path.parent} is not there or not writable; choose another")
    return path


def now() -> str:
    """Date and time, UTC."""
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
