"""The compiled rates kernel of an entry: how many instructions it has, and how much of its arithmetic is vectorised.

Taichi writes the optimised, machine-independent code of every kernel it compiles into the current folder when the
environment says so; kernels must not come from its cache then.
"""

import re
from pathlib import Path

ARITHMETIC = re.compile(r"= f(?:add|sub|mul|div|neg) [a-z ]*(?:<(\d+) x )?")
VECTORISED = 0.5  # of the arithmetic: a loop that is not has a few per cent, one that is has most


def environment(folder: Path) -> dict[str, str]:
    """What makes Taichi write code, with an empty cache of its own."""
    return {"TI_PRINT_KERNEL_LLVM_IR_OPTIMIZED": "1", "TI_OFFLINE_CACHE_FILE_PATH": str(folder / "kernels")}


def code(folder: Path) -> dict:
    """{"instructions", "vector_share"} of the rates kernel written to a folder; {} where there is none (a GPU)."""
    texts = (path.read_text(encoding="utf-8", errors="replace") for path in sorted(folder.glob("*.ll")))
    rates = [text for text in texts if "define void @rates_" in text]
    if not rates:
        return {}
    widths = [int(width or 1) for width in ARITHMETIC.findall(rates[0])]
    lines = sum(line.startswith("  ") for line in rates[0].splitlines())
    share = sum(width for width in widths if width > 1) / max(1, sum(widths))
    return {"instructions": lines, "arithmetic": sum(widths), "vector_share": share}
