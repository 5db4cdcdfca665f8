"""The one place that imports and starts Taichi: device, precision, threads, cache."""

import contextlib
import io
import os
import sys

from .cache import LARGEST, free
from .errors import InputError
from .launching import quicken
from .tracing import remember

_LIBX11 = (
    "taichi cannot be imported because the system library libX11 is missing "
    "(Debian/Ubuntu: apt-get install libx11-6; Fedora: dnf install libX11); no display is needed"
)


def _import_taichi():
    """Taichi without its banner; a missing libX11 becomes one clear line."""
    os.environ.setdefault("ENABLE_TAICHI_HEADER_PRINT", "0")
    try:
        import taichi
    except (ImportError, OSError) as error:
        if "libX11" in str(error):
            raise InputError(_LIBX11) from error
        raise
    remember(taichi)
    quicken(taichi)
    taichi.set_logging_level(taichi.ERROR)  # a library that is not there is our sentence, not Taichi's
    return taichi


ti = _import_taichi()

PRECISIONS = ("f64", "f32")
ARCHS = ("auto", "cpu", "cuda", "vulkan", "metal")
_current: dict = {}


def _available(arch: str) -> bool:
    """Whether Taichi can start on `arch` here."""
    if arch == "cpu":
        return True
    return ti._lib.core.__dict__[f"with_{arch}"]()


def _choose(arch: str, precision: str) -> str:
    """The device to start, or an InputError that says what is there."""
    if arch not in ARCHS:
        raise InputError(f"unknown --arch {arch!r}: choose one of {', '.join(ARCHS)}")
    if precision not in PRECISIONS:
        raise InputError(f"unknown --precision {precision!r}: choose one of {', '.join(PRECISIONS)}")
    if arch == "auto":
        return "cuda" if _available("cuda") else "cpu"
    if not _available(arch):
        there = ", ".join(a for a in ARCHS[1:] if _available(a))
        raise InputError(f"--arch {arch}: no such device here; there is {there} (use --arch cpu)")
    if arch == "metal" and precision == "f64":
        raise InputError("--arch metal cannot do f64; add --precision f32 or use --arch cpu")
    return arch


def init(arch: str = "auto", precision: str = "f64", threads: int | None = None) -> dict:
    """Start Taichi once per process and return what runs: {"arch", "precision", "threads"}.

    arch: auto (a CUDA GPU if there is one, else the CPU), cpu, cuda, vulkan or metal; precision: f64 or f32;
    threads: CPU threads, default all cores. A second call with the same values does nothing. Raises InputError for
    an arch that is not there or that cannot do the precision, and for a second call with other values.
    """
    if threads is not None and not (isinstance(threads, int) and 1 <= threads <= 1024):
        raise InputError(f"--threads {threads!r}: give a whole number from 1 to 1024")
    wanted = {"arch": _choose(arch, precision), "precision": precision, "threads": threads or os.cpu_count() or 1}
    if _current:
        if wanted != _current:
            raise InputError(
                f"Taichi already runs with {_current}; one process cannot change to {wanted}: start a new one"
            )
        return dict(_current)
    with contextlib.redirect_stdout(io.StringIO()):  # Taichi announces its device on stdout
        _start(wanted)
    _current.update(wanted)
    return dict(_current)


def _start(wanted: dict) -> None:
    real = ti.f64 if wanted["precision"] == "f64" else ti.f32
    free(ti.lang.impl.default_cfg().offline_cache_file_path)
    ti.init(
        arch=getattr(ti, wanted["arch"]),
        default_fp=real,
        cpu_max_num_threads=wanted["threads"],
        offline_cache=True,
        offline_cache_max_size_of_files=LARGEST,
        fast_math=True,
        log_level=ti.ERROR,
        random_seed=0,
        unrolling_limit=0,  # a record has as many members as its terms ask for: that is no mistake
    )


def started() -> dict:
    """What runs, or {} before init."""
    return dict(_current)


def ensure() -> dict:
    """Start with the defaults where the caller has not done so."""
    return started() or init()


def hardware() -> str:
    """The processor's name, for tables of measurements."""
    if sys.platform.startswith("linux"):
        with open("/proc/cpuinfo") as lines:
            names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
        if names:
            return f"{names[0]}, {os.cpu_count()} cores"
    import platform

    return f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores"
