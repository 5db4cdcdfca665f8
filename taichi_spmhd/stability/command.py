"""The command: make the trials, write each down, tell and draw."""

from pathlib import Path

from ..outputs.signals import Interrupted, Stop
from ..outputs.words import duration, say
from . import report
from .battery import tasks, wanted
from .cases import CASES
from .presets import PRESETS
from .record import Record
from .trial import SOUND


def main(args, device: dict) -> int:
    """Returns 0 if one preset is sound throughout, 3 if none is, 130 where it was interrupted."""
    from ..cli.main import DONE, INTERRUPTED, WENT_WRONG, complain

    whole = args.full
    cases = wanted(args.only, CASES, "--only")
    presets = wanted(args.preset or (None if whole else ["robust"]), PRESETS, "--preset")
    record = Record(args.out or Path("out") / "stability", device["precision"])
    with Stop() as stop:
        try:
            made = carry_out(record, tasks(cases, presets, whole, record.precision), stop, args.quiet)
        except Interrupted:
            finish(record, args.quiet)
            return complain(f"interrupted; what was found is in {record.root}", INTERRUPTED)
    finish(record, args.quiet)
    asked = [row for row in made if not row["beyond_asked"]]
    stand = [p for p in presets if all(row["verdict"] == SOUND for row in asked if row["preset"] == p)]
    if not args.quiet:
        spent = duration(sum(row["seconds"] for row in made))
        say(f"{report.summary(made)} in {spent}; written: {record.root / 'stability.md'}, .json, .png")
    return DONE if stand else complain("no preset is sound in all of these cases; see stability.md", WENT_WRONG)


def carry_out(record: Record, asked, stop: Stop, quiet: bool) -> list[dict]:
    """Every trial; its outcome decides whether a harder one follows."""
    made, row = [], None
    try:
        task = next(asked)
        while True:
            stop.check()
            row = task.make(stop.check)
            record.add(row)
            made.append(row)
            report.tell(row, quiet)
            task = asked.send(row)
    except StopIteration:
        return made


def finish(record: Record, quiet: bool) -> None:
    """Table and picture of all that is on record."""
    if record.rows:
        report.finish(record.root, record.rows)
