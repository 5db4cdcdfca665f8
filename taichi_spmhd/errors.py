"""The two kinds of error a user sees."""


class InputError(ValueError):
    """The user's input is wrong; the message is one line that names the cure."""


class RunError(RuntimeError):
    """The run went wrong. The message is one line; what is known stands in the attributes, None where it is not.

    cause: one of cures.CAUSES; particle: its index in the order given; position: (d,); member: what went wrong in it;
    term: the one with the largest share in its rates, or that limits its step; time: when the step that failed began,
    step: its number, from 1; cure: what to try.
    """

    def __init__(self, what: str, cause: str | None = None, cure: str | None = None, **known):
        super().__init__(f"{what}; {cure}" if cure else what)
        self.what, self.cause, self.cure = what, cause, cure
        self.particle = self.position = self.member = self.term = self.time = self.step = None
        for name, value in known.items():
            setattr(self, name, value)
