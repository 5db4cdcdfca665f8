"""`spmhd` and `python -m taichi_spmhd`."""

import sys


def main(argv=None) -> int:
    """Run a command of the command line; returns its exit code."""
    from .cli import main as run

    return run(argv)


if __name__ == "__main__":
    sys.exit(main())
