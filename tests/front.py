"""A server in front of a desk at which nobody simulates, and what its setup offers."""

from contextlib import contextmanager

from client import Client
from hostile import raw

from taichi_spmhd.live.desk import Desk
from taichi_spmhd.live.server import Server

XI = {"name": "xi", "value": 1.0, "low": 0.0, "high": 1.0, "start": 1.0}
SETUP = {
    "version": 1,
    "scenes": [{"name": "alfven_tensile", "sight": ""}],
    "kernels": ["CubicSpline"],
    "box": {"lo": [0.0, 0.0], "hi": [1.0, 2.0], "dim": 2, "profile": False},
    "members": [{"name": "rho", "components": 1}, {"name": "B", "components": 3}],
    "draw": {"member": "B", "axis": 2},
    "pokes": ["push", "pressure"],
    "panels": [
        {
            "variants": ["xi = 0", "xi = 1"],
            "parts": [
                {"name": "Stress", "on": True, "fixed": True, "why": "nothing moves this gas", "numbers": []},
                {"name": "DivBSource", "on": True, "fixed": False, "numbers": [XI]},
            ],
        }
    ],
}


def desk() -> Desk:
    """With a setup and a first state."""
    made = Desk()
    made.publish_setup(SETUP)
    made.publish_state({"applied": 0, "panels": [{"t": 0.0}]})
    return made


@contextmanager
def served(desk: Desk, **where):
    """A client of its server."""
    server = Server(desk, **where)
    server.start()
    try:
        yield Client(server.url)
    finally:
        server.stop()


def doubled(token: str) -> bytes:
    """A request with one slash too many, which the library forgives."""
    return raw("GET", f"//{token}/setup")
