"""The command: analyse a scene's variants, or scan over parameters and choices; write the files, tell the rates."""

from collections.abc import Callable, Iterator
from pathlib import Path

from ..errors import InputError
from ..library import find, parameters_of
from ..outputs.files import writing
from ..outputs.progress import progress
from ..outputs.signals import Interrupted, Stop
from ..scene_code import code_of
from . import report, rows
from .analysis import Analyst
from .scan import Scan


def main(args, given: dict) -> int:
    """given: the assignments of --set. Returns 0, or 130 where it was interrupted: what was found is written."""
    from ..cli.main import DONE, INTERRUPTED, complain

    path = find(args.scene)
    scan = Scan(path, given, args.scan, args.variant)
    out = place(args.out or Path("out") / "dispersion" / path.stem)
    made, whole = [], {}
    with Stop() as stop, code_of(path):
        try:
            for label, row, found in analysed(scan, args, stop):
                made.append(row)
                whole[label if not scan.varied else ""] = found  # of a scan only the last is kept whole
        except Interrupted:
            pass
    if made:
        report.write(out, path.stem, scan.varied, made, whole)
        report.tell(made, scan.varied, whole, out, args.quiet)
    if stop.asked:
        return complain(f"interrupted; {f'{len(made)} found, in {out}' if made else 'nothing found yet'}", INTERRUPTED)
    return DONE


def place(out) -> Path:
    """The folder, made."""
    out = Path(out)
    for part in (out, *out.parents):
        if part.exists() and not part.is_dir():
            raise InputError(f"--out {out}: {part} is a file; give a folder")
    with writing(out):
        out.mkdir(parents=True, exist_ok=True)
    return out


def analysed(scan: Scan, args, stop: Stop) -> Iterator[tuple]:
    """(label, row, Dispersion) of every point and every variant."""
    points, bar = scan.points(), progress(args.quiet)
    at = None if args.at is None else tuple(args.at)
    with Analyst() as analyst:
        try:
            for n, point in enumerate(points):
                for label, scene in scan.variants(point).items():
                    stop.check()
                    tell = shares(bar, n, len(points), args.lattice == "glass")
                    found = analyst.analyse(scene, args.lattice, at, lines=not scan.varied, tell=tell)
                    yield label, rows.row(label, parameters_at(scan, point), found), found
        finally:
            bar.end()


def shares(bar, n: int, of: int, slow: bool) -> Callable[[float], None]:
    """What tells the bar of the progress of the n-th of so many; a single one that takes seconds needs none."""
    return (lambda share: bar.show((n + share) / of, 0.0)) if of > 1 or slow else (lambda share: None)


def parameters_at(scan: Scan, point: dict) -> dict:
    """All parameters of the scene, and what was chosen beside them."""
    own = {name: value for name, value in point.items() if name in scan.known}
    return {**parameters_of(scan.path, **{**scan.given, **own}), **point}
