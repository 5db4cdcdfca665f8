"""What the server answers: one request after the other of one connection, each checked at the doors first."""

import io
import json
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler

from ..errors import InputError
from . import doors
from .actions import checked
from .doors import Refused
from .wire import Incoming, gone
from .wishes import Full

PATIENCE, ANSWER = 10.0, 2.0  # seconds a long poll waits, and a question
SLOWEST, LEAVING = 5.0, 15.0  # seconds a request may take to arrive, and an answer to leave
HEADERS = {
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
}


class Answers(BaseHTTPRequestHandler):
    """`self.server` has the desk, the token and the files."""

    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True  # else every second packet of an answer waits 40 ms for the other side's receipt

    def setup(self) -> None:
        super().setup()
        self.rfile.close()
        self.incoming = Incoming(self.connection)
        self.rfile = io.BufferedReader(self.incoming)

    def handle_one_request(self) -> None:
        self.incoming.allow(SLOWEST)
        super().handle_one_request()

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
        self.send_json(200, self.server.desk.state_after(after, row, PATIENCE, self.gone))

    def read_frame(self, panel: int, after: int, width: int, height: int) -> None:
        self.there(panel)
        frame = self.server.desk.frame_after(panel, (width, height), after, PATIENCE, self.gone)
        if frame is None:
            raise Refused(503, "no frame yet")
        self.send(200, "image/jpeg", frame.jpeg(), {"X-Frame": str(frame.number)})

    def read_particle(self, panel: int, **place) -> None:
        self.there(panel)
        found = self.server.desk.ask({"panel": panel, **place}, ANSWER)
        if found is None:
            raise Refused(503, "no answer in time")
        self.send_json(200, found)

    def gone(self) -> bool:
        """A page that is closed leaves its place to others."""
        return gone(self.connection)

    def there(self, panel: int) -> None:
        """Nobody waits for a panel that does not exist."""
        if panel >= len(self.server.desk.setup.get("panels", [])):
            raise Refused(404, f"there is no panel {panel}")

    def refuse(self, code: int, why: str, **headers) -> None:
        """One line, and an end: what else was sent is not read."""
        self.close_connection = True
        self.send(code, "application/json", json.dumps({"error": why}).encode(), {**headers, "Connection": "close"})

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """What the library refuses: unreadable request lines and headers, other methods."""
        if code == 501 and self.command:
            self.refuse(405, "GET and POST only", Allow="GET, POST")
        else:
            self.refuse(code, "this is no request that can be read")

    def handle_expect_100(self) -> bool:
        """Bodies are small: there is nothing to ask before."""
        self.refuse(417, "send the body at once")
        return False

    def send_json(self, code: int, value) -> None:
        self.send(code, "application/json", json.dumps(value, allow_nan=False).encode())

    def send(self, code: int, kind: str, content: bytes, more: dict | None = None) -> None:
        """Head and content in one piece."""
        headers = {"Content-Type": kind, "Content-Length": len(content), **HEADERS, **(more or {})}
        lines = [f"HTTP/1.1 {code} {HTTPStatus(code).phrase}", *(f"{key}: {text}" for key, text in headers.items())]
        head = ("\r\n".join(lines) + "\r\n\r\n").encode("latin-1")
        self.connection.settimeout(LEAVING)
        self.wfile.write(head if self.command == "HEAD" else head + content)

    def log_message(self, *_) -> None:
        """Silent."""


READS = {
    "setup": Answers.read_setup,
    "state": Answers.read_state,
    "frame": Answers.read_frame,
    "particle": Answers.read_particle,
}
