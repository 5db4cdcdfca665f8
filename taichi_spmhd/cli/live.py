"""`spmhd live SCENE`: the sandbox in the browser."""

import threading
from pathlib import Path

from ..errors import InputError
from .asked import add_scene, assignments, start


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser("live", parents=[common], help="the sandbox in the browser: slide, switch, watch")
    add_scene(parser)
    parser.add_argument("--variant", metavar="LABEL", help="the variant to begin with (default: the last one)")
    parser.add_argument(
        "--port", type=int, default=0, metavar="P", help="where the page is served (default: a free port)"
    )
    parser.add_argument(
        "--host", default="127.0.0.1", metavar="ADDRESS", help="address to listen on (default 127.0.0.1)"
    )
    parser.add_argument("--no-browser", action="store_true", help="only print the address")
    parser.add_argument("--out", metavar="DIR", help="where what is recorded goes (default out/SCENE_live)")
    parser.set_defaults(command=main)


def main(args) -> int:
    """Returns 0 when somebody ended it."""
    from ..library import find
    from ..live.desk import Desk
    from ..live.server import Server
    from ..live.session import Session
    from ..outputs.folder import Folder
    from ..outputs.signals import Stop
    from ..outputs.words import say

    if not 0 <= args.port < 65536:
        raise InputError(f"--port {args.port}: give a number from 0 (a free one) to 65535")
    path = find(args.scene)
    chosen(args, path)
    out = Folder(args.out or Path("out") / f"{path.stem}_live").root
    desk = Desk()
    server = Server(desk, args.host, args.port)
    with Stop() as stop:
        try:
            session = Session(path, assignments(args.set), args.variant, start(args), out, desk)
            server.start()
            tell(server, args, say)
            session.run(stop)
        finally:
            server.stop()
    if not args.quiet:
        say("spmhd live: ended")
    return 0


def chosen(args, path) -> None:
    """What can be seen to be wrong before Taichi starts."""
    from ..library import load_scene
    from ..outputs.plan import chosen as among

    among(load_scene(path, **assignments(args.set)), [args.variant] if args.variant else None)


def tell(server, args, say) -> None:
    """The address, and the browser."""
    say(f"spmhd live: {server.url}   (Ctrl-C ends it)")
    if not server.address.is_loopback:
        say("spmhd live: whoever has this address can steer the run, over plain HTTP; others cannot")
    if not args.no_browser:
        threading.Thread(target=browse, args=(server.url,), daemon=True).start()


def browse(url: str) -> None:
    """Open the browser, in a process of its own without our terminal: a text browser would take it, others chatter."""
    import subprocess
    import sys
    from contextlib import suppress

    with suppress(OSError):
        quiet = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.DEVNULL)
        subprocess.run([sys.executable, "-m", "webbrowser", url], **quiet, start_new_session=True, check=False)
