"""Rows: what the repeated runs of a setting say together."""

import statistics

from .calibration import scaled

SAME = ("particles", "steps", "t", "bytes_per_particle", "errors", "energy_drift", "energy_drift_predicted",
        "momentum_drift", "momentum_drift_predicted", "close_pairs", "floors", "div_B", "digest")  # fmt: skip
CLUMPED, LEAK, DIRTY = 0.025, 0.01, 0.1  # close pairs; drift not explained by the terms; mean h |div B| / |B|


def rows(settings: list, runs: list[dict], error: str | None) -> list[dict]:
    """One row for every setting that was measured, in their order; error: the member to quote."""
    by_key: dict[str, list[dict]] = {}
    for run in runs:
        by_key.setdefault(run["key"], []).append(run)
    return [row(setting, by_key[setting.key], error) for setting in settings if setting.key in by_key]


def row(setting, runs: list[dict], error: str | None) -> dict:
    """The median of the runs with the smallest and largest, and the figures, which are the same in all of them."""
    wrong = next((run["wrong"] for run in runs if run.get("wrong")), None)
    made = {"setting": setting.values(), "key": setting.key, "repeats": len(runs), "wrong": wrong, "error": None}
    if wrong:
        return made
    found = {name: runs[0][name] for name in SAME if name in runs[0]}
    same = len({run["digest"] for run in runs}) == 1
    made = {**made, **found, **timing(runs), "error": found["errors"].get(error), "same_bits": same}
    return {**made, "doubts": doubts(made)}


def timing(runs: list[dict]) -> dict:
    """Seconds of stepping and what they are worth."""
    seconds = [run["seconds"] for run in runs]
    middle = statistics.median(seconds)
    return {
        "seconds": middle,
        "seconds_min": min(seconds),
        "seconds_max": max(seconds),
        "spread": (max(seconds) - min(seconds)) / middle,
        "seconds_scaled": statistics.median(scaled(run["seconds"], run["calibration"]) for run in runs),
        "calibration": statistics.median(run["calibration"] for run in runs),
        "seconds_compile": max(run["seconds_compile"] for run in runs),
        "cores": statistics.median(run["cores"] for run in runs),
        "updates_per_s": runs[0]["particles"] * runs[0]["steps"] / middle,
    }


def doubts(row: dict) -> list[str]:
    """What is wrong with a run beside its error, in words; nothing where all is well."""
    out = []
    if (row.get("close_pairs") or 0) > CLUMPED:
        out.append(f"{100 * row['close_pairs']:.0f} % of the particles clump")
    for name in ("energy", "momentum"):
        drift, known = abs(row[f"{name}_drift"]), row[f"{name}_drift_predicted"]
        gone = abs(row[f"{name}_drift"] - known) if name == "energy" else max(0.0, drift - abs(known))
        if gone > LEAK:
            out.append(f"{name} drifts by {100 * gone:.1f} %")
    if (row.get("div_B") or {}).get("mean", 0) > DIRTY:
        out.append(f"h |div B|/|B| is {row['div_B']['mean']:.2f}")
    if row.get("floors"):
        out.append(f"u was floored {row['floors']} times")
    return out
