"""Rows in words: one line as each comes, tables at the end."""

from ..outputs.words import rate, table
from .clocks import PHASES


def name(row: dict) -> str:
    """mhd3d_f64, 2 threads."""
    where = f"{row['threads']} thread{'s' if row['threads'] > 1 else ''}" if row["arch"] == "cpu" else row["arch"]
    return f"{row['case']}, {where}"


def line(row: dict) -> str:
    """What is said while the next case runs."""
    return f"{name(row)}: {rate(row['updates_per_s'])}"


def tables(rows: list[dict]) -> None:
    """Speed and size, then where the step goes in ns a particle."""
    head = ("case", "particles", "neighbours", "listed", "M updates/s", "spread", "cores", "builds/step",
            "rates/yardstick", "list GB/s", "bytes", "compile s")  # fmt: skip
    table(head, [speed(row) for row in rows], title="\nFull steps")
    head = ("case", "ns/particle", *PHASES, "explained")
    table(head, [shares(row) for row in rows], title="\nWhere a step goes (ns a particle)")


def speed(row: dict) -> list[str]:
    """Cells of the first table."""
    return [
        name(row),
        str(row["particles"]),
        f"{row['neighbours']:.1f}",
        f"{row['listed']:.1f}",
        f"{row['updates_per_s'] / 1e6:.3f}",
        f"{100 * row['spread']:.0f} %",
        f"{row['cores']:.2f}",
        f"{row['builds_per_step']:.2f}",
        f"{row['rates_per_yardstick']:.2f}",
        f"{row['list_GB_per_s']:.2f}",
        str(row["bytes_per_particle"]),
        f"{row['seconds_compile']:.1f}",
    ]


def shares(row: dict) -> list[str]:
    """Cells of the second."""
    each = 1e6 / row["particles"]
    phases = [f"{row['phases_ms'][phase] * each:.0f}" for phase in PHASES]
    whole = sum(row["phases_ms"].values()) / row["step_ms"]
    return [name(row), f"{row['step_ms'] * each:.0f}", *phases, f"{100 * whole:.0f} %"]


def scale_table(rows: list[dict]) -> None:
    """Both sizes of every case."""
    head = ("case", "particles", "ns/particle", *PHASES, "list share", "memory share", "growth")
    cells = [
        [
            row["case"],
            str(at["particles"]),
            f"{at['ns']:.0f}",
            *(f"{at['phases_ns'][phase]:.0f}" for phase in PHASES),
            f"{100 * at['list_share']:.0f} %",
            f"{100 * at['memory_share']:.0f} %",
            f"{row['growth']:.2f}",
        ]
        for row in rows
        for at in (row["small"], row["large"])
    ]
    table(head, cells, title="\nTime a particle as the problem grows (one thread)")
