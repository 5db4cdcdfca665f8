"""What is said on the terminal: lines, tables, numbers in words."""

import os
import sys


def say(text: str = "") -> None:
    """One line on stdout; a reader that has gone away (`| head`) is no reason to stop or to complain."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        hush()


def hush() -> None:
    """Point stdout at nothing, so that no later write, nor the interpreter's last flush, fails."""
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, sys.stdout.fileno())
    os.close(nothing)


def one_line(text) -> str:
    """Any message as a single line."""
    return " ".join(str(text).split())


def table(headers, rows, title: str = "") -> None:
    """A table: drawn by rich on a terminal, plain aligned columns elsewhere."""
    rows = [[str(cell) for cell in row] for row in rows]
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.table import Table

        drawn = Table(*headers, title=title or None, title_justify="left", show_header=any(headers))
        for row in rows:
            drawn.add_row(*row)
        Console(markup=False, highlight=False).print(drawn)
        return
    if title:
        say(title)
    lines = [list(headers), *rows] if any(headers) else rows
    widths = [max(len(line[n]) for line in lines) for n in range(len(headers))]
    for line in lines:
        say("  " + "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip())


def duration(seconds: float) -> str:
    """0.3 s, 12 s, 3 min, 1.5 h."""
    if seconds < 100:
        return f"{seconds:.2g} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def size(count: float) -> str:
    """Bytes as kB, MB or GB."""
    for unit in ("bytes", "kB", "MB"):
        if count < 999.5:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} GB"


def rate(per_second: float) -> str:
    """Particle updates per second."""
    if per_second >= 999_500:
        return f"{per_second / 1e6:.2f} million updates/s"
    return f"{per_second / 1000:.0f} thousand updates/s" if per_second >= 2000 else f"{per_second:.0f} updates/s"
