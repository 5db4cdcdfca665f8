"""Whether the machine had time for what was measured."""

import os

UNEVEN = 0.25  # spread of seconds or of the calibration loop that says others were at work


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
