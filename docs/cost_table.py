"""The cost table of the README, from the summary.json files that `spmhd run` wrote: python docs/cost_table.py [out]"""

import datetime
import json
import sys
from pathlib import Path

from taichi_spmhd.runtime import hardware

HEADERS = ("scene", "variants", "particles", "steps", "stepping", "compiling", "updates/s", "bytes a particle")


def row(summary: dict) -> tuple:
    """One scene: steps, bytes and speed of its last variant, seconds of all of them together."""
    variants = list(summary["variants"].values())
    last, stepping = variants[-1], sum(one["seconds"] for one in variants)
    compiling = sum(one["seconds_compile"] for one in variants)
    speed = f"{last['updates_per_s'] / 1e6:.2f} million"
    name, seconds = f"`{summary['scene']}`", (f"{stepping:.1f} s", f"{compiling:.0f} s")
    return name, len(variants), last["particles"], last["steps"], *seconds, speed, last["bytes_per_particle"]


def table(folder: Path) -> list[str]:
    """Lines of Markdown, the cheapest scene first. Raises FileNotFoundError where there are no runs."""
    found = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*/summary.json"))]
    if not found:
        raise FileNotFoundError(f"no summary.json below {folder}: run scenes first, spmhd run NAME")
    found.sort(key=lambda summary: sum(one["seconds"] for one in summary["variants"].values()))
    first, day = found[0], datetime.datetime.now(datetime.timezone.utc).date()
    head = f"{hardware()}, {first['threads']} threads, {first['precision']}; taichi_spmhd {first['version']}, {day}."
    lines = [HEADERS, ("---",) * len(HEADERS), *map(row, found)]
    return [head, "", *("| " + " | ".join(map(str, line)) + " |" for line in lines)]


if __name__ == "__main__":
    print("\n".join(table(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))))
