"""From the command line to a command, and from what went wrong to one line and an exit code."""

import argparse
import importlib
import sys

from ..errors import InputError, RunError
from ..outputs.words import hush, one_line

COMMANDS = ("list", "show", "run", "live", "bench", "cost", "dispersion", "stability")
DONE, WRONG_INPUT, WENT_WRONG, INTERRUPTED = 0, 2, 3, 130


class Parser(argparse.ArgumentParser):
    """Errors are InputErrors like all others, and point to the help."""

    def error(self, message: str):
        raise InputError(f"{message} (see {self.prog} --help)")


class Columns(argparse.HelpFormatter):
    """Names and what they do in one line each: argparse forgets that commands are indented when it measures them."""

    def __init__(self, prog: str):
        super().__init__(prog)
        self._action_max_length = 6 + max(map(len, COMMANDS))


def common() -> argparse.ArgumentParser:
    """Options that every command which computes has."""
    options = argparse.ArgumentParser(add_help=False)
    options.add_argument("--arch", default="auto", help="auto, cpu, cuda, vulkan or metal (default auto)")
    options.add_argument("--precision", default="f64", help="f64 or f32 (default f64)")
    options.add_argument("--threads", type=int, metavar="N", help="CPU threads (default: all cores)")
    options.add_argument("--quiet", action="store_true", help="say nothing but errors")
    return options


class Version(argparse.Action):
    """Looked up only when asked for."""

    def __call__(self, parser, *_):
        from .. import __version__

        print(f"spmhd {__version__}")
        parser.exit()


def parser() -> Parser:
    """The commands and their options."""
    what = "Smoothed particle magnetohydrodynamics: run the scenes and look."
    top = Parser(prog="spmhd", description=what, formatter_class=Columns)
    top.add_argument("--version", action=Version, nargs=0, help="show the version and exit")
    commands = top.add_subparsers(metavar="COMMAND", required=True, parser_class=Parser)
    options = common()
    for name in COMMANDS:
        importlib.import_module(f".{name}", __package__).add(commands, options)
    return top


def main(argv=None) -> int:
    """Run a command; returns the exit code: 0 done, 2 wrong input, 3 the run went wrong, 130 interrupted."""
    try:
        args = parser().parse_args(argv)
        code = args.command(args)
        sys.stdout.flush()
        return code
    except InputError as error:
        return complain(error, WRONG_INPUT)
    except RunError as error:
        return complain(error, WENT_WRONG)
    except MemoryError:
        return complain("not enough memory for this many particles; lower nx", WRONG_INPUT)
    except KeyboardInterrupt:
        return complain("interrupted", INTERRUPTED)
    except BrokenPipeError:
        hush()
        return DONE
    except SystemExit as stop:  # --help and --version
        return stop.code or DONE


def complain(what, code: int) -> int:
    """One line on stderr."""
    print(f"spmhd: error: {one_line(what)}", file=sys.stderr)
    return code
