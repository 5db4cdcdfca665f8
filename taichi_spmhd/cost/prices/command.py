"""The command: every entry in every precision, round after round, then the list."""

import csv
import io
import tempfile
from pathlib import Path

from ...errors import InputError
from ...machine import machine, words
from ...outputs.files import as_json, make, read_json, write_text, writing
from ...outputs.progress import progress
from ...outputs.signals import Interrupted, Stop
from ...outputs.words import say, table
from ...replacing import replacing
from ..forecast import Forecast
from ..places import Task, one_by_one
from ..plan import Plan
from ..setting import Setting
from . import report
from .code import code, environment
from .entries import Entry, entries
from .steps import TURNS
from .sums import prices

ROUNDS, STEPS = 7, 10
FILES = ("prices.json", "prices.csv", "prices.md", "prices.png")


class List:
    """The measurements of a price list: plan (one variant), entries, results by precision and entry."""

    def __init__(self, plan: Plan, scene, precisions: list[str], threads: int, rounds: int, root: Path):
        self.plan, self.root, self.rounds, self.threads = plan, root, rounds, threads
        self.entries = entries(scene)
        self.found: dict[str, dict[Entry, list[dict]]] = {precision: {} for precision in precisions}
        self.machine = machine()

    def todo(self, folder: Path) -> list[tuple[Entry, Task]]:
        """Every entry in every precision, round by round."""
        return [(entry, self.task(entry, precision, k, folder)) for k in range(self.rounds)
                for precision in self.found for entry in self.entries]  # fmt: skip

    def task(self, entry: Entry, precision: str, k: int, folder: Path) -> Task:
        """A round of an entry, in turn with the whole where it is not the whole itself."""
        setting, order = self.order(entry, precision, folder)
        whole = self.entries[0]
        beside = {"whole": self.order(whole, precision, folder)[1]} if entry.changes != whole.changes else {}
        return Task(setting, k, {**order, **beside, "steps": STEPS})

    def order(self, entry: Entry, precision: str, folder: Path) -> tuple[Setting, dict]:
        """The setting of an entry, and what a worker is told to build it and to leave its code."""
        setting = Setting({}, dict(entry.changes), self.plan.labels[0], precision, self.threads, work=1.0)
        return setting, {**self.plan.order(setting), "code": str(self.written(entry, precision, folder))}

    def written(self, entry: Entry, precision: str, folder: Path) -> Path:
        """Where the code of an entry is written: what is the same scene is compiled once."""
        changes = [other.changes for other in self.entries]
        return folder / f"{precision}-{changes.index(entry.changes)}"

    def add(self, entry: Entry, task: Task, result: dict, folder: Path) -> None:
        """One more result, with what its compiled code says."""
        if "wrong" not in result:
            result |= code(self.written(entry, task.setting.precision, folder))
        self.found[task.setting.precision].setdefault(entry, []).append(result)

    def finish(self, quiet: bool) -> None:
        """Write and tell what there is."""
        made = {precision: prices(found) for precision, found in self.found.items() if found}
        said = report.sentences(made)
        where = (
            f"{self.plan.arch}, {self.threads} thread{'s' if self.threads > 1 else ''}; variant {self.plan.labels[0]}"
        )
        foot = words(self.machine)
        make(self.root)
        head = {"scene": self.plan.name, "parameters": self.plan.fixed, "variant": self.plan.labels[0]}
        head |= {"arch": self.plan.arch, "threads": self.threads, "rounds": self.rounds, "steps": STEPS}
        write_text(self.root / "prices.json", as_json({**head, "machine": self.machine, "prices": made}))
        write_text(self.root / "prices.csv", as_csv(made))
        write_text(self.root / "prices.md", report.text(self.plan.name, where, made, said, self.rounds, STEPS, foot))
        if any("wrong" not in one for one in made.values()):
            from .picture import draw

            with writing(self.root / "prices.png"), replacing(self.root / "prices.png") as part:
                draw(self.plan.name, made, where, foot, part)
        if not quiet:
            tell(made, said, self.root)


def tell(made: dict, said: list[str], root: Path) -> None:
    """On the terminal."""
    for head, cells in report.tables(made):
        table(head, cells)
        say()
    for sentence in said:
        say(sentence)
    say()
    say(f"{root}: {', '.join(FILES)}")


def as_csv(made: dict) -> str:
    """precision, kind, name, ms, share, bytes: a line for every price."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(("precision", "kind", "name", "ms", "share", "bytes"))
    for precision, one in made.items():
        for kind in ("terms", "upto", "choices"):
            for price in one.get(kind, ()):
                writer.writerow((precision, kind, price["name"], price["ms"], price.get("share"), price.get("bytes")))
        for phase, ms in one.get("phases", {}).items():
            writer.writerow((precision, "phase", phase, ms, ms / one["whole"]["ms"], ""))
    return out.getvalue()


def main(plan: Plan, scene, precisions: list[str], rounds: int, args) -> int:
    """Measure and tell; returns 0, or 130 if interrupted. scene: the plan's variant; args: out, budget, quiet."""
    root = Path(args.out or Path("out") / "cost" / plan.name)
    ours(root, plan.name)
    made = List(plan, scene, precisions, plan.settings[0].threads, rounds, root)
    with Stop() as stop, tempfile.TemporaryDirectory(prefix="spmhd-prices-") as folder:
        try:
            measure(made, Path(folder), args, stop)
        except Interrupted:
            from ...cli.main import INTERRUPTED, complain

            if any(made.found.values()):
                made.finish(args.quiet)
            return complain("interrupted; the list holds what was measured", INTERRUPTED)
    made.finish(args.quiet)
    return 0


def measure(made: List, folder: Path, args, stop: Stop) -> None:
    """Run all rounds, as far as the budget goes; what cannot be built is tried once."""
    todo = made.todo(folder)
    entry_of = {id(task): entry for entry, task in todo}
    tasks = [task for _, task in todo]
    forecast, bar, wrong = Forecast(tasks, args.budget), progress(args.quiet), set()
    bar.note(
        f"{made.plan.name}: {len(made.entries)} entries in {' and '.join(made.found)}, {made.rounds} rounds; compiling"
    )
    try:
        wanted = lambda task: task.setting.key not in wrong and forecast.fits(task)  # noqa: E731
        for done, (task, result) in enumerate(
            one_by_one(tasks, made.plan.arch, wanted, stop.check, environment(folder)), 1
        ):
            wrong |= {task.setting.key} if "wrong" in result else set()
            if "wrong" not in result:
                forecast.learn(task, {**result, "seconds": TURNS * STEPS * (result["ms"] + result["whole_ms"]) / 1e3})
            made.add(entry_of[id(task)], task, result, folder)
            bar.show(forecast.share(done), result.get("particles", 0) * 1e3 / result.get("ms", float("inf")))
    finally:
        bar.end()


def ours(root: Path, name: str) -> None:
    """Refuse a folder whose files of these names are not a price list of this scene."""
    before = read_json(root / "prices.json")
    strange = [file for file in FILES if (root / file).exists()] if before is None else []
    if strange:
        raise InputError(f"{root / strange[0]} is there, but no list of ours made it; choose another folder with --out")
    if isinstance(before, dict) and before.get("scene") != name:
        raise InputError(f"--out {root} holds the prices of {before.get('scene')}; choose another folder with --out")
