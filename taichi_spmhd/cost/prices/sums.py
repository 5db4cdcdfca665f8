"""Prices from timings: differences to the whole, what they add up to, which loops are vectorised."""

import numpy as np

from ...bench.clocks import PHASES
from .code import VECTORISED
from .entries import Entry

CLEAR = 0.02  # of the whole: a smaller difference, or one within the spread, is not told apart from nothing


def middle(results: list[dict], whole_ms: float) -> dict:
    """The rounds of an entry, in the time of a machine on which the whole takes whole_ms.

    In each round the entry was timed in turn with the whole. What slows the machine for a minute slows both, so the
    ratio is what counts: its median, and as spread half the distance of its quartiles.
    """
    ratios = [result["ms"] / result["whole_ms"] for result in results]
    low, ratio, high = np.quantile(ratios, (0.25, 0.5, 0.75))
    typical = results[int(np.argmin(np.abs(np.array(ratios) - ratio)))]
    scale = ratio * whole_ms / typical["ms"]
    timings = {name: typical[name] * scale for name in ("ms", "pass_ms")}
    phases = {phase: ms * scale for phase, ms in typical["phases_ms"].items()}
    return {**typical, **timings, "phases_ms": phases, "spread": 0.5 * (high - low), "rounds": len(results)}


def prices(found: dict[Entry, list[dict]]) -> dict:
    """Everything the list says of one precision; found: the results of every round of every entry."""
    timed = {entry: results for entry, results in found.items() if not any("wrong" in one for one in results)}
    wrong = {entry: results[-1]["wrong"] for entry, results in found.items() if entry not in timed}
    whole_ms = min((one["whole_ms"] for results in timed.values() for one in results), default=0.0)
    good = {entry: middle(results, whole_ms) for entry, results in timed.items()}
    whole = next((made for entry, made in good.items() if entry.kind == "whole"), None)
    if whole is None:
        return {"wrong": next(iter(wrong.values()), "nothing was measured")}
    terms = [term(entry, good.get(entry), whole, wrong) for entry in found if entry.kind == "without"]
    sets = cumulative([(entry, made) for entry, made in good.items() if entry.kind == "upto"], whole, terms)
    return {
        "whole": whole,
        "terms": terms,
        "upto": sets,
        "choices": [choice(entry, made, whole) for entry, made in good.items() if entry.kind in ("kernel", "stepper")],
        "phases": {phase: whole["phases_ms"][phase] for phase in PHASES},
        "passes": whole["phases_ms"]["density"] / whole["pass_ms"],
        "explained": explained(terms, sets, whole),
    }


def term(entry: Entry, without: dict | None, whole: dict, wrong: dict) -> dict:
    """ms, bytes and instructions that go when the term goes; why it cannot, where it cannot."""
    if without is None:
        return {"name": entry.name, "ms": None, "reason": wrong[entry]}
    own = {"name": entry.name, "ms": whole["ms"] - without["ms"], "without_ms": without["ms"]}
    return {
        **own,
        "spread_ms": without["spread"] * whole["ms"],
        "share": own["ms"] / whole["ms"],
        **less(without, whole),
    }


def less(without: dict, whole: dict) -> dict:
    """Bytes a particle, members and instructions of the whole that a smaller set does not have."""
    size = {name: whole[name] - without[name] for name in ("bytes_state", "bytes_list")}
    members = sorted(set(whole["members"]) - set(without["members"]))
    code = whole["instructions"] - without["instructions"] if "instructions" in whole else None
    return {"bytes": size["bytes_state"], "bytes_list": size["bytes_list"], "members": members, "instructions": code}


def choice(entry: Entry, made: dict, whole: dict) -> dict:
    """Another kernel or stepper instead of the scene's own."""
    size = made["bytes_state"] + made["bytes_list"] - whole["bytes_state"] - whole["bytes_list"]
    own = {"name": f"{entry.kind} {entry.name}", "ms": made["ms"] - whole["ms"], "share": made["ms"] / whole["ms"] - 1}
    return {**own, "bytes": size, "listed": made["listed"]}


def cumulative(sets: list, whole: dict, terms: list[dict]) -> list[dict]:
    """Milliseconds of the first set that runs, of that and the next term, and so on to the whole."""
    out, before = [], None
    for name, made in [*((entry.name, made) for entry, made in sets), (terms[-1]["name"], whole)]:
        share = made.get("vector_share")
        more = made["ms"] - before if before is not None else made["ms"]
        out.append({"name": name, "ms": made["ms"], "more_ms": more, "rates_ms": made["phases_ms"]["rates"],
                    "vector_share": share, "vectorised": None if share is None else share > VECTORISED})  # fmt: skip
        before = made["ms"]
    return out


def explained(terms: list[dict], sets: list[dict], whole: dict) -> float | None:
    """The first set plus what every other term is worth when it alone goes, over the whole."""
    first = next((k for k, one in enumerate(terms) if one["name"] == sets[0]["name"]), 0)
    later = [one["ms"] for one in terms[first + 1 :]]
    if any(ms is None for ms in later):
        return None
    return (sets[0]["ms"] + sum(later)) / whole["ms"]
