"""Lanes that stay whole: for eight neighbours the compiler is handed one wide instruction instead of eight narrow ones.

Taichi 1.7 takes every vector of a kernel apart into numbers, and what LLVM puts together again are pairs. With its
setting real_matrix_scalarize off vectors stay what they are: the rates kernel is 1.3 to 2 times faster, and shorter.
That setting has holes, so it is off only while a kernel marked @wide is compiled, and such a kernel keeps to what is
sound in it: numbers and lanes, fields of numbers (the components of a vector field are read from wrong places), and
what lanewise.py makes of the operations that would end the process. On the CPU only: elsewhere there are no lanes.
"""

from contextlib import contextmanager

SETTING = "real_matrix_scalarize"


def wide(function):
    """Marks a kernel that holds numbers and lanes only, between @ti.kernel and its lines."""
    function.wide = True
    return function


@contextmanager
def whole(kernel):
    """While a kernel is read and compiled: vectors stay whole if it is marked, and this Taichi can do it."""
    from taichi.lang import impl
    from taichi.lang.kernel_impl import _ti_core

    config = impl.current_cfg()
    on_cpu = config.arch in (_ti_core.Arch.x64, _ti_core.Arch.arm64)
    if not (on_cpu and getattr(kernel.func, "wide", False) and hasattr(config, SETTING)):
        yield
        return
    setattr(config, SETTING, False)
    try:
        yield
    finally:
        setattr(config, SETTING, True)
