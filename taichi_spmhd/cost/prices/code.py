"""The compiled rates kernel of an entry: how many instructions it has, and how much of its arithmetic is vectorised.

Taichi writes the code of every kernel it compiles where measure.written_to says; kernels must not come from its cache
then. Instructions are counted as Taichi hands them to LLVM (one for all lanes, loads lane by lane): LLVM unrolls a
small loop more often than a large one, so what it returns may be longer with fewer terms. Whether the loop is
vectorised can only be seen in what LLVM returns.
"""

import re
from functools import cache
from pathlib import Path

ARITHMETIC = re.compile(r"= f(?:add|sub|mul|div|neg) [a-z ]*(?:<(\d+) x )?")
VECTORISED = 0.5  # of the arithmetic: a loop that is not has a few per cent, one that is has most
GIVEN, MADE = "taichi_kernel_generic_llvm_ir_*.ll", "taichi_kernel_cpu_llvm_ir_optimized_*.ll"


def environment(folder: Path) -> dict[str, str]:
    """What makes Taichi compile everything anew: an empty cache."""
    return {"TI_OFFLINE_CACHE_FILE_PATH": str(folder / "kernels")}


def rates(folder: Path, pattern: str) -> str:
    """The code of the rates kernel: its loop, not what starts and ends it; "" where there is none (a GPU)."""
    texts = (path.read_text(encoding="utf-8", errors="replace") for path in folder.glob(pattern))
    return max((text for text in texts if "define void @rates_" in text), key=len, default="")


@cache  # every round of an entry asks
def code(folder: Path) -> dict:
    """{"instructions", "vector_share"} of the rates kernel written to a folder; {} where there is none (a GPU)."""
    given, made = rates(folder, GIVEN), rates(folder, MADE)
    if not given or not made:
        return {}
    widths = [int(width or 1) for width in ARITHMETIC.findall(made)]
    share = sum(width for width in widths if width > 1) / max(1, sum(widths))
    return {"instructions": sum(line.startswith("  ") for line in given.splitlines()), "vector_share": share}
