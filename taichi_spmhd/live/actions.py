"""What a wish may look like. Each is checked against what the page was told it may choose; one line says what is wrong.

checked({"do": "number", "panel": 0, "part": "DivBSource", "name": "xi", "value": 0.3}, setup)
"""

from ..errors import InputError
from ..picture import DRAW, suggestion
from .values import axis, limits, listed, number, one_of, panel, parameters, place, radius, shown, text, truth, whole

RECORDS = ("png", "film", "stop", "state", "scene")
REQUIRED = {
    "number": ("part", "name", "value"), "switch": ("part", "on"), "panels": ("count",), "speed": ("value",),
    "record": ("what",),
}  # fmt: skip


def checked(wish: dict, setup: dict) -> dict:
    """The wish, with its numbers as floats. Raises InputError for whatever does not belong there."""
    do = wish.get("do")
    if not isinstance(do, str) or do not in WISHES:
        raise InputError(f"do: {shown(do)} is not known; there are {', '.join(WISHES)}")
    if not setup:
        raise InputError("the run is not ready yet")
    known = WISHES[do]
    for key in wish:
        if key != "do" and key not in known:
            raise InputError(f"{do}: {shown(key)} is not known{suggestion(key, known)}")
    for key in REQUIRED.get(do, ()):
        if key not in wish:
            raise InputError(f"{do}: {key} is missing")
    made = {"do": do, **{key: known[key](key, wish[key], setup) for key in known if key in wish}}
    return COMPLETE.get(do, lambda wish, setup: wish)(made, setup)


def part_of(wish: dict, setup: dict) -> dict:
    """The part a wish speaks of, in its panel."""
    parts = {part["name"]: part for part in setup["panels"][wish.setdefault("panel", 0)]["parts"]}
    if wish["part"] not in parts:
        raise InputError(f"part: {shown(wish['part'])} is not among {', '.join(parts)}")
    return parts[wish["part"]]


def slider(wish: dict, setup: dict) -> dict:
    """The number is one of the part's, and within its range."""
    part = part_of(wish, setup)
    numbers = {one["name"]: one for one in part["numbers"]} if part["on"] else {}
    if wish["name"] not in numbers:
        raise InputError(f"name: {wish['part']} has no number {shown(wish['name'])} that slides")
    number(numbers[wish["name"]]["low"], numbers[wish["name"]]["high"])(wish["name"], wish["value"], setup)
    return wish


def switchable(wish: dict, setup: dict) -> dict:
    """Fixed parts stay on."""
    part = part_of(wish, setup)
    if part["fixed"] and not wish["on"]:
        raise InputError(f"{wish['part']} cannot be switched off: {part.get('why') or 'every run has one'}")
    return wish


def choice(wish: dict, setup: dict) -> dict:
    """Something is chosen; a variant is one of the panel's, unless the scene is another."""
    if not set(wish) & {"scene", "variant", "set", "kernel"}:
        raise InputError("choose: name a scene, a variant, parameters or a kernel")
    variants = setup["panels"][wish.setdefault("panel", 0)]["variants"]
    if "variant" in wish and not {"scene", "set"} & set(wish):
        one_of(*variants)("variant", wish["variant"], setup)
    return wish


def drawable(wish: dict, setup: dict) -> dict:
    """An axis that the member has."""
    sizes = {member["name"]: member["components"] for member in setup["members"]}
    name = wish.get("member", setup["draw"]["member"])
    size = sizes.get(name, 1)
    if wish.get("axis") is not None and (size == 1 or wish["axis"] >= size):
        raise InputError(f"axis: {name} has no component {wish['axis']}; give null")
    return wish


def pokable(wish: dict, setup: dict) -> dict:
    """Place, brush and what it does are all there."""
    needs = ("dx",) if wish.get("kind") == "push" else ("strength",)
    for key in ("kind", "x", "radius", *needs):
        if key not in wish:
            raise InputError(f"poke: {key} is missing")
    return {"panel": 0, **wish}


FAR = number(-1e6, 1e6)
WISHES = {
    "play": {}, "pause": {}, "step": {}, "reset": {},
    "speed": {"value": number(0, 1000)},
    "number": {"panel": panel, "part": text, "name": text, "value": number(-1e9, 1e9)},
    "switch": {"panel": panel, "part": text, "on": truth},
    "choose": {"panel": panel, "scene": listed(lambda setup: [scene["name"] for scene in setup["scenes"]]),
               "variant": text, "set": parameters, "kernel": listed(lambda setup: setup["kernels"])},
    "panels": {"count": whole(1, 2)},
    "draw": {"member": listed(lambda setup: [member["name"] for member in setup["members"]]), "axis": axis,
             "draw": one_of(*DRAW), "limits": limits, "log": truth, "lines": truth},
    "poke": {"panel": panel, "kind": listed(lambda setup: setup["pokes"]), "x": place(0), "y": place(1), "dx": FAR,
             "dy": FAR, "radius": radius, "strength": number(-1, 3)},
    "record": {"what": one_of(*RECORDS)},
}  # fmt: skip
COMPLETE = {"number": slider, "switch": switchable, "choose": choice, "draw": drawable, "poke": pokable}
