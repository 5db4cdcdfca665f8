"""Where and when something was measured."""

import datetime
import subprocess
from pathlib import Path

from .runtime import hardware


def machine() -> dict:
    """Processor, version, commit of a checkout, date."""
    from . import __version__

    now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    return {"hardware": hardware(), "version": __version__, "commit": commit(), "date": now}


def commit() -> str | None:
    """The commit this package was checked out from, with a + where files were changed since; None without git."""
    here = Path(__file__).resolve().parents[1]
    if not (here / ".git").exists():
        return None
    try:
        words = ["git", "-C", str(here), "describe", "--always", "--abbrev=8", "--exclude=*", "--dirty=+"]
        return subprocess.run(words, capture_output=True, text=True, timeout=10, check=True).stdout.strip() or None
    except (OSError, subprocess.SubprocessError):
        return None


def words(made: dict) -> str:
    """One line under every table and picture."""
    version = f"taichi_spmhd {made['version']}" + (f" ({made['commit']})" if made["commit"] else "")
    return f"{made['hardware']}; {version}, {made['date']}"
