"""The server of the sandbox: plain HTTP, one thread a connection; it knows the desk and no simulation."""

import json
import secrets
import sys
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from ..errors import InputError
from . import doors, pages
from .actions import checked
from .desk import Desk, Full
from .doors import Refused

PATIENCE, ANSWER = 10.0, 2.0  # seconds a long poll waits, and a question
MOST_CONNECTIONS, SLOWEST = 64, 5  # seconds that a request may pause on its way
HEADERS = {
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
}


class Server(ThreadingHTTPServer):
    """Serves the desk at http://host:port/token/; `start` and `stop` it. port 0: a free one."""

    daemon_threads, block_on_close, request_queue_size, allow_reuse_address = True, False, 64, False

    def __init__(self, desk: Desk, host: str = "127.0.0.1", port: int = 0, token: str | None = None):
        self.desk, self.token, self.files = desk, token or secrets.token_urlsafe(16), pages.table()
        self.room = threading.BoundedSemaphore(MOST_CONNECTIONS)
        try:
            super().__init__((host, port), Handler)
        except (OSError, OverflowError) as error:
            cure = "take another --port, or leave it out" if port else "give an address of this machine with --host"
            raise InputError(f"cannot listen on {host}:{port}: {getattr(error, 'strerror', error)}; {cure}") from error

    @property
    def url(self) -> str:
        return f"http://{self.server_address[0]}:{self.server_address[1]}/{self.token}/"

    def start(self) -> None:
        threading.Thread(target=self.serve_forever, kwargs={"poll_interval": 0.2}, daemon=True).start()

    def stop(self) -> None:
        """Whoever waits is let go."""
        self.desk.close()
        self.shutdown()
        self.server_close()

    def process_request(self, request, address) -> None:
        """A thread for a connection, as long as there is room."""
        if not self.room.acquire(blocking=False):
            request.sendall(b"HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")
            self.shutdown_request(request)
            return
        super().process_request(request, address)

    def process_request_thread(self, request, address) -> None:
        try:
            super().process_request_thread(request, address)
        finally:
            self.room.release()

    def handle_error(self, request, address) -> None:
        """A browser that left is no error of ours."""
        if not isinstance(sys.exc_info()[1], OSError):
            print("spmhd live: a request could not be answered", file=sys.stderr)


class Handler(BaseHTTPRequestHandler):
    """One request after the other of one connection."""

    protocol_version, timeout, server_version, sys_version = "HTTP/1.1", SLOWEST, "spmhd", ""

    def do_GET(self) -> None:
        self.answer(self.get)

    def do_POST(self) -> None:
        self.answer(self.post)

    def answer(self, method) -> None:
        """What the method sends, or why not."""
        try:
            method(*doors.admit(self.headers, self.path, self.server.token, self.command))
        except Refused as refused:
            self.refuse(refused.code, refused.why)
        except Full:
            self.refuse(503, "more wishes than the run can grant; wait a moment")

    def get(self, what: str, query: dict) -> None:
        self.only_empty()
        if what in READS:
            READS[what](self, **query)
        elif what == "do":
            self.refuse(405, "POST it", Allow="POST")
        elif what in self.server.files:
            kind, content = self.server.files[what]
            self.send(200, kind, content)
        else:
            raise Refused(404, "there is no such thing")

    def only_empty(self) -> None:
        """A body that belongs to no GET would be read as the next request."""
        if doors.single(self.headers, "Content-Length") not in (None, "0") or "Transfer-Encoding" in self.headers:
            raise Refused(400, "a GET has no body")

    def post(self, what: str, query: dict) -> None:
        """A wish."""
        if what != "do":
            self.refuse(405 if what in READS or what in self.server.files else 404, "only do takes a POST", Allow="GET")
            return
        raw = self.rfile.read(doors.length(self.headers))
        try:
            wish = checked(doors.body(raw), self.server.desk.setup)
        except InputError as error:
            raise Refused(400, str(error)) from None
        self.send_json(200, {"ok": True, "id": self.server.desk.put(wish)})

    def read_setup(self) -> None:
        self.send_json(200, self.server.desk.setup)

    def read_state(self, after: int, row: int) -> None:
        self.send_json(200, self.server.desk.state_after(after, row, PATIENCE))

    def read_frame(self, panel: int, after: int, width: int, height: int) -> None:
        frame = self.server.desk.frame_after(panel, (width, height), after, PATIENCE)
        if frame is None:
            raise Refused(503, "no frame yet")
        self.send(200, "image/jpeg", frame.jpeg(), {"X-Frame": str(frame.number)})

    def read_particle(self, **question) -> None:
        found = self.server.desk.ask(question, ANSWER)
        if found is None:
            raise Refused(503, "no answer in time")
        self.send_json(200, found)

    def refuse(self, code: int, why: str, **headers) -> None:
        """One line, and an end: what else was sent is not read."""
        self.close_connection, self.request_version = True, "HTTP/1.1"  # the library answers some without a status line
        self.send(code, "application/json", json.dumps({"error": why}).encode(), {**headers, "Connection": "close"})

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """What the library refuses: unreadable request lines and headers, other methods."""
        if code == 501 and self.command:
            self.refuse(405, "GET and POST only", Allow="GET, POST")
        else:
            self.refuse(code, "this is no request that can be read")

    def send_json(self, code: int, value) -> None:
        self.send(code, "application/json", json.dumps(value, allow_nan=False).encode())

    def send(self, code: int, kind: str, content: bytes, more: dict | None = None) -> None:
        self.send_response(code)
        for name, value in {**HEADERS, "Content-Type": kind, **(more or {})}.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(content)

    def log_message(self, *_) -> None:
        """Silent."""


READS = {
    "setup": Handler.read_setup,
    "state": Handler.read_state,
    "frame": Handler.read_frame,
    "particle": Handler.read_particle,
}
