"""What an analysis leaves: files, and a few lines on the terminal."""

from pathlib import Path

from ..machine import machine, words
from ..outputs.files import as_json, write_text, writing
from ..outputs.words import say, table
from ..replacing import replacing
from . import picture, rows, scan_picture
from .result import STILL

MANY = 12  # rows told on the terminal


def write(out: Path, name: str, varied: dict, made: list[dict], whole: dict) -> None:
    """dispersion.csv, .png and .json, each whole or not at all."""
    here = machine()
    write_text(out / "dispersion.csv", rows.table_of_scan(made) if varied else rows.table_of_waves(whole))
    with writing(out / "dispersion.png"), replacing(out / "dispersion.png") as part:
        if varied:
            scan_picture.draw(name, varied, made, words(here), part)
        else:
            picture.draw(name, whole, words(here), part)
    record = {"scene": name, "scan": varied, "machine": here, "rows": made}
    record["states"] = {label: rows.state(found) for label, found in whole.items()}
    record["lines"] = {label: rows.lines(found) for label, found in whole.items() if found.lines}
    write_text(out / "dispersion.json", as_json(record))


def tell(made: list[dict], varied: dict, whole: dict, out: Path, quiet: bool) -> None:
    """The fastest growth of each state; of a long scan the extremes."""
    if quiet:
        return
    by_growth = sorted(made, key=lambda row: -row["growth"])
    shown = made if len(made) <= MANY else [*by_growth[:3], by_growth[-1]]
    names = [name for name in ("variant", *varied, "xi", "beta", "lattice", "kernel") if told(name, varied, made)]
    head = [*names, "growth", "wavelength [dx]", "angle to B", "frequency"]
    table(head, [[*(short(given(row, name)) for name in names), *mode(row)] for row in shown])
    if len(made) > MANY:
        still = sum(row["growth"] < STILL for row in made)
        say(f"{len(made)} states: the fastest-growing three and the slowest; in {still} nothing grows")
    for label, found in whole.items():
        if found.background.B is not None and not found.gas.v_A:
            say(f"{label or 'here'}: no field in the mean of the start; --at X Y takes the state at a spot")
    say(f"written: {out / 'dispersion.png'}, dispersion.csv, dispersion.json")


def told(name: str, varied: dict, made: list[dict]) -> bool:
    """Whether a column says something: what varies, what differs, and the state itself."""
    differs = len({str(given(row, name)) for row in made}) > 1
    return name in varied or differs or (not varied and name != "variant") or (name == "variant" and not varied)


def given(row: dict, name: str):
    """What was set, or else what the state has."""
    return row["parameters"].get(name, row.get(name))


def short(value) -> str:
    """A parameter or label in few digits."""
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def mode(row: dict) -> list[str]:
    """Growth, wavelength, angle and frequency in words."""
    if row["growth"] < STILL:
        return [f"none (below {STILL:g} {row['unit']})", "", "", ""]
    rate = f"{row['growth']:.4f} {row['unit']}"
    return [rate, f"{row['wavelength']:.3f}", f"{row['angle']:.1f}", f"{row['frequency']:.3g}"]
