"""Operations on whole lanes: those that Taichi cannot do on whole vectors (wide.py) are worked out lane by lane.

Without this, the negative, an absolute value, a cast or an exponential of lanes would end the process.
"""

from functools import wraps

from .wide import SETTING

NATIVE = ["sqrt", "floor", "ceil", "round", "add", "sub", "mul", "div", "truediv", "floordiv"]
NATIVE += ["bit_and", "bit_or", "bit_xor", "bit_shl", "bit_sar", "bit_not", "logical_and", "logical_or", "logic_not"]
NATIVE += ["cmp_lt", "cmp_le", "cmp_gt", "cmp_ge", "cmp_eq", "cmp_ne"]


def spell(taichi) -> None:
    """Let Taichi's operations on whole vectors go through what it can do with them."""
    from taichi.lang import ops

    work = Lanewise(taichi)
    ops._unary_operation, ops._binary_operation = work.one, work.two
    ops.cast = taichi.cast = wraps(work.cast)(lambda value, dtype: work.turned(value, dtype))


class Lanewise:
    """Stands in for Taichi's ways to build an operation; keeps them for everything that is not whole lanes."""

    def __init__(self, taichi):
        from taichi.lang import impl, ops
        from taichi.lang.kernel_impl import _ti_core

        self.impl, self.ops, self.core, self.u1 = impl, ops, _ti_core, taichi.u1
        self.unary, self.binary, self.cast = ops._unary_operation, ops._binary_operation, ops.cast
        self.extremes = {_ti_core.expr_max: ops.cmp_gt, _ti_core.expr_min: ops.cmp_lt}
        self.native = {getattr(_ti_core, f"expr_{name}", None) for name in NATIVE}

    def tensor(self, value) -> bool:
        return isinstance(value, self.impl.Expr) and value.is_tensor()

    def lanes(self, *values) -> int:
        """How many lanes there are among the values; 0 where vectors are taken apart anyhow."""
        if getattr(self.impl.current_cfg(), SETTING, True):
            return 0
        return max((value.n for value in values if self.tensor(value)), default=0)

    def numbers(self, value):
        """Lanes in a variable, truths as numbers: a truth of one lane cannot be read out of eight."""
        if not self.tensor(value):
            return value
        return self.impl.expr_init(self.ops.select(value, 1, 0) if value.element_type() == self.u1 else value)

    def lane(self, value, k: int):
        """Lane k of lanes; a number is the same in all."""
        builder = self.impl.get_runtime().compiling_callable.ast_builder()
        return self.impl.subscript(builder, value, k) if self.tensor(value) else value

    def each(self, work, *values):
        """work for every lane."""
        held = list(map(self.numbers, values))
        made = [work(*(self.lane(value, k) for value in held)) for k in range(self.lanes(*values))]
        return self.impl.expr_init(self.impl.make_matrix(made))

    def one(self, operation, python, a):
        """An operation on one value."""
        if not self.lanes(a) or operation in self.native:
            return self.unary(operation, python, a)
        if operation is self.core.expr_neg:
            return self.ops.mul(a, -1)
        if operation is self.core.expr_abs:
            return self.ops.max(a, self.ops.mul(a, -1))
        return self.each(lambda x: self.unary(operation, python, x), a)

    def two(self, operation, python, a, b):
        """An operation on two values; a whole power is multiplications.

        A choice by comparison is one instruction, a maximum that heeds NaN would be three.
        """
        if operation in self.extremes and self.lanes(a, b):
            return self.ops.select(self.extremes[operation](a, b), a, b)
        whole_power = operation is self.core.expr_pow and isinstance(b, int)
        if not self.lanes(a, b) or operation in self.native or whole_power:
            return self.binary(operation, python, a, b)
        return self.each(lambda x, y: self.binary(operation, python, x, y), a, b)

    def turned(self, value, kind):
        """A value cast to another type."""
        if not self.lanes(value):
            return self.cast(value, kind)
        same = value.element_type() == self.ops.cook_dtype(kind)
        return value if same else self.each(lambda x: self.cast(x, kind), value)
