"""The process that computes: Taichi in one precision with one number of threads; orders come in, results go out.

    python -m taichi_spmhd.cost.child --arch cpu --precision f64 --threads 2

One JSON object a line on stdin (measure.Bench.run says what is in it), one a line on stdout behind MARK.
"""

import argparse
import json
import sys

from .. import runtime
from ..errors import InputError, RunError
from ..outputs.files import plain
from ..outputs.words import one_line

MARK = "made: "  # what else is printed, by Taichi or by a scene file, is no result


def run(argv=None) -> int:
    """Serve until stdin ends: then nobody waits for an answer any more."""
    given = options().parse_args(argv)
    runtime.init(given.arch, given.precision, given.threads)
    from .measure import Bench

    bench = Bench()
    for line in sys.stdin:
        print(MARK + json.dumps(plain(answer(bench, json.loads(line)))), flush=True)
    return 0


def answer(bench, order: dict) -> dict:
    """The result of an order, or what went wrong with it."""
    try:
        return bench.run(order)
    except (InputError, RunError) as error:
        return {"wrong": one_line(error), **runtime.started()}
    except MemoryError:
        return {"wrong": "not enough memory", **runtime.started()}


def options() -> argparse.ArgumentParser:
    """What the parent says."""
    parser = argparse.ArgumentParser(prog="python -m taichi_spmhd.cost.child")
    parser.add_argument("--arch", default="cpu")
    parser.add_argument("--precision", default="f64")
    parser.add_argument("--threads", type=int)
    return parser


if __name__ == "__main__":
    sys.exit(run())
