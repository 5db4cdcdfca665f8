"""Where runs go: one after another in processes of this machine, or in several strands side by side.

measured(tasks, ...) -> (task, result), as they come
"""

import queue
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from .setting import Setting
from .worker import Workers


@dataclass(frozen=True, eq=False)
class Task:
    """A run of a setting; round: 0 for its first; order: what the worker is told."""

    setting: Setting
    round: int
    order: dict


def tasks(plan, done: set[tuple[str, int]]) -> list[Task]:
    """All rounds of all settings, round by round so that repetitions are far apart; those done are left out."""
    every = [Task(setting, k, plan.order(setting)) for k in range(plan.repeat) for setting in plan.settings]
    return [task for task in every if (task.setting.key, task.round) not in done]


def one_by_one(
    todo: list[Task], arch: str, wanted: Callable, check: Callable, environment: dict | None = None
) -> Iterator[tuple[Task, dict]]:
    """One after another. wanted(task): whether to start it at all; check() may raise to stop; environment: more."""
    workers = Workers(arch, environment)
    try:
        for task in todo:
            if wanted(task):
                yield task, workers.ask(task.order, check)
    finally:
        workers.close()


def side_by_side(
    todo: list[Task], arch: str, jobs: int, wanted: Callable, check: Callable
) -> Iterator[tuple[Task, dict]]:
    """Several strands, each with settings of its own: what a strand has compiled serves their repetitions."""
    if jobs == 1:
        yield from one_by_one(todo, arch, wanted, check)
        return
    results: queue.Queue = queue.Queue()
    over = threading.Event()

    def stopped() -> None:
        if over.is_set():
            raise Over

    threads = [
        threading.Thread(target=strand, args=(share, arch, wanted, stopped, results), daemon=True)
        for share in shares(todo, jobs)
    ]
    try:
        for thread in threads:
            thread.start()
        yield from gathered(results, len(threads), check)
    finally:
        over.set()
        for thread in threads:
            thread.join()


class Over(Exception):
    """Nobody waits for results any more."""


def strand(share: list[Task], arch: str, wanted: Callable, check: Callable, results: queue.Queue) -> None:
    """The work of one strand; what it raises goes to whoever gathers, None says that it has ended."""
    try:
        for made in one_by_one(share, arch, wanted, check):
            results.put(made)
    except Over:
        pass
    except BaseException as error:
        results.put(error)
    results.put(None)


def gathered(results: queue.Queue, strands: int, check: Callable) -> Iterator[tuple[Task, dict]]:
    """Results of all strands as they come."""
    while strands:
        check()
        try:
            made = results.get(timeout=0.2)
        except queue.Empty:
            continue
        if isinstance(made, BaseException):
            raise made
        if made is None:
            strands -= 1
        else:
            yield made


def shares(todo: list[Task], jobs: int) -> list[list[Task]]:
    """Settings dealt out so that the strands have about the same work: the largest first, to whoever has least."""
    work = [0.0] * jobs
    owner: dict[str, int] = {}
    for task in sorted(todo, key=lambda task: -task.setting.work):
        if task.setting.key not in owner:
            owner[task.setting.key] = work.index(min(work))
        work[owner[task.setting.key]] += task.setting.work
    dealt = [[task for task in todo if owner[task.setting.key] == k] for k in range(jobs)]
    return [share for share in dealt if share]
