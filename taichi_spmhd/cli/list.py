"""`spmhd list`: the scenes that come with the package."""


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser("list", parents=[common], help="the scenes, one line each: what to see, what it costs")
    parser.set_defaults(command=main)


def main(args) -> int:
    """One line each; the scene files are read, not run."""
    from ..library import listing
    from ..outputs.words import say

    entries = listing()
    width = max((len(entry.name) for entry in entries), default=0)
    for entry in entries:
        say(f"{entry.name:<{width}}  {entry.sight}" + (f"  ({entry.cost})" if entry.cost else ""))
    return 0
