"""The command: analyse a scene's variants, or scan over parameters and choices; write the files, tell the rates."""

from collections.abc import Callable, Iterator
from pathlib import Path

from ..errors import InputError
from ..library import find, parameters_of
from ..outputs.files import folder_at, make
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
    out = folder_at(args.out or Path("out") / "dispersion" / path.stem)
    made, whole = [], {}
    with Stop() as stop, code_of(path):
        try:
            for label, row, found in analysed(scan, args, stop):
                made.append(row)
                whole[label if not scan.varied else ""] = found  # of a scan only the last is kept whole
        except Interrupted:
            pass
    if not made and not stop.asked:
        raise InputError(f"--variant {' '.join(args.variant)}: no state of this scan has it; see spmhd show")
    if made:
        make(out)
        report.write(out, path.stem, scan.varied, made, whole)
        report.tell(made, scan.varied, whole, out, args.quiet)
    if stop.asked:
        return complain(f"interrupted; {f'{len(made)} found, in {out}' if made else 'nothing found yet'}", INTERRUPTED)
    return DONE


def analysed(scan: Scan, args, stop: Stop) -> Iterator[tuple]:
    """(label, row, Dispersion) of every point and every variant."""
    points, at = scan.points(), None if args.at is None else tuple(args.at)
    bar = progress(args.quiet or (len(points) == 1 and args.lattice != "glass"))  # what takes seconds needs none
    with Analyst() as analyst:
        try:
            for n, point in enumerate(points):
                variants = scan.variants(point)
                for m, (label, scene) in enumerate(variants.items()):
                    tell = shares(bar, stop, n + m / len(variants), len(points), 1 / len(variants))
                    found = analyst.analyse(scene, args.lattice, at, lines=not scan.varied, tell=tell)
                    yield label, rows.row(label, parameters_at(scan, point), found), found
        finally:
            bar.end()


def shares(bar, stop: Stop, before: float, of: int, part: float) -> Callable[[float], None]:
    """Tells the bar how far this part of so many is; somebody who asked to stop is heard here, too."""
    stop.check()

    def tell(share: float) -> None:
        stop.check()
        bar.show((before + share * part) / of, 0.0)

    return tell


def parameters_at(scan: Scan, point: dict) -> dict:
    """All parameters of the scene, and what was chosen beside them."""
    own = {name: value for name, value in point.items() if name in scan.known}
    return {**parameters_of(scan.path, **{**scan.given, **own}), **point}
