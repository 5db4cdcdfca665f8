"""What a study says: cost.md, cost.png, the tables and the answers on the terminal."""

from ..machine import words
from ..outputs.comparison import row as line
from ..outputs.files import write_text, writing
from ..outputs.words import say, table
from ..replacing import replacing
from .answers import answers
from .busy import busy
from .calibration import STANDARD
from .orders import convergence, fit, methods, pareto
from .orders import words as value_words

NOTE = (
    "seconds: of all steps to the end, the median of {repeat} runs that were interleaved with those of the other "
    "settings, +- half their spread; compiling, pictures and files are not in them. scaled: seconds on a machine whose "
    "calibration loop, which ran beside every measurement, takes {standard:.0f} ms. error: normalised L1, of a vector "
    "mean |difference| / mean |exact|. drifts: of energy in E, of momentum in M v_rms; in brackets what the terms "
    "predict. div B: mean h |div B|/|B|. close pairs: particles whose nearest neighbour is within half a spacing. "
    "* on the Pareto front: nothing cheaper errs less."
)
HEADERS = ("seconds", "+-", "scaled", "steps", "M updates/s", "energy drift", "momentum drift", "div B", "close pairs",
           "compile s", "")  # fmt: skip


def finish(record, quiet: bool) -> None:
    """Write the text and the picture; tell."""
    from .picture import draw

    plan, made, error = record.plan, record.rows(), record.error()
    said = answers(plan, made, error)
    warning = busy(record.runs, made)
    said += [warning] if warning else []
    tables = [(headers(plan, error), lines(plan, made)), orders(plan, made)]
    write_text(record.root / "cost.md", text(record, said, [one for one in tables if one[1]]))
    if any(row["error"] for row in made):
        with writing(record.root / "cost.png"), replacing(record.root / "cost.png") as part:
            draw(plan, made, error, place(record), words(record.head["machine"]), part)
    if not quiet:
        tell(record, said, [one for one in tables if one[1]])


def tell(record, said: list[str], tables) -> None:
    """On the terminal."""
    for head, cells in tables:
        table(head, cells)
        say()
    for sentence in said:
        say(sentence)
    say()
    say(f"{record.root}: cost.md, cost.png, cost.csv, cost.json")


def place(record) -> str:
    """cpu, 2 threads, f64: what does not vary of the place."""
    first, telling = record.runs[0] if record.runs else {}, record.plan.telling
    values = record.plan.settings[0].values()
    parts = [value_words(name, values[name]) for name in ("threads", "precision") if name not in telling]
    return ", ".join([first.get("arch", record.plan.arch), *parts])


def headers(plan, error: str) -> list[str]:
    """Names of the columns."""
    return [*plan.telling, f"error in {error}", *HEADERS]


def lines(plan, made: list[dict]) -> list[list[str]]:
    """One setting a line."""
    best = pareto(made)
    return [cells(plan, row, any(row is one for one in best)) for row in made]


def cells(plan, row: dict, best: bool) -> list[str]:
    """One setting."""
    own = [str(row["setting"].get(name, "")) for name in plan.telling]
    if row["wrong"]:
        return [*own, "", *[""] * (len(HEADERS) - 1), f"went wrong: {row['wrong']}"]
    div_B = row.get("div_B")
    return [
        *own,
        f"{row['error']:.3g}" if row["error"] is not None else "",
        f"{row['seconds']:.3g}",
        f"{100 * row['spread'] / 2:.0f} %",
        f"{row['seconds_scaled']:.3g}",
        str(row["steps"]),
        f"{row['updates_per_s'] / 1e6:.2f}",
        f"{row['energy_drift']:.0e} ({row['energy_drift_predicted']:.0e})",
        f"{row['momentum_drift']:.0e} ({row['momentum_drift_predicted']:.0e})",
        f"{div_B['mean']:.1e}" if div_B else "",
        f"{100 * row['close_pairs']:.1f} %" if row.get("close_pairs") is not None else "",
        f"{row['seconds_compile']:.1f}",
        "; ".join((["*"] if best else []) + row["doubts"]),
    ]


def orders(plan, made: list[dict]) -> tuple[list[str], list[list[str]]]:
    """The order of convergence of every method, between each resolution and the next, and over all."""
    found = {
        name: rows for name, rows in methods(made, plan.telling, plan.level).items() if convergence(rows, plan.level)
    }
    body = []
    for name, rows in found.items():
        steps = " to ".join(f"{row['setting'][plan.level]:g}" for row in rows)
        each = ", ".join(f"{order:.2f}" for order in convergence(rows, plan.level))
        body.append([name or plan.labels[0], steps, each, f"{fit(rows, plan.level):.2f}"])
    return ["method", plan.level or "", "orders of convergence", "least squares"], body


def text(record, said: list[str], tables) -> str:
    """cost.md."""
    plan = record.plan
    fixed = " ".join(f"{name}={value}" for name, value in plan.fixed.items() if name not in plan.varied)
    variants = f"variant{'s' if len(plan.labels) > 1 else ''}: {', '.join(plan.labels)}"
    out = [f"# {plan.name}: what accuracy costs in time, t = {plan.t_end:g}", ""]
    out += [f"{place(record)}; {f'parameters: {fixed}; ' if fixed else ''}{variants}.", ""]
    out += [f"- {sentence}" for sentence in said]
    for head, cells in tables:
        out += ["", line(head), line("---" for _ in head), *map(line, cells)]
    out += ["", NOTE.format(repeat=plan.repeat, standard=1e3 * STANDARD)]
    out += ["", *(f"Anchor {anchor.label}: {anchor.source}." for anchor in plan.anchors)] if plan.anchors else []
    return "\n".join([*out, "", f"{words(record.head['machine'])}.", ""])
