"""The price list in words: tables, sentences, prices.md."""

from ... import terms as package
from ...outputs.comparison import row as line
from .steps import TURNS
from .sums import CLEAR

NOTE = (
    "ms: of a step. Every scene is timed in turn with the whole, {turns} times {steps} steps, and the quickest turn of "
    "each counts: the median ratio of {rounds} rounds, times the quickest step of the whole; +- is half the distance "
    "of the quartiles. A term's price is what a step of the same scene without it saves; bytes are those of its "
    "members and sums, a particle. The list one after the other adds the terms in the scene's order. Compiling is not "
    "in it."
)


def tables(found: dict[str, dict]) -> list[tuple[list[str], list[list[str]]]]:
    """Headers and rows: terms, sets, choices, phases; found: {precision: prices}."""
    out = []
    for precision, made in found.items():
        if "wrong" in made:
            continue
        head = [f"term, {precision}", "ms a step", "+-", "share", "bytes", "members of its own", "instructions"]
        out.append((head, [term_cells(one) for one in made["terms"]]))
        head = [f"one after the other, {precision}", "ms a step", "more", "rates", "vectorised"]
        out.append((head, [set_cells(one) for one in made["upto"]]))
        head = [f"instead, {precision}", "ms a step", "share", "bytes", "listed neighbours"]
        out.append((head, [choice_cells(one) for one in made["choices"]]))
    good = {precision: made for precision, made in found.items() if "wrong" not in made}
    phases = next(iter(good.values()))["phases"] if good else {}
    head = ["phase, ms (share)", *good]
    out.append((head, [[phase, *(phase_cell(made, phase) for made in good.values())] for phase in phases]))
    return [table for table in out if table[1]]


def term_cells(one: dict) -> list[str]:
    """A term; one that cannot be taken away says why."""
    if one["ms"] is None:
        return [one["name"], "", "", "", "", f"cannot go alone: {one['reason'].split(':')[0]}", ""]
    clear = abs(one["share"]) >= CLEAR and abs(one["ms"]) > one["spread_ms"]
    price = f"{one['ms']:+.2f}" if clear else f"0 within the spread ({one['ms']:+.2f})"
    code = "" if one["instructions"] is None else f"{one['instructions']:+d}"
    share = f"{100 * one['share']:+.0f} %"
    return [one["name"], price, f"{one['spread_ms']:.2f}", share, f"{one['bytes']:+d}", " ".join(one["members"]), code]


def set_cells(one: dict) -> list[str]:
    """A set of terms: the one named and all before it."""
    mark = {None: "", True: "yes", False: "NO"}[one["vectorised"]]
    share = "" if one["vector_share"] is None else f" ({100 * one['vector_share']:.0f} % of the arithmetic)"
    return [one["name"], f"{one['ms']:.2f}", f"{one['more_ms']:+.2f}", f"{one['rates_ms']:.2f}", mark + share]


def choice_cells(one: dict) -> list[str]:
    """Another kernel or stepper."""
    size = f"{one['bytes']:+d}"
    return [one["name"], f"{one['ms']:+.2f}", f"{100 * one['share']:+.0f} %", size, f"{one['listed']:.0f}"]


def phase_cell(made: dict, phase: str) -> str:
    """ms and share of a phase."""
    spent = made["phases"][phase]
    return f"{spent:.2f} ({100 * spent / made['whole']['ms']:.0f} %)"


def sentences(found: dict[str, dict]) -> list[str]:
    """What the tables say together."""
    out = []
    for precision, made in found.items():
        if "wrong" in made:
            out.append(f"{precision}: {made['wrong']}.")
            continue
        whole = made["whole"]
        size = f"{whole['bytes_state']} bytes of members and {whole['bytes_list']} of list a particle"
        out.append(f"{precision}: a step takes {whole['ms']:.2f} ms for {whole['particles']} particles, {size}; "
                   f"{made['passes']:.1f} passes of the density sum, {whole['pass_ms']:.2f} ms each.")  # fmt: skip
        out += summed(precision, made)
    return [*out, *halves(found), unlisted(found)]


def summed(precision: str, made: dict) -> list[str]:
    """How far single prices add up, and which sets are not vectorised."""
    out = []
    if made["explained"] is not None:
        first = made["upto"][0]["name"]
        out.append(f"{precision}: the set up to {first} and the single prices of the others explain "
                   f"{100 * made['explained']:.0f} % of the whole.")  # fmt: skip
    scalar = [one["name"] for one in made["upto"] if one["vectorised"] is False]
    if scalar:
        out.append(f"{precision}: the loop is not vectorised with the terms up to {', up to '.join(scalar)}.")
    elif made["upto"] and made["upto"][0]["vectorised"]:
        out.append(f"{precision}: the loop is vectorised with every set of terms.")
    return out


def halves(found: dict[str, dict]) -> list[str]:
    """f32 beside f64."""
    good = {precision: made["whole"] for precision, made in found.items() if "wrong" not in made}
    if not {"f32", "f64"} <= set(good):
        return []
    one, other = good["f64"], good["f32"]
    size = [whole["bytes_state"] + whole["bytes_list"] for whole in (one, other)]
    more, share = other["ms"] - one["ms"], 100 * (other["ms"] / one["ms"] - 1)
    return [f"f32 instead of f64: {more:+.2f} ms a step ({share:+.0f} %), {size[1] - size[0]:+d} bytes a particle."]


def unlisted(found: dict[str, dict]) -> str:
    """That what is not listed is not there: members that terms of the package have and this scene does not."""
    made = next((made for made in found.values() if "wrong" not in made), None)
    if made is None:
        return ""
    absent = " ".join(sorted(known() - set(made["whole"]["members"]))) or "none"
    return (
        f"What is not listed costs nothing: of all members that terms of the package have, {absent} are not there, "
        "and the loop has no instruction of a term that is not in it (instructions: what each listed one adds; a test "
        "compares the loop with that of a package from which a term's file was deleted)."
    )


def known() -> set[str]:
    """Every member that some term of the package evolves, makes or keeps."""
    kinds = [getattr(package, name) for name in package.__all__]
    return {
        name for kind in kinds for where in ("evolves", "makes", "keeps") for name in getattr(kind, where, None) or ()
    }


def text(name: str, where: str, found: dict[str, dict], said: list[str], rounds: int, steps: int, foot: str) -> str:
    """prices.md."""
    out = [f"# {name}: the price list", "", where, "", *(f"- {sentence}" for sentence in said)]
    for head, cells in tables(found):
        out += ["", line(head), line("---" for _ in head), *map(line, cells)]
    return "\n".join([*out, "", NOTE.format(turns=TURNS, rounds=rounds, steps=steps), "", f"{foot}.", ""])
