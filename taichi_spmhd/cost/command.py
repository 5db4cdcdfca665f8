"""The command: plan, measure, record, tell."""

import os
from collections.abc import Iterator
from pathlib import Path

from ..errors import InputError
from ..machine import machine
from ..outputs.progress import progress
from ..outputs.signals import Interrupted, Stop
from ..outputs.words import duration, say
from ..runtime import PRECISIONS
from . import grid, places, report
from .forecast import Forecast
from .plan import Plan, checked, measurable, planned, single
from .record import Record


def main(args, given: dict) -> int:
    """Measure the grid of settings; given: the assignments of --set. Returns 0, or 130 where it was interrupted."""
    if args.effects:
        return effects(args, given)
    asked = {name: getattr(args, name) for name in ("precision", "threads", "repeat", "budget")}
    asked["threads"] = share_of_cores(args)
    arch = "cpu" if args.arch == "auto" else args.arch
    plan = planned(args.scene, given, args.vary, args.variant, args.error, args.t_end, arch=arch, **asked)
    measurable(plan)
    record = Record(args.out or Path("out") / "cost" / plan.name, plan, machine())
    record.take_up() if args.resume else record.begin()
    with Stop() as stop:
        try:
            measure(record, args, stop)
        except Interrupted:
            return interrupted(record, args.quiet)
    report.finish(record, args.quiet)
    return 0


def effects(args, given: dict) -> int:
    """The price list instead. Raises InputError for options that have no meaning for it."""
    from .prices import command

    for name in ("error", "resume", "cluster", "t_end"):
        if getattr(args, name):
            raise InputError(f"--{name.replace('_', '-')} has no meaning with --effects; leave it out")
    vary = grid.words(args.vary)
    if set(vary) - {"precision"}:
        raise InputError("--effects takes --vary precision=... alone; set parameters of the scene with --set")
    precisions = [grid.value("precision", one, {}, None) for one in vary.get("precision", PRECISIONS)]
    place = {"arch": "cpu" if args.arch == "auto" else args.arch, "precision": precisions[0]}
    plan, scene = single(args.scene, given, args.variant, **place, threads=share_of_cores(args))
    rounds = command.ROUNDS if args.repeat is None else args.repeat
    rounds = checked({"repeat": rounds, "budget": args.budget})["repeat"]
    return command.main(plan, scene, precisions, rounds, args)


def share_of_cores(args) -> int:
    """Threads of a run: what is asked for, or the cores that a job has for itself; one on a cluster."""
    if not 1 <= args.jobs <= 256:
        raise InputError(f"--jobs {args.jobs}: give a whole number from 1 to 256")
    if args.cluster and args.jobs > 1:
        raise InputError("--jobs and --cluster: a cluster has as many jobs as workers; leave out --jobs")
    return args.threads or (1 if args.cluster else max(1, (os.cpu_count() or 1) // args.jobs))


def measured(todo: list, plan: Plan, args, wanted, check) -> Iterator[tuple]:
    """(task, result) as they come, from this machine or from a cluster."""
    if args.cluster:
        from .cluster import on_cluster

        return on_cluster(todo, plan.arch, args.cluster, wanted, check)
    return places.side_by_side(todo, plan.arch, args.jobs, wanted, check)


def measure(record: Record, args, stop: Stop) -> None:
    """Run what is still to be run, in rounds, and keep every result."""
    plan: Plan = record.plan
    todo = places.tasks(plan, record.done())
    forecast, bar = Forecast(todo, plan.budget), progress(args.quiet)
    wrong = {key for key, _ in record.done() if any(run["key"] == key and run.get("wrong") for run in record.runs)}
    bar.note(f"{plan.name}: {len(plan.settings)} settings, {plan.repeat} runs each, cheapest first; compiling")
    try:
        wanted = lambda task: task.setting.key not in wrong and forecast.fits(task)  # noqa: E731
        for done, (task, result) in enumerate(measured(todo, plan, args, wanted, stop.check), 1):
            record.add(task, result)
            forecast.learn(task, result)
            wrong |= {task.setting.key} if result.get("wrong") else set()
            bar.show(forecast.share(done), speed(result))
    finally:
        bar.end()
    if forecast.left_out and not args.quiet:
        left = f"{forecast.left_out} of {len(todo)} runs"
        say(f"The budget of {duration(plan.budget)} left out {left}; go on with --resume.")


def speed(result: dict) -> float:
    """Particle updates per second."""
    return result["particles"] * result["steps"] / result["seconds"] if result.get("seconds") else 0.0


def interrupted(record: Record, quiet: bool) -> int:
    """Tell what there is so far."""
    from ..cli.main import INTERRUPTED, complain

    if record.runs:
        report.finish(record, quiet)
    where = (
        f"{len(record.runs)} runs are in {record.root}; go on with --resume" if record.runs else "nothing was written"
    )
    return complain(f"interrupted; {where}", INTERRUPTED)
