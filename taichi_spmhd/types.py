"""Names of types, read before the precision is known; `resolve` turns them into Taichi types when fields are built."""

from .runtime import ti

real = float  # Taichi takes the default precision for Python's float
integer = int


class _Name:
    """A type that has a meaning only once precision and dimension are known."""

    def __init__(self, name: str):
        self.name = name

    def __repr__(self) -> str:
        return self.name


vec3 = _Name("vec3")  # v, B, ...: always three components
vecd = _Name("vecd")  # positions: as many components as the scene has dimensions
mat3 = _Name("mat3")  # gradients of vectors
slopes = {axis: _Name(f"slope of {axis}") for axis in "xyz"}  # the gradient of one component of a vector, as vecd


def resolve(name, dim: int):
    """The Taichi type behind a name, in the precision that runs."""
    fixed = {vec3: lambda: ti.types.vector(3, float), mat3: lambda: ti.types.matrix(3, 3, float)}
    if name is vecd or name in slopes.values():
        return ti.types.vector(dim, float)
    if name in fixed:
        return fixed[name]()
    return {real: ti.lang.impl.get_runtime().default_fp, integer: ti.i32}[name]


def components(name, dim: int) -> int:
    """How many numbers a member of this type holds."""
    return {real: 1, integer: 1, vec3: 3, mat3: 9, vecd: dim, **dict.fromkeys(slopes.values(), dim)}[name]


def struct(members: dict, dim: int):
    """A Taichi struct type from {name: type name}."""
    return ti.types.struct(**{name: resolve(kind, dim) for name, kind in members.items()})
