"""Forecast: seconds that runs will take, learnt from those measured; for the time left and for a budget."""

import statistics
import time

COMPILE = 8.0  # seconds, before the first is known


class Forecast:
    """budget: seconds for everything, or None."""

    def __init__(self, todo: list, budget: float | None):
        self.todo, self.budget, self.clock = todo, budget, time.monotonic()
        self.rates: dict[str, list[float]] = {}  # seconds per unit of work, by precision
        self.compiling: list[float] = []
        self.left_out = 0

    def learn(self, task, result: dict) -> None:
        """One more measurement."""
        if "seconds" in result:
            self.rates.setdefault(task.setting.precision, []).append(result["seconds"] / task.setting.work)
            if task.round == 0:
                self.compiling.append(result["seconds_compile"])

    def seconds(self, task) -> float:
        """Of a run: stepping, and compiling where it is the first of its setting."""
        rates = self.rates.get(task.setting.precision) or [r for every in self.rates.values() for r in every] or [1e-8]
        compiling = statistics.median(self.compiling) if self.compiling else COMPILE
        return task.setting.work * statistics.median(rates) + (compiling if task.round == 0 else 0.0)

    def fits(self, task) -> bool:
        """Whether the budget has room for a run; without a first measurement there is always room."""
        if self.budget is None or not self.rates:
            return True
        fits = time.monotonic() - self.clock + self.seconds(task) <= self.budget
        self.left_out += not fits
        return fits

    def share(self, done: int) -> float:
        """Of the whole time, after so many runs."""
        each = [self.seconds(task) for task in self.todo]
        return sum(each[:done]) / sum(each) if each else 1.0
