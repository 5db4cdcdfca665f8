"""`spmhd stability`: the hard cases, which stay sound, how far from trouble."""

from .asked import start


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser("stability", parents=[common], help="the hard cases: which stay sound, and the margin")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="the hardest of each, small, one preset (the default)")
    size.add_argument("--full", action="store_true", help="all values and presets, and beyond until something fails")
    parser.add_argument("--only", nargs="+", action="extend", metavar="NAME", help="only these cases")
    parser.add_argument(
        "--preset", nargs="+", action="extend", metavar="NAME", help="only these of textbook, usual, robust, godunov"
    )
    parser.add_argument("--out", metavar="DIR", help="folder for the files (default out/stability)")
    parser.set_defaults(command=main)


def main(args) -> int:
    """Run the battery."""
    from ..stability import command

    return command.main(args, start(args))
