"""Lanes that stay whole: for eight neighbours the compiler is handed one wide instruction instead of eight narrow ones.

Taichi 1.7 takes every vector of a kernel apart into numbers, and what LLVM puts together again are pairs. With its
setting real_matrix_scalarize off vectors stay what they are: the rates kernel is 1.3 to 2 times faster, and shorter.
That setting has holes, so it is off only while a kernel marked @wide is compiled, and such a kernel keeps to what is
sound in it: numbers and lanes, fields of numbers (the components of a vector field are read from wrong places), and the
operations of NATIVE. All others would end the process; `spell` has them worked out lane by lane instead. On the CPU
only: elsewhere there are no lanes.
"""

from contextlib import contextmanager
from functools import wraps

SETTING = "real_matrix_scalarize"
NATIVE = ["sqrt", "floor", "ceil", "round", "add", "sub", "mul", "div", "truediv", "floordiv", "min", "max"]
NATIVE += ["bit_and", "bit_or", "bit_xor", "bit_shl", "bit_sar", "bit_not", "logical_and", "logical_or", "logic_not"]
NATIVE += ["cmp_lt", "cmp_le", "cmp_gt", "cmp_ge", "cmp_eq", "cmp_ne"]


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


def spell(taichi) -> None:
    """Let Taichi's operations on whole vectors go through what it can do with them."""
    from taichi.lang import impl, ops
    from taichi.lang.kernel_impl import _ti_core as core

    native = {getattr(core, f"expr_{name}", None) for name in NATIVE}
    unary, binary, cast = ops._unary_operation, ops._binary_operation, ops.cast

    def tensor(value) -> bool:
        return isinstance(value, impl.Expr) and value.is_tensor()

    def lanes(*values) -> int:
        """How many lanes there are among the values; 0 where vectors are taken apart anyhow."""
        if getattr(impl.current_cfg(), SETTING, True):
            return 0
        return max((value.n for value in values if tensor(value)), default=0)

    def numbers(value):
        """Truths as numbers: a truth of one lane cannot be read out of eight."""
        truths = tensor(value) and value.element_type() == taichi.u1
        return impl.expr_init(ops.select(value, 1, 0) if truths else value) if tensor(value) else value

    def each(work, *values):
        """work for every lane."""
        held, builder = list(map(numbers, values)), impl.get_runtime().compiling_callable.ast_builder()
        rows = [[impl.subscript(builder, v, k) if tensor(v) else v for v in held] for k in range(lanes(*values))]
        return impl.expr_init(taichi.lang.matrix.make_matrix([work(*row) for row in rows]))

    def one(operation, python, a):
        if not lanes(a) or operation in native:
            return unary(operation, python, a)
        if operation is core.expr_neg:
            return ops.mul(a, -1)
        if operation is core.expr_abs:
            return ops.max(a, ops.mul(a, -1))
        return each(lambda x: unary(operation, python, x), a)

    def two(operation, python, a, b):
        square = operation is core.expr_pow and isinstance(b, int)  # or cube: multiplications
        if not lanes(a, b) or operation in native or square:
            return binary(operation, python, a, b)
        return each(lambda x, y: binary(operation, python, x, y), a, b)

    @wraps(cast)
    def turned(value, kind):
        if not lanes(value):
            return cast(value, kind)
        return value if value.element_type() == ops.cook_dtype(kind) else each(lambda x: cast(x, kind), value)

    ops._unary_operation, ops._binary_operation = one, two
    ops.cast = taichi.cast = turned
