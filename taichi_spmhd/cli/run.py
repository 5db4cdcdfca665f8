"""`spmhd run SCENE`: simulate, draw, write."""

from pathlib import Path

from .asked import add_scene, assignments, start


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser("run", parents=[common], help="run a scene: frames, film, history, summary")
    add_scene(parser)
    parser.add_argument("--variant", nargs="+", action="extend", metavar="LABEL", help="only these variants")
    parser.add_argument("--frames", type=int, metavar="N", help="number of frames (default 26)")
    parser.add_argument("--movie", metavar="gif|mp4|none", help="the film made of the frames (default gif)")
    parser.add_argument("--t-end", type=float, metavar="T", help="end at this time (default: the scene's)")
    parser.add_argument("--out", metavar="DIR", help="folder for the files (default out/SCENE)")
    parser.add_argument("--resume", action="store_true", help="go on with the run in --out, to the same bits")
    parser.set_defaults(command=main)


def main(args) -> int:
    """Returns 0, 3 (a variant went wrong) or 130 (interrupted)."""
    from ..library import find
    from ..outputs.folder import Folder
    from ..outputs.signals import Interrupted, Stop
    from .main import INTERRUPTED, complain

    with Stop() as stop:
        path = find(args.scene)
        folder = Folder(args.out or Path("out") / path.stem)
        try:
            return carry_out(args, path, folder, stop)
        except Interrupted:
            where = f"its state is in {folder.root}; go on with --resume" if folder.record else "nothing was written"
            return complain(f"interrupted; {where}", INTERRUPTED)


def carry_out(args, path, folder, stop) -> int:
    """Plan, begin or take up, run, report."""
    from ..outputs import report
    from ..outputs.progress import progress
    from ..outputs.run import Run, restore
    from ..outputs.words import say

    plan = planned(args, path, folder)
    ended = restore(plan, folder) if args.resume else None
    if ended:
        return already(ended, folder, args.quiet)
    run = Run(plan, folder, stop, progress(args.quiet))
    try:
        greet(run, args)
        run.resume() if args.resume else run.begin()
        run.go()
        made = report.finish(run)
    finally:
        run.progress.end()
        run.close()
    if not args.quiet:
        report.tell(made, run)
        say()
    return verdict(run.errors, folder)


def planned(args, path, folder):
    """The plan, checked. With --resume, what is not said again is as it was."""
    from ..library import load_scene, parameters_of
    from ..outputs.plan import Plan, chosen

    before = (folder.earlier() or {}) if args.resume else {}
    before = before if before.get("scene") == path.stem else {}
    given = {**before.get("parameters", {}), **assignments(args.set)}
    variants = load_scene(path, **given)
    variants = chosen(variants, args.variant or before.get("variants"), pick(args.t_end, before.get("t_end")))
    frames, movie = pick(args.frames, before.get("frames"), 26), pick(args.movie, before.get("movie"), "gif")
    draft = {"frames": frames, "movie": movie}
    Plan(path, {}, variants, {"arch": "", "precision": ""}, **draft)  # what is wrong shows before Taichi starts
    return Plan(path, parameters_of(path, **given), variants, start(args), **draft)


def pick(*values):
    """The first that is not None."""
    return next((value for value in values if value is not None), None)


def greet(run, args) -> None:
    """What is about to happen."""
    plan, device = run.plan, run.plan.device
    count = len(plan.variants)
    what = f"{count} variants" if count > 1 else "one variant"
    where = f"{device['arch']}, {device['precision']}, {device['threads']} threads"
    verb = "going on" if args.resume else "compiling"
    run.progress.note(f"{plan.name}: {what} to t = {plan.t_end:g} on {where}; {verb}")


def already(record: dict, folder, quiet: bool) -> int:
    """A run that has ended needs no resuming."""
    from ..outputs.words import say

    if record.get("errors"):
        return verdict(record["errors"], folder)
    if not quiet:
        say(f"{record['scene']}: the run in {folder.root} is finished")
    return 0


def verdict(errors: dict, folder) -> int:
    """0, or 3 and a line for each variant that went wrong."""
    from .main import DONE, WENT_WRONG, complain

    for label, error in errors.items():
        drawn = f"; the place: {folder.failure(label)}" if folder.failure(label).exists() else ""
        complain(f"{label}: {error}; last good state: {folder.state(label)}{drawn}", WENT_WRONG)
    return WENT_WRONG if errors else DONE
