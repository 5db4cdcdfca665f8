"""The child: Taichi in one precision with one number of threads, rows on stdout as they are made."""

import argparse
import json
import sys

from .. import runtime
from ..outputs.files import plain
from . import cases, scale
from .measure import RUNS, row

MARK = "row: "  # what else is printed (by Taichi, by a library) is not a row


def run(argv=None) -> int:
    """Measure the cases asked for."""
    asked = options().parse_args(argv)
    runtime.init(asked.arch, asked.precision, asked.threads)
    sizes = cases.sizes(asked.sizes, asked.quick)
    for case in asked.cases:
        if asked.scale:
            tell(scale.row(case, asked.quick))
        else:
            tell(row(case, sizes[dimension(case)], 3 if asked.quick else RUNS))
    return 0


def dimension(case: str) -> str:
    """2d or 3d."""
    return "3d" if "3d" in case else "2d"


def tell(made: dict) -> None:
    """One row, one line."""
    print(MARK + json.dumps(plain(made)), flush=True)


def options() -> argparse.ArgumentParser:
    """What the parent says."""
    parser = argparse.ArgumentParser(prog="python -m taichi_spmhd.bench")
    parser.add_argument("--arch", default="cpu")
    parser.add_argument("--precision", default="f64")
    parser.add_argument("--threads", type=int)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--scale", action="store_true")
    parser.add_argument("--sizes", nargs="+")
    parser.add_argument("--cases", nargs="+", required=True)
    return parser


if __name__ == "__main__":
    sys.exit(run())
