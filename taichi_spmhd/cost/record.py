"""Record: the folder of a study. cost.json holds every run as it comes, cost.csv the rows; both are always whole."""

import csv
import io

from ..errors import InputError
from ..outputs.files import as_json, folder_at, make, plain, read_json, write_text
from ..outputs.folder import difference
from .rows import rows
from .sound import sound

MAY_GROW = ("vary", "variants", "places")  # a study may be resumed with more settings
FILES = ("cost.json", "cost.csv", "cost.md", "cost.png")


class Record:
    """runs: results with their setting's key and round, in the order in which they came."""

    def __init__(self, root, plan, machine: dict):
        self.root, self.plan = folder_at(root), plan
        self.head = {**plan.record(), "repeat": plan.repeat, "machine": machine}
        self.runs: list[dict] = []

    def begin(self) -> None:
        """Refuse what is not ours before anything is measured; an earlier study stays until the first result."""
        before = read_json(self.root / "cost.json")
        if isinstance(before, dict) and before.get("scene") != self.plan.name:
            raise InputError(
                f"--out {self.root} holds a study of {before.get('scene')}; choose another folder with --out"
            )
        strange = [name for name in FILES if (self.root / name).exists()] if before is None else []
        if strange:
            raise InputError(f"{self.root / strange[0]} is there, but no study of ours made it; choose another folder")

    def take_up(self) -> None:
        """The runs of the study in this folder. Raises InputError where there is none, or another."""
        before = read_json(self.root / "cost.json")
        if not isinstance(before, dict) or "runs" not in before:
            raise InputError(f"--resume: there is no study in {self.root}; leave out --resume to start one")
        if not sound(before):
            raise InputError(f"--resume: {self.root / 'cost.json'} is damaged; start anew without --resume")
        for name, value in self.plan.record().items():
            if name not in MAY_GROW and before.get(name) != value:
                raise InputError(f"--resume: {difference(name, before.get(name), value)}")
        self.head["machine"] = before["machine"]  # where and when the runs there were made
        there = {setting.key for setting in self.plan.settings}
        self.runs = [run for run in before["runs"] if run["key"] in there and run["round"] < self.plan.repeat]

    def done(self) -> set[tuple[str, int]]:
        """(key, round) of what need not run again: what was measured, and all rounds of what went wrong."""
        wrong = {run["key"] for run in self.runs if run.get("wrong")}
        every = {(key, k) for key in wrong for k in range(self.plan.repeat)}
        return every | {(run["key"], run["round"]) for run in self.runs}

    def add(self, task, result: dict) -> None:
        """One more run, on the disk when this returns."""
        self.runs.append(plain({"key": task.setting.key, "round": task.round, **result}))
        make(self.root)
        self.write()

    def write(self) -> None:
        """cost.json and cost.csv."""
        made = self.rows()
        write_text(
            self.root / "cost.json", as_json({**self.head, "error": self.error(), "rows": made, "runs": self.runs})
        )
        write_text(self.root / "cost.csv", table(made))

    def error(self) -> str | None:
        """The member that is quoted. Raises InputError where no run has it."""
        found = next((run["errors"] for run in self.runs if run.get("errors")), {})
        wanted = self.plan.error
        if wanted and found and wanted not in found:
            raise InputError(f"--error {wanted}: there is no such error; there are {', '.join(found)}")
        return wanted or next(iter(found), None)

    def rows(self) -> list[dict]:
        """What the runs say together, method by method, each from coarse to fine."""
        return sorted(rows(self.plan.settings, self.runs, self.error()), key=lambda row: self.plan.rank(row["setting"]))


def table(made: list[dict]) -> str:
    """Rows as CSV, one column for every number."""
    flat = [flattened(row) for row in made]
    names = list(dict.fromkeys(name for row in flat for name in row))
    out = io.StringIO()
    writer = csv.DictWriter(out, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(flat)
    return out.getvalue()


def flattened(row: dict) -> dict:
    """{"errors": {"B": 1}} as {"error_B": 1}; a setting's values without a prefix; doubts as one text."""
    out = dict(row["setting"])
    for name, value in row.items():
        if name == "errors":
            out.update({f"error_{member}": number for member, number in value.items()})
        elif name == "div_B":
            out.update({f"div_B_{which}": number for which, number in value.items()})
        elif name == "doubts":
            out[name] = "; ".join(value)
        elif name not in ("setting", "key"):
            out[name] = value
    return out
