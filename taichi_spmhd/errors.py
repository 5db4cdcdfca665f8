"""What can go wrong, by whose doing: the user's input (exit code 2) or the run itself (exit code 3)."""


class InputError(ValueError):
    """The user's input is wrong; the message is one line that names the cure."""


class RunError(RuntimeError):
    """The run went wrong (NaN, negative energy, time step collapse); particle, term and time are named."""
