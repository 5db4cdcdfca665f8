"""Vectors of three components inside kernels, each component a number per lane (lanes.py), and records of them."""

from types import SimpleNamespace

from .errors import InputError
from .runtime import ti

Field, SharedArray = ti.Field, ti.simt.block.SharedArray


def traced(function):
    """Marks a Python function that builds expressions while a kernel is compiled: Taichi does not warn of it."""
    function._is_taichi_function, function.func = True, SimpleNamespace(has_print=False)
    return function


def nothing(part) -> bool:
    """A component that is zero by construction, as e_z in two dimensions: it costs no instruction."""
    return isinstance(part, float) and part == 0.0


def times(a, b):
    return 0.0 if nothing(a) or nothing(b) else a * b


def plus(a, b):
    return b if nothing(a) else a if nothing(b) else a + b


def minus(a, b):
    return a if nothing(b) else -b if nothing(a) else a - b


class Vector3(Field, SharedArray):
    """Three components, each a number per lane; the arithmetic of a vector.

    Its bases only tell Taichi to leave the arithmetic (as for a Field) and v[0] (as for a SharedArray) to this class.
    """

    _data_oriented = True  # a local name for it is the thing itself

    def __init__(self, parts):
        self.parts = tuple(parts)

    def subscript(self, axis):
        return self.parts[axis]

    __getitem__ = subscript

    def __add__(self, other):
        return Vector3(plus(a, b) for a, b in zip(self.parts, other.parts, strict=True))

    def __sub__(self, other):
        return Vector3(minus(a, b) for a, b in zip(self.parts, other.parts, strict=True))

    def __mul__(self, number):
        return Vector3(times(a, number) for a in self.parts)

    __rmul__ = __mul__

    def __truediv__(self, number):
        return Vector3(0.0 if nothing(a) else a / number for a in self.parts)

    def __neg__(self):
        return Vector3(0.0 if nothing(a) else -a for a in self.parts)

    @property
    def x(self):
        return self.parts[0]

    @property
    def y(self):
        return self.parts[1]

    @property
    def z(self):
        return self.parts[2]

    @traced
    def dot(self, other):
        total = 0.0
        for a, b in zip(self.parts, other.parts, strict=True):
            total = plus(total, times(a, b))
        return total

    @traced
    def cross(self, other):
        (a, b, c), (u, v, w) = self.parts, other.parts
        return Vector3(minus(times(p, s), times(q, r)) for p, q, r, s in ((b, c, v, w), (c, a, w, u), (a, b, u, v)))

    @traced
    def norm_sqr(self):
        return self.dot(self)

    @traced
    def norm(self):
        return ti.sqrt(self.dot(self))


def named(vector: "Vector3") -> "Vector3":
    """The same vector in variables: worked out once, however often it is used."""
    return Vector3(part if nothing(part) else ti.lang.impl.expr_init(part) for part in vector.parts)


def struct_of(rows: dict):
    """A struct from {name: its number, or a list of the components of a vector}."""
    return ti.Struct(
        {name: ti.lang.matrix.make_matrix(row) if isinstance(row, list) else row for name, row in rows.items()}
    )


class Record:
    """A particle, or as many neighbours as there are lanes: members by name.

    load: {name: function that loads it}, called where the member is first used. A loop over pairs then holds few of
    them at a time: with all loads at its top the rates kernel runs out of registers and takes 15 % more.
    """

    _data_oriented = True

    def __init__(self, load: dict):
        self._load = load

    @traced
    def need(self, names) -> None:
        """Load these members now."""
        for name in names:
            getattr(self, name)

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._load:
            self.__dict__[name] = self._load[name]()
            return self.__dict__[name]
        raise InputError(f"a pair loop uses member {name}, which no listed part declares: add it to the term's `reads`")
