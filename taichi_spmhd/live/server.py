"""The server of the sandbox: plain HTTP, one thread a connection; it knows the desk and no simulation."""

import ipaddress
import os
import secrets
import socket
import sys
import threading
from http.server import ThreadingHTTPServer
from socketserver import TCPServer

from ..errors import InputError
from . import pages
from .answers import Answers
from .desk import Desk
from .wire import hang_up, turn_away

MOST_CONNECTIONS = 64


class Server(ThreadingHTTPServer):
    """Serves the desk at http://host:port/token/; `start` and `stop` it. port 0: a free one.

    Raises InputError where it cannot listen.
    """

    daemon_threads, block_on_close, request_queue_size = True, False, 64
    allow_reuse_address = os.name == "posix"  # the port of a run that just ended; elsewhere it would share a busy one

    def __init__(self, desk: Desk, host: str = "127.0.0.1", port: int = 0, token: str | None = None):
        self.desk, self.token, self.files = desk, token or secrets.token_urlsafe(16), pages.table()
        self.room, self.serving = threading.BoundedSemaphore(MOST_CONNECTIONS), None
        self.address_family = socket.AF_INET6 if ":" in host else socket.AF_INET
        try:
            super().__init__((host, port), Answers)
        except (OSError, OverflowError, UnicodeError) as error:
            cure = "take another --port, or leave it out" if port else "give an address of this machine with --host"
            why = getattr(error, "strerror", None) or error
            raise InputError(f"cannot listen on {host} port {port}: {why}; {cure}") from error

    def server_bind(self) -> None:
        """Without HTTPServer's question for our own name, which can take a name service many seconds."""
        TCPServer.server_bind(self)

    @property
    def address(self):
        """The address it listens on."""
        return ipaddress.ip_address(self.server_address[0])

    @property
    def url(self) -> str:
        """What to open: an address that other machines reach, too, where it listens on all."""
        host = reachable() if self.address.is_unspecified else str(self.address)
        return f"http://{f'[{host}]' if ':' in host else host}:{self.server_address[1]}/{self.token}/"

    def start(self) -> None:
        self.serving = threading.Thread(target=self.serve_forever, kwargs={"poll_interval": 0.2}, daemon=True)
        self.serving.start()

    def stop(self) -> None:
        """Whoever waits is let go."""
        self.desk.close()
        if self.serving:  # shutdown waits for the end of a loop, for ever where none began
            self.shutdown()
        self.server_close()

    def process_request(self, request, address) -> None:
        """A thread for a connection, as long as there is room."""
        if not self.room.acquire(blocking=False):
            turn_away(request)
            return
        try:
            super().process_request(request, address)
        except BaseException:  # no thread to be had
            self.room.release()
            raise

    def process_request_thread(self, request, address) -> None:
        try:
            super().process_request_thread(request, address)
        finally:
            self.room.release()

    def shutdown_request(self, request) -> None:
        hang_up(request)

    def handle_error(self, request, address) -> None:
        """A browser that left is no error of ours."""
        if not isinstance(sys.exc_info()[1], OSError):
            print("spmhd live: a request could not be answered", file=sys.stderr)


def reachable() -> str:
    """This machine's address as others see it; to be told the way to a far address, nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("203.0.113.1", 9))
            return probe.getsockname()[0]
        except OSError:
            return "127.0.0.1"
