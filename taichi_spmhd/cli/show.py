"""`spmhd show SCENE`: what a run would do and cost, before running it."""

from .asked import add_scene, assignments, start

ABSENT = ("B", "b", "psi", "u")  # members worth a word where they are not there


def add(commands, common) -> None:
    """Register the command."""
    parser = commands.add_parser("show", parents=[common], help="terms, choices, members, cost and warnings of a scene")
    add_scene(parser)
    parser.add_argument("--variant", nargs="+", action="extend", metavar="LABEL", help="only these variants")
    parser.set_defaults(command=main)


def main(args) -> int:
    """Each variant is built and evaluated once, not run."""
    from ..library import docstring, find, load_scene, parameters_of
    from ..outputs.plan import chosen
    from ..outputs.words import say

    path, given = find(args.scene), assignments(args.set)
    variants = chosen(load_scene(path, **given), args.variant)
    start(args)
    say(docstring(path))
    values = parameters_of(path, **given).items()
    say()
    say("  ".join(["parameters:", *(f"{name}={value}" for name, value in values)]) if values else "no parameters")
    for label, scene in variants.items():
        describe(label, scene, path)
    return 0


def describe(label: str, scene, path) -> None:
    """Parts, members, cost and warnings of one variant."""
    from ..outputs.words import say, table
    from ..scene_code import code_of
    from ..simulation import Simulation
    from .advice import warnings

    table(("", ""), equations(scene), title=f"\n{label}")
    with code_of(path):
        sim = Simulation(scene)
        sim.begin()
    with sim:
        table(("", ""), cost(sim))
        for warning in warnings(sim):
            say(f"  warning: {warning}")


def equations(scene) -> list[tuple[str, str]]:
    """(a part as a scene file writes it, its equation): terms, then choices."""
    energy = [scene.energy] if scene.energy in scene.listed else []  # an isothermal gas has none
    choices = [scene.eos, *energy, scene.density, scene.kernel, scene.stepper]
    rows = [("term " + str(term), first_line(term.among(scene.listed))) for term in scene.terms]
    rows += [(named(choice), first_line(choice)) for choice in choices]
    return [*rows, ("Boundary", edges(scene))]


def named(part) -> str:
    """A choice with the numbers that are not the default."""
    if hasattr(part, "h_fact"):
        return f"{type(part).__name__}(h_fact={part.h_fact:g})"
    return str(part)


def first_line(part) -> str:
    """The first line of the docstring."""
    return (type(part).__doc__ or type(part).__name__).strip().splitlines()[0]


def edges(scene) -> str:
    """The sides of every axis in words."""
    words = []
    for axis, (low, high) in zip("xyz"[: scene.dim], scene.boundary.sides, strict=False):
        kinds = [type(side).__name__.lower() for side in (low, high)]
        words.append(f"{axis} {kinds[0] if kinds[0] == kinds[1] else ' and '.join(kinds)}")
    return ", ".join(words)


def cost(sim) -> list[tuple[str, str]]:
    """Members and what the run takes: an estimate from the first evaluation, whose dt may shrink."""
    from ..outputs.words import duration, size

    members, evolved = list(sim.particles.members), list(sim.particles.names)
    absent = [name for name in ABSENT if name not in members]
    state, near = sim.particles.bytes_each, sim.neighbours.bytes_each
    steps = max(1, round(sim.scene.t_end / sim.longest))
    seconds = steps * evaluations(sim.scene.stepper) * once(sim)
    return [
        ("particles", f"{len(sim)} in {sim.dim}-D"),
        ("members", ", ".join(members)),
        ("evolved", ", ".join(evolved)),
        ("not allocated", ", ".join(absent) or "nothing to save: B, b, psi and u are all used"),
        ("bytes a particle", f"{state + near}: members {state}, neighbour list {near}"),
        ("memory", size(len(sim) * (state + near))),
        ("steps", f"about {steps} to t = {sim.scene.t_end:g} (first step {sim.longest:.3g})"),
        ("time", f"about {duration(seconds)} stepping after {duration(sim.seconds_compile)} compiling"),
    ]


def evaluations(stepper) -> int:
    """Evaluations of the rates in a step."""
    return len(getattr(stepper, "stages", ())) or 1


def once(sim) -> float:
    """Seconds of one evaluation, the shortest of three; a run adds a list build now and then."""
    import time

    spent = []
    for _ in range(3):
        clock = time.perf_counter()
        sim.rhs.evaluate(sim.time, 0.0)
        spent.append(time.perf_counter() - clock)
    return 1.3 * min(spent)
