"""Runs on a Dask cluster: the same orders, answered by whichever of its workers is free.

Every Dask worker keeps processes of its own, one for each precision and number of threads (worker.py), so Taichi starts
once in each. The cluster repeats the run of a worker that is lost.
"""

import threading
import time
from collections.abc import Callable, Iterator

from ..errors import InputError
from .worker import Workers

PATIENCE = 10.0  # seconds for the cluster to answer
LOOK = 0.1  # seconds between two looks at what has come

_here: dict[str, Workers] = {}  # of a Dask worker, by arch
_one_at_a_time = threading.Lock()  # a Dask worker may have several threads; runs side by side would share its cores


def answer(arch: str, order: dict) -> dict:
    """The result of an order; runs in a Dask worker."""
    with _one_at_a_time:
        return _here.setdefault(arch, Workers(arch)).ask(order)


def on_cluster(todo: list, arch: str, address: str, wanted: Callable, check: Callable) -> Iterator[tuple]:
    """(task, result) as they come. wanted(task): whether to start it at all; check() may raise to stop.

    Two runs a worker are on their way at a time, so that a budget or an interrupt leaves little behind.
    """
    client = connected(address)
    waiting, running = list(todo), {}
    try:
        while waiting or running:
            check()
            room = 2 * max(1, len(client.scheduler_info(n_workers=-1)["workers"])) - len(running)
            while waiting and room > 0:
                task = waiting.pop(0)
                if wanted(task):
                    running[client.submit(answer, arch, task.order, pure=False, retries=2)] = task
                    room -= 1
            yield from finished(running)
            time.sleep(LOOK)
    finally:
        client.cancel(list(running))
        client.close()


def finished(running: dict) -> Iterator[tuple]:
    """What has come in the meantime, taken out of what is running. Raises InputError where a worker cannot serve."""
    for future in [future for future in running if future.done()]:
        task = running.pop(future)
        if future.status == "finished":
            yield task, future.result()
        elif isinstance(error := future.exception(), InputError):
            raise error
        else:
            yield task, {"wrong": f"the cluster gave up: {error}"}


def connected(address: str):
    """A client of the cluster. Raises InputError where Dask is not installed or nobody answers."""
    try:
        from distributed import Client
    except ImportError as error:
        raise InputError("--cluster needs Dask: pip install 'taichi-spmhd[cluster]'") from error
    try:
        return Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise InputError(
            f"--cluster {address}: no Dask scheduler answers there; give one like tcp://host:8786"
        ) from error
