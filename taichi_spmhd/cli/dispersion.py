"""`spmhd dispersion SCENE`: linear stability of the discrete equations."""

from .asked import add_scene, assignments, start


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser(
        "dispersion", parents=[common], help="which small waves grow, and how fast the others run"
    )
    add_scene(parser)
    parser.add_argument("--variant", nargs="+", action="extend", metavar="LABEL", help="only these variants")
    parser.add_argument("--scan", nargs="+", action="extend", default=[], metavar="NAME=A:B:N", help=SCAN)
    parser.add_argument("--lattice", metavar="NAME", help=LATTICE)
    parser.add_argument("--at", nargs="+", type=float, metavar="X", help="the state at this spot (default: the mean)")
    parser.add_argument("--out", metavar="DIR", help="folder for the files (default out/dispersion/SCENE)")
    parser.set_defaults(command=main)


SCAN = (
    "what varies, NAME=FROM:TO:COUNT (in the logarithm where the ends are far apart) or NAME=A,B,C: parameters of the "
    "scene, or kernel=cubic,wendland_c4, cleaning=..., TERM=on,off, TERM.NUMBER=... as in `spmhd cost`"
)
LATTICE = "line, hexagonal, square, cubic, close_packed or glass (default: the scene's own)"


def main(args) -> int:
    """Analyse, write, tell."""
    from ..dispersion import command

    given = assignments(args.set)
    start(args)
    return command.main(args, given)
