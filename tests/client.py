"""A browser without a picture: what the tests say to a live run over HTTP."""

import json
import subprocess
import sys
import time
from contextlib import contextmanager
from http.client import HTTPConnection
from urllib.parse import urlsplit


class Client:
    """Speaks to the page's server at `url` (which ends in /token/)."""

    def __init__(self, url: str):
        split = urlsplit(url)
        self.url, self.port, self.token = url, split.port, split.path.strip("/")

    def request(self, method: str, what: str, body: bytes | None = None, headers: dict | None = None):
        """(status, headers, body) of one request."""
        connection = HTTPConnection("127.0.0.1", self.port, timeout=20)
        try:
            connection.request(method, f"/{self.token}/{what}", body, headers or {})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def get(self, what: str):
        """The JSON of a GET that must succeed."""
        status, _, body = self.request("GET", what)
        assert status == 200, (what, status, body)
        return json.loads(body)

    def post(self, **wish) -> tuple[int, dict]:
        """(status, answer) of a wish."""
        content = json.dumps(wish).encode()
        status, _, body = self.request("POST", "do", content, {"Content-Type": "application/json"})
        return status, json.loads(body)

    def do(self, **wish) -> dict:
        """A wish that must be granted; returns the state once it has been."""
        status, answer = self.post(**wish)
        assert status == 200, (wish, answer)
        state = self.until(lambda state: state["applied"] >= answer["id"])
        assert not (state["message"] and state["message"]["kind"] == "error"), (wish, state["message"])
        return state

    def state(self, row: int = 10**9) -> dict:
        return self.get(f"state?after=-1&row={row}")

    def until(self, true, seconds: float = 60.0) -> dict:
        """The first state for which true(state)."""
        end, seq = time.monotonic() + seconds, -1
        while time.monotonic() < end:
            state = self.get(f"state?after={seq}&row={10**9}")
            if state.get("panels") and true(state):
                return state
            seq = state.get("seq", -1)
        raise AssertionError(f"not within {seconds} s; the last state is {state}")

    def frame(self, panel: int = 0, after: int = -1, size: tuple[int, int] = (320, 320)) -> tuple[int, bytes]:
        """(number, JPEG) of a frame."""
        what = f"frame?panel={panel}&after={after}&width={size[0]}&height={size[1]}"
        status, headers, body = self.request("GET", what)
        assert status == 200 and int(headers["Content-Length"]) == len(body), (status, body[:100])
        return int(headers["X-Frame"]), body


@contextmanager
def running(*words: str, seconds: float = 90.0):
    """A `spmhd live` in a process of its own: (client, process)."""
    command = [sys.executable, "-m", "taichi_spmhd", "live", *words, "--no-browser", "--threads", "2"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        line = process.stdout.readline()
        assert line.startswith("spmhd live: http://127.0.0.1:"), (line, process.stderr.read() if not line else "")
        yield Client(line.split()[2]), process
    finally:
        process.terminate()
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
