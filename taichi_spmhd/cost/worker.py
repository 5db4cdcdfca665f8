"""Worker: a process that computes, as its parent sees it; Workers: one for each precision and number of threads."""

import json
import os
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path

from ..errors import InputError, RunError
from .child import MARK

PACKAGE = Path(__file__).resolve().parents[2]  # where a child finds this package, installed or not
PATIENCE = 0.2  # seconds between two looks whether somebody wants to stop


class Died(RunError):
    """The process ended before it answered."""


class Worker:
    """worker = Worker("cpu", "f64", 2); worker.ask(order) -> result. It ends with its parent, or by close()."""

    def __init__(self, arch: str, precision: str, threads: int, environment: dict | None = None):
        words = ["--arch", arch, "--precision", precision, "--threads", str(threads)]
        path = os.pathsep.join([str(PACKAGE), *filter(None, [os.environ.get("PYTHONPATH")])])
        self.complaints = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")  # noqa: SIM115  until close()
        self.running = subprocess.Popen(
            [sys.executable, "-m", "taichi_spmhd.cost.child", *words],
            env={**os.environ, "PYTHONPATH": path, "PYTHONUNBUFFERED": "1", **(environment or {})},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self.complaints,
            text=True,
            encoding="utf-8",
            start_new_session=True,  # Ctrl-C is the parent's
        )
        self.lines: queue.Queue = queue.Queue()
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self) -> None:
        """Every line the process prints; None when it has ended."""
        for line in self.running.stdout:
            self.lines.put(line)
        self.lines.put(None)

    def ask(self, order: dict, check: Callable = lambda: None) -> dict:
        """The result of an order. check() may raise to stop waiting. Raises Died, or InputError for a wrong device."""
        try:
            self.running.stdin.write(json.dumps(order) + "\n")
            self.running.stdin.flush()
        except OSError:
            raise self.death() from None
        while True:
            check()
            try:
                line = self.lines.get(timeout=PATIENCE)
            except queue.Empty:
                continue
            if line is None:
                raise self.death()
            if line.startswith(MARK):
                return json.loads(line[len(MARK) :])

    def death(self) -> Exception:
        """Why the process ended."""
        code = self.running.wait()
        self.complaints.seek(0)
        said = self.complaints.read().strip().splitlines()
        last = said[-1] if said else f"exit code {code}"
        if "InputError: " in last:
            return InputError(last.split("InputError: ", 1)[1])
        return Died(f"the process that computes ended: {last}")

    def close(self) -> None:
        """End the process, whatever it does."""
        self.running.kill()
        self.running.wait()
        self.running.stdin.close()
        self.complaints.close()


class Workers:
    """Workers of one arch, started when first asked for. One that dies is replaced, and its order repeated once."""

    def __init__(self, arch: str, environment: dict | None = None):
        self.arch, self.environment, self.there = arch, environment, {}

    def ask(self, order: dict, check: Callable = lambda: None) -> dict:
        """The result of an order, which says precision and threads; {"wrong": ...} where two processes died of it."""
        try:
            return self.worker(order).ask(order, check)
        except Died:
            self.drop(order)
        try:
            return self.worker(order).ask(order, check)
        except Died as death:
            self.drop(order)
            return {"wrong": str(death)}

    def worker(self, order: dict) -> Worker:
        """The process for an order's precision and threads."""
        place = order["precision"], order["threads"]
        if place not in self.there:
            self.there[place] = Worker(self.arch, *place, self.environment)
        return self.there[place]

    def drop(self, order: dict) -> None:
        """Forget a process that has ended."""
        self.there.pop((order["precision"], order["threads"])).close()

    def close(self) -> None:
        """End all processes."""
        while self.there:
            self.there.popitem()[1].close()
