"""The table's answers in words: what is cheapest for an error, what each choice costs and gives, where f32 ends."""

from math import exp, log

from ..outputs.words import duration
from .orders import label, pareto, sound, words

TARGETS = (0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)
APART = 0.1  # f32 has left f64 when their errors differ by more


def answers(plan, rows: list[dict], error: str) -> list[str]:
    """Sentences, the most wanted first."""
    said = cheapest(plan, rows, error)
    for name in plan.telling:
        if name not in (plan.level, "precision"):
            said += compared(rows, name)
    return said + halves(rows) + excluded(plan, rows)


def percent(value: float) -> str:
    """0.01 as 1 %."""
    return f"{100 * value:.3g} %"


def cheapest(plan, rows: list[dict], error: str) -> list[str]:
    """The cheapest setting for every round error that the sound ones bracket, and the one that errs least."""
    good = [row for row in rows if sound(row)]
    reached = [row["error"] for row in good]
    asked = {}  # the smallest target for which a setting is the cheapest
    for target in TARGETS:
        if good and min(reached) <= target <= max(reached):
            asked[quickest(good, target)["key"]] = target
    out = [at(plan, rows, error, target) for target in asked.values()]
    if good:
        last = pareto(rows)[-1]
        out.append(f"Least error: {percent(last['error'])}: {label(last, plan.telling)}, {duration(last['seconds'])}.")
    return out


def quickest(rows: list[dict], target: float) -> dict:
    """The cheapest sound setting that errs no more than this."""
    return min((row for row in rows if sound(row) and row["error"] <= target), key=lambda row: row["seconds"])


def at(plan, rows: list[dict], error: str, target: float) -> str:
    """The cheapest sound setting for an error; a cheaper one that is wrong is named with what is wrong."""
    within = [row for row in rows if row["error"] is not None and row["error"] <= target]
    found = quickest(within, target)
    said = f"{percent(target)} error in {error}: cheapest is {label(found, plan.telling)}, {duration(found['seconds'])}"
    tempting = [row for row in within if row["doubts"] and row["seconds"] < found["seconds"]]
    if tempting:
        row = min(tempting, key=lambda row: row["seconds"])
        said += f" ({label(row, plan.telling)} is cheaper, but {' and '.join(row['doubts'])})"
    return said + f"; it errs {percent(found['error'])}."


def twins(rows: list[dict], name: str, one, other) -> list[tuple[dict, dict]]:
    """Pairs of settings that differ in nothing but this; sound ones alone where there are any."""
    with_error = [row for row in rows if row["error"]]
    rest = {rest_of(row, name): row for row in with_error if row["setting"].get(name) == one}
    others = [row for row in with_error if row["setting"].get(name) == other and rest_of(row, name) in rest]
    pairs = [(rest[rest_of(row, name)], row) for row in others]
    return [pair for pair in pairs if all(map(sound, pair))] or pairs


def rest_of(row: dict, name: str) -> str:
    """A setting without one of its names."""
    return repr(sorted((k, v) for k, v in row["setting"].items() if k != name))


def mean_ratio(pairs, of: str) -> float:
    """The geometric mean of second over first."""
    return exp(sum(log(other[of] / one[of]) for one, other in pairs) / len(pairs))


def errs(ratio: float) -> str:
    """errs 3.2 times less."""
    if abs(log(ratio)) < 0.02:
        return "errs as much"
    return f"errs {max(ratio, 1 / ratio):.2g} times {'more' if ratio > 1 else 'less'}"


def costs(ratio: float, first: str) -> str:
    """costs 1.9 times cubic."""
    return f"costs as much as {first}" if abs(log(ratio)) < 0.03 else f"costs {ratio:.2g} times {first}"


def compared(rows: list[dict], name: str) -> list[str]:
    """Every value of a choice against its first: seconds and error, at the same everything else."""
    first, *others = dict.fromkeys(row["setting"][name] for row in rows if name in row["setting"])
    out = []
    for other in others:
        pairs = twins(rows, name, first, other)
        if pairs:
            cost, count = mean_ratio(pairs, "seconds"), f"{len(pairs)} pair{'s' if len(pairs) > 1 else ''} of settings"
            out.append(f"{words(name, other)} {costs(cost, words(name, first))} and "
                       f"{errs(mean_ratio(pairs, 'error'))} ({count}).")  # fmt: skip
    return out


def halves(rows: list[dict]) -> list[str]:
    """What f32 saves, and the error below which it stops improving."""
    pairs = twins(rows, "precision", "f64", "f32")
    if not pairs:
        return []
    saved = f"f32 takes {mean_ratio(pairs, 'seconds'):.2g} times the seconds of f64"
    left = [half["error"] for full, half in pairs if half["error"] > (1 + APART) * full["error"]]
    if not left:
        return [f"{saved} and errs as f64 does down to the least error here, {min(h['error'] for _, h in pairs):.2g}."]
    return [f"{saved}; it stops improving below an error of {max(left):.2g}."]


def excluded(plan, rows: list[dict]) -> list[str]:
    """How many are marked; what went wrong; what was not the same bits."""
    marked = [row for row in rows if row.get("doubts")]
    out = [f"{len(marked)} of {len(rows)} settings are marked with what is wrong in them beside the error; they are "
           "neither recommended nor on the Pareto front."] if marked else []  # fmt: skip
    out += [f"Went wrong: {label(row, plan.telling)}: {row['wrong']}." for row in rows if row["wrong"]]
    return out + [f"Not the same bits in every repetition: {label(row, plan.telling)}."
                  for row in rows if row.get("same_bits") is False]  # fmt: skip
