"""The end of a run: summary.json, table.md where variants can be compared, and a short table on the terminal."""

from .. import __version__
from ..runtime import ti
from ..scene_code import code_of
from .comparison import comparison
from .files import as_json, write_text
from .run import Run
from .words import duration, rate, say, size, table


def processor(device: dict) -> str:
    """What Taichi compiles for: x64, arm64, cuda, ..."""
    arch = getattr(ti.lang.impl.current_cfg(), "arch", None)
    return getattr(arch, "name", None) or device["arch"]


def summary(run: Run) -> dict:
    """What summary.json says."""
    plan, variants = run.plan, {}
    for label, sim in run.sims.items():
        with code_of(plan.path):
            variants[label] = sim.summary()
        if label in run.errors:
            variants[label]["error"] = run.errors[label]
    record = plan.record()
    head = {name: record[name] for name in ("scene", "parameters")}
    device = {"arch": processor(plan.device), "precision": plan.device["precision"], "threads": plan.device["threads"]}
    rest = {name: record[name] for name in ("frames", "movie", "t_end")}
    return {**head, "version": __version__, **device, **rest, "variants": variants}


def finish(run: Run) -> dict:
    """Write summary.json and table.md, mark the run as ended, return the summary."""
    made = summary(run)
    write_text(run.folder.summary, as_json(made))
    if len(run.plan.variants) > 1:
        measures = {label: scene.measure for label, scene in run.plan.variants.items()}
        write_text(run.folder.table, comparison(made, measures))
    run.folder.end()
    return made


HEADERS = ("", "steps", "seconds", "speed", "mean gap", "close pairs", "momentum drift", "energy drift", "errors")


def tell(made: dict, run: Run) -> None:
    """A line per variant, and where the files are."""
    table(HEADERS, [row(label, made["variants"][label], scene.measure) for label, scene in run.plan.variants.items()])
    film, count = run.folder.film(run.folder.record), len(list(run.folder.frames.glob("[0-9]*.png")))
    parts = [f"{count} frames"] + ([f"{film.name} ({size(film.stat().st_size)})"] if film.exists() else [])
    parts += ["table.md"] if run.folder.table in run.folder.own(run.folder.record) else []
    say(f"{run.folder.root}: {', '.join(parts)}, summary.json, histories, states")


def row(label: str, entry: dict, measure: str | None) -> tuple:
    """The cells of one variant; of its errors the one that the scene names, else all."""
    found = entry.get("errors", {})
    errors = ", ".join(f"{name} {found[name]:.2g}" for name in ([measure] if measure in found else found))
    return (
        label,
        entry["steps"],
        duration(entry["seconds"]),
        rate(entry["updates_per_s"]),
        figure(entry.get("mean_gap"), "{:.3f}"),
        figure(entry.get("close_pairs"), "{:.1%}").replace("%", " %"),
        figure(entry.get("momentum_drift"), "{:.1e}"),
        figure(entry.get("energy_drift"), "{:.1e}"),
        ("went wrong; " if "error" in entry else "") + errors,
    )


def figure(value, form: str) -> str:
    """A number, or nothing where there is none."""
    return "" if value is None else form.format(value)
