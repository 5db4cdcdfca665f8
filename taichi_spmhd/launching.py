"""Starts kernels at once: what Taichi 1.7 asks again at every call of a kernel is asked at the first one only.

A call of a class's kernel in Taichi looks up the method, hashes every argument, sets all of them and finds the compiled
code: 0.1 ms, which for a few hundred particles is more than the work, with a dozen kernels a step. Here a kernel keeps,
for each object it belongs to, the launch that worked; while fields and arrays are the same objects, only numbers and
numpy arrays are set again. On the CPU only: elsewhere, and for everything unusual, the call goes Taichi's own way.
"""

import weakref
from types import MethodType

import numpy as np

from .lanewise import spell
from .wide import whole

MOST = 8  # launches of one kernel of one object, for as many sets of arrays
NUMBERS = {float: (float, int, np.floating, np.integer), int: (int, np.integer)}
NEEDED = ("ensure_compiled", "construct_kernel_ret", "launch_kernel")  # of Taichi's kernels, or nothing is changed


def quicken(taichi) -> None:
    """Let the kernels of classes marked with taichi.data_oriented start at once."""
    from taichi.lang import kernel_impl

    plain = taichi.data_oriented
    if all(hasattr(kernel_impl.Kernel, name) for name in NEEDED):
        taichi.data_oriented = lambda kind: data_oriented(kind, plain)
        spell(taichi)


def data_oriented(kind: type, plain) -> type:
    """What ti.data_oriented does, without its detour for every attribute that is read. plain: Taichi's own."""
    own = dict(vars(kind))
    if any(isinstance(made, staticmethod) and hasattr(made, "_is_wrapped_kernel") for made in own.values()):
        return plain(kind)
    for name, made in own.items():
        if getattr(made, "_is_classkernel", False):
            setattr(kind, name, Method(made))
    kind._data_oriented = True
    return kind


class Method:
    """A kernel of a class: object.kernel(...) runs it."""

    def __init__(self, wrapped):
        self.kernel, self.__doc__, self.__name__ = wrapped._primal, wrapped.__doc__, wrapped.__name__
        self.launches: weakref.WeakKeyDictionary = weakref.WeakKeyDictionary()  # {object: those of its last calls}

    def __get__(self, owner, kind=None):
        return self if owner is None else MethodType(self, owner)

    def __call__(self, owner, *given):
        before = self.launches.get(owner, [])
        for launch in before:
            if launch.fits(given):
                return launch(given)
        with whole(self.kernel):
            out = self.kernel(owner, *given)
            launch = prepared(self.kernel, owner, given)
        if launch:
            self.launches[owner] = [launch, *(other for other in before if other.alive())][:MOST]
        return out


def prepared(kernel, owner, given: tuple) -> "Launch | None":
    """A launch that repeats the call just made; None where that is not possible."""
    from taichi.lang import impl
    from taichi.lang.kernel_impl import _ti_core

    if impl.current_cfg().arch not in (_ti_core.Arch.x64, _ti_core.Arch.arm64):
        return None
    kinds = [kind_of(one.annotation, value) for one, value in zip(kernel.arguments[1:], given, strict=True)]
    return None if None in kinds else Launch(kernel, owner, given, kinds, impl.get_runtime().prog)


def kind_of(annotation, value) -> str | None:
    """How an argument is set: compiled in, as an array that stays, as a number or numpy array; None: unknown here."""
    from taichi.lang._ndarray import Ndarray
    from taichi.types import annotations, ndarray_type, primitive_types

    if isinstance(annotation, annotations.Template):
        return "compiled in"
    if isinstance(annotation, ndarray_type.NdarrayType):
        if isinstance(value, Ndarray):
            return "array" if value.grad is None else None
        matrices = annotation.dtype is not None and id(annotation.dtype) not in primitive_types.type_ids
        return "numpy" if plain(value) and not matrices else None
    if id(annotation) in primitive_types.real_type_ids:
        return "real"
    return "whole" if annotation is int or annotation in (primitive_types.i32, primitive_types.i64) else None


def plain(value) -> bool:
    """Whether a value is a numpy array whose memory a kernel can work on as it is."""
    return isinstance(value, np.ndarray) and value.flags.c_contiguous


class Launch:
    """One kernel of one object with its arguments in place."""

    def __init__(self, kernel, owner, given: tuple, kinds: list[str], prog):
        self.kernel, self.prog, self.count = kernel, prog, len(given)
        made = kernel.compiled_kernels[kernel.ensure_compiled(owner, *given)]
        self.context = made.make_launch_context()
        self.code = prog.compile_kernel(prog.config(), prog.get_device_caps(), made)
        self.same, self.numbers, self.numpy, self.arrays = [], [], [], []
        place = 0
        for k, (kind, value) in enumerate(zip(kinds, given, strict=True)):
            self.note(k, kind, value, (place,))
            place += kind != "compiled in"

    def note(self, k: int, kind: str, value, place: tuple[int]) -> None:
        """How argument k is checked and set at the next calls."""
        if kind in ("array", "compiled in"):
            self.same.append((k, held(value)))
        if kind == "array":  # a launch replaces it by its address, so it is set each time
            self.arrays.append((place, value.arr))
        if kind == "numpy":
            self.numpy.append((k, place, value.dtype, value.ndim))
        if kind == "real":
            self.numbers.append((k, place, float, self.context.set_arg_float))
        if kind == "whole":
            self.numbers.append((k, place, int, self.context.set_arg_int))

    def fits(self, given: tuple) -> bool:
        """Whether fields and arrays are those of the call that was prepared, and the rest of the same kinds."""
        if len(given) != self.count:
            return False
        for k, value in self.same:
            if given[k] is not value():
                return False
        for k, _, kind, _ in self.numbers:
            if not isinstance(given[k], NUMBERS[kind]):
                return False
        return all(
            plain(given[k]) and (given[k].dtype, given[k].ndim) == (dtype, ndim) for k, _, dtype, ndim in self.numpy
        )

    def alive(self) -> bool:
        """Whether its fields and arrays still exist."""
        return all(value() is not None for _, value in self.same)

    def __call__(self, given: tuple):
        for place, array in self.arrays:
            self.context.set_arg_ndarray(place, array)
        for k, place, kind, assign in self.numbers:
            assign(place, kind(given[k]))
        for k, place, *_ in self.numpy:
            value = given[k]
            self.context.set_arg_external_array_with_shape(place, value.ctypes.data, value.nbytes, value.shape, 0)
        self.prog.launch_kernel(self.code, self.context)
        kinds = self.kernel.return_type or ()
        out = [self.kernel.construct_kernel_ret(self.context, kind, (k,)) for k, kind in enumerate(kinds)]
        return out[0] if len(out) == 1 else out or None


def held(value):
    """Gives a value back, without keeping it alive where it can be pointed at from afar."""
    try:
        return weakref.ref(value)
    except TypeError:
        return lambda: value
