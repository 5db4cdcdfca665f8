"""`python -m taichi_spmhd.bench`: the child that measures, one JSON row a line on stdout."""

import sys

from .child import run

if __name__ == "__main__":
    sys.exit(run())
