"""What the commands that take a scene have in common: the scene, its parameters, the device."""

from ..errors import InputError


def add_scene(parser) -> None:
    """SCENE and --set."""
    parser.add_argument("scene", metavar="SCENE", help="a scene file, or the name of one that ships")
    parser.add_argument(
        "--set", nargs="+", action="extend", default=[], metavar="NAME=VALUE", help="parameters of the scene"
    )


def assignments(pairs: list[str]) -> dict[str, str]:
    """{name: text} of --set."""
    given = {}
    for pair in pairs:
        name, sign, text = pair.partition("=")
        if not sign or not name:
            raise InputError(f"--set {pair}: write NAME=VALUE, for example --set nx=64")
        if name in given:
            raise InputError(f"--set: {name} is given twice")
        given[name.strip()] = text.strip()
    return given


def start(args) -> dict:
    """Start Taichi as asked."""
    from ..runtime import init

    return init(args.arch, args.precision, args.threads)
