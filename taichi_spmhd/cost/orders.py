"""Methods, convergence orders and the Pareto front of a study."""

from itertools import pairwise
from math import log

BETTER = 0.01  # an error less than this smaller is no better
PLAIN = ("variant", "kernel", "stepper", "precision")  # whose values need no name beside them


def words(name: str, value) -> str:
    """A value in words: wendland_c4, xi=0.5, 2 threads, Conductivity on."""
    if name in PLAIN:
        return str(value)
    if name == "threads":
        return f"{value} thread{'s' if value > 1 else ''}"
    if isinstance(value, bool):
        return f"{name} {'on' if value else 'off'}"
    return f"{name}={value:g}" if isinstance(value, float) else f"{name}={value}"


def label(row: dict, names) -> str:
    """A setting in words, by the names that tell settings apart."""
    return ", ".join(words(name, row["setting"][name]) for name in names if name in row["setting"])


def methods(rows: list[dict], telling: list[str], level: str | None) -> dict[str, list[dict]]:
    """{method: rows}, the rows in their order, which is from coarse to fine: a method is all but the resolution."""
    found: dict[str, list[dict]] = {}
    for row in rows:
        if row["error"] is not None:
            found.setdefault(label(row, [name for name in telling if name != level]), []).append(row)
    return found


def slope(coarse: dict, fine: dict, level: str) -> float:
    """The order between two resolutions: log of the ratio of errors over that of resolutions."""
    finer = fine["setting"][level] / coarse["setting"][level]
    return log(coarse["error"] / fine["error"]) / log(finer)


def convergence(there: list[dict], level: str | None) -> list[float]:
    """The order between each resolution and the next."""
    good = [row for row in there if row["error"]] if level else []
    return [slope(coarse, fine, level) for coarse, fine in pairwise(good)]


def pareto(rows: list[dict]) -> list[dict]:
    """Rows whose error no cheaper one comes near, cheapest first; what is doubtful is left out."""
    front: list[dict] = []
    for row in sorted((row for row in rows if sound(row)), key=lambda row: (row["seconds"], row["error"])):
        if not front or row["error"] < (1 - BETTER) * front[-1]["error"]:
            front.append(row)
    return front


def sound(row: dict) -> bool:
    """Whether a row has an error and nothing else against it."""
    return row["error"] is not None and not row["doubts"]


def fit(there: list[dict], level: str) -> float:
    """The order over all resolutions: the least-squares slope of log error over log resolution."""
    return -steepness([(row["setting"][level], row["error"]) for row in there if row["error"]])


def growth(rows: list[dict], plan) -> float:
    """The power of the resolution with which particles times steps grow, of the method with most rows; 0 without."""
    longest = max(methods(rows, plan.telling, plan.level).values(), key=len, default=[]) if plan.level else []
    work = [(row["setting"][plan.level], row["particles"] * row["steps"]) for row in longest]
    return max(0.0, steepness(work)) if len(work) > 1 else 0.0


def steepness(points: list[tuple[float, float]]) -> float:
    """The least-squares slope of log y over log x."""
    logs = [(log(x), log(y)) for x, y in points]
    x, y = (sum(axis) / len(points) for axis in zip(*logs, strict=True))
    return sum((a - x) * (b - y) for a, b in logs) / sum((a - x) ** 2 for a, _ in logs)
