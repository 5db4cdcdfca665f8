"""Where and when something was measured, and whether the machine had time for it."""

import datetime
import os
import subprocess
from pathlib import Path

from ..runtime import hardware

UNEVEN = 0.25  # spread of seconds or of the calibration loop that says others were at work


def machine() -> dict:
    """Processor, version, commit of a checkout, date."""
    from .. import __version__

    now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    return {"hardware": hardware(), "version": __version__, "commit": commit(), "date": now}


def commit() -> str | None:
    """The commit this package was checked out from, with a + where files were changed since; None without git."""
    here = Path(__file__).resolve().parents[2]
    if not (here / ".git").exists():
        return None
    try:
        words = ["git", "-C", str(here), "describe", "--always", "--abbrev=8", "--exclude=*", "--dirty=+"]
        return subprocess.run(words, capture_output=True, text=True, timeout=10, check=True).stdout.strip() or None
    except (OSError, subprocess.SubprocessError):
        return None


def words(made: dict) -> str:
    """One line under every table and picture."""
    version = f"taichi_spmhd {made['version']}" + (f" ({made['commit']})" if made["commit"] else "")
    return f"{made['hardware']}; {version}, {made['date']}"


def busy(runs: list[dict], rows: list[dict]) -> str | None:
    """A sentence where the seconds should not be trusted: the calibration loop or the repetitions were uneven."""
    loops = sorted(run["calibration"] for run in runs if "calibration" in run)
    signs = []
    if len(loops) > 2 and quartile(loops, 0.75) > (1 + UNEVEN) * quartile(loops, 0.25):
        signs.append(f"the calibration loop took {1e3 * loops[0]:.2g} to {1e3 * loops[-1]:.2g} ms")
    uneven = [row for row in rows if row.get("spread", 0) > UNEVEN]
    if 2 * len(uneven) > len(rows):
        signs.append(f"repetitions of {len(uneven)} of {len(rows)} settings differ by more than {100 * UNEVEN:.0f} %")
    loads = [run["load"] for run in runs if run.get("load") is not None]
    if loads and max(loads) > 1.2 * (os.cpu_count() or 1):
        signs.append(f"the load average reached {max(loads):.1f} on {os.cpu_count()} cores")
    return f"The machine was busy: {'; '.join(signs)}. Compare seconds of another day with care." if signs else None


def quartile(values: list[float], share: float) -> float:
    """The value below which this share of sorted values lies."""
    return values[min(len(values) - 1, int(share * len(values)))]
