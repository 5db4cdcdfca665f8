"""`spmhd cost SCENE`: what accuracy costs in time."""

from .asked import add_scene, assignments


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser("cost", parents=[common], help="error and seconds side by side, by method and size")
    add_scene(parser)
    parser.add_argument("--vary", nargs="+", action="extend", default=[], metavar="NAME=A,B", help=VARY)
    parser.add_argument("--variant", nargs="+", action="extend", metavar="LABEL", help="only these variants")
    parser.add_argument("--error", metavar="MEMBER", help="the error to quote, as rho, B or B_z (default: the scene's)")
    parser.add_argument("--t-end", type=float, metavar="T", help="end at this time (default: the scene's)")
    parser.add_argument("--repeat", type=int, metavar="R", help="runs of each setting (default 3)")
    parser.add_argument("--budget", type=float, metavar="SECONDS", help="stop starting runs after so long")
    parser.add_argument("--effects", action="store_true", help="the price list: what each term and choice costs a step")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="N runs side by side (default 1)")
    parser.add_argument("--cluster", metavar="ADDRESS", help="run on this Dask cluster, as tcp://host:8786")
    parser.add_argument("--out", metavar="DIR", help="folder for the files (default out/cost/SCENE)")
    parser.add_argument("--resume", action="store_true", help="go on with the study in --out")
    parser.set_defaults(command=main)


VARY = (
    "what varies: parameters of the scene, kernel=cubic,quintic,wendland_c2,wendland_c4,wendland_c6,gaussian, "
    "precision=f32,f64, threads=1,2, stepper=leapfrog,heun,ssprk3, cleaning=none,constant,tricco_2012,tricco_2016, "
    "cour=..., h_fact=..., TERM=on,off, TERM.NUMBER=... (default: the scene's own study)"
)


def main(args) -> int:
    """Measure and tell."""
    from ..cost import command

    return command.main(args, assignments(args.set))
