"""What cost.json must be before its runs count: every number that is read of it is one."""

from ..outputs.files import number

MACHINE = ("hardware", "version", "date")
POSITIVE = ("seconds", "calibration", "particles", "steps")
NUMBERS = ("cores", "seconds_compile", "energy_drift", "energy_drift_predicted", "momentum_drift",
           "momentum_drift_predicted")  # fmt: skip
PERHAPS = ("close_pairs", "floors", "load", "t", "bytes_per_particle")  # or null, or not there


def sound(study) -> bool:
    """Whether a study of ours can have written this."""
    return isinstance(study["runs"], list) and all(map(run, study["runs"])) and machine(study.get("machine"))


def machine(made) -> bool:
    """Where and when it was measured."""
    return (
        isinstance(made, dict)
        and all(isinstance(made.get(name), str) for name in MACHINE)
        and isinstance(made.get("commit"), str | None)
    )


def run(made) -> bool:
    """One run: of which setting and round, and its figures, or what went wrong."""
    if not isinstance(made, dict) or not isinstance(made.get("key"), str) or not counts(made.get("round")):
        return False
    if made.get("wrong"):
        return isinstance(made["wrong"], str)
    return (
        all(number(made.get(name)) and made[name] > 0 for name in POSITIVE)
        and all(number(made.get(name)) for name in NUMBERS)
        and all(number_or_none(made.get(name)) for name in PERHAPS)
        and isinstance(made.get("digest"), str)
        and isinstance(made.get("arch", ""), str)
        and figures(made.get("errors"))
        and (made.get("div_B") is None or (figures(made["div_B"]) and number(made["div_B"].get("mean"))))
    )


def counts(value) -> bool:
    """0, 1, 2, ..."""
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def number_or_none(value) -> bool:
    """A number, or nothing."""
    return value is None or number(value)


def figures(value) -> bool:
    """{name: number or nothing}"""
    return isinstance(value, dict) and all(map(number_or_none, value.values()))
