"""The wire to a browser: a request has one deadline however slowly it trickles in, and a good-bye is heard."""

import io
import socket
import time
from contextlib import suppress

GOODBYE = 1.0  # seconds in which what a refused sender still sends is read, so that it reads the answer
FULL = b"HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"


class Incoming(io.RawIOBase):
    """The bytes that arrive, until the deadline set by `allow`; then reading raises TimeoutError.

    A timeout of the socket alone begins anew with every byte: one byte in fourteen seconds would hold a place for days.
    """

    def __init__(self, line: socket.socket):
        self.line, self.end = line, 0.0

    def allow(self, seconds: float) -> None:
        """The deadline of what comes next."""
        self.end = time.monotonic() + seconds

    def readable(self) -> bool:
        return True

    def readinto(self, room) -> int:
        left = self.end - time.monotonic()
        if left <= 0:
            raise TimeoutError("the request took too long to arrive")
        self.line.settimeout(left)
        return self.line.recv_into(room)


def gone(line: socket.socket) -> bool:
    """Whether the other side has hung up, as a page does that is closed or wants another size."""
    try:
        line.setblocking(False)
        return not line.recv(1, socket.MSG_PEEK)
    except BlockingIOError:
        return False
    except OSError:
        return True


def hang_up(line: socket.socket) -> None:
    """End our half, then read what still comes, briefly: closing on unread bytes would take the last answer back."""
    with suppress(OSError):
        line.shutdown(socket.SHUT_WR)
        end = time.monotonic() + GOODBYE
        while (left := end - time.monotonic()) > 0:
            line.settimeout(left)
            if not line.recv(65536):
                break
    line.close()


def turn_away(line: socket.socket) -> None:
    """No room: said at once, for nobody else is let in meanwhile."""
    with suppress(OSError):
        line.setblocking(False)
        line.sendall(FULL)
        line.shutdown(socket.SHUT_WR)
        line.recv(65536)
    line.close()
