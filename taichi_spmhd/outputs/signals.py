"""Stop: Ctrl-C or SIGTERM asks a run to finish its step and save; asked twice, it stops at once."""

import signal
import threading


class Interrupted(Exception):
    """The user asked the run to stop."""


class Stop:
    """`with Stop() as stop:` ... stop.check() between steps raises Interrupted once somebody has asked."""

    def __init__(self):
        self.asked, self.before = False, {}

    def __enter__(self) -> "Stop":
        if threading.current_thread() is threading.main_thread():  # Python takes signals nowhere else
            for number in (signal.SIGINT, signal.SIGTERM):
                self.before[number] = signal.signal(number, self.ask)
        return self

    def __exit__(self, *_) -> None:
        for number, before in self.before.items():
            signal.signal(number, before if before is not None else signal.SIG_DFL)

    def ask(self, number, frame) -> None:
        """Note the wish; the second time it is an order."""
        if self.asked:
            raise KeyboardInterrupt
        self.asked = True

    def check(self) -> None:
        """Raises Interrupted if somebody asked."""
        if self.asked:
            raise Interrupted
