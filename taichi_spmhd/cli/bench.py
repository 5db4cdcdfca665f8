"""`spmhd bench`: how fast this machine is."""


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser("bench", parents=[common], help="particle updates per second on this machine")
    parser.add_argument("--json", metavar="FILE", help="write the rows to this file as well")
    parser.add_argument("--quick", action="store_true", help="fewer particles and steps")
    parser.add_argument("--cases", nargs="+", metavar="CASE", help="for example mhd3d_f64 hydro2d_f32 (default: all)")
    parser.add_argument("--sizes", nargs="+", metavar="2d=NX", help="particles along an axis (default 3d=32 2d=180)")
    parser.add_argument("--scale", action="store_true", help="time a particle at 3 10^4 and at 10^6 particles instead")
    parser.set_defaults(command=main)


def main(args) -> int:
    """Measure and tell."""
    from .. import bench

    return bench.main(args)
