"""Spares Taichi repeated work while it reads kernels: a function is looked up and its lines are worded once a process.

Taichi 1.7 asks for the source of a function at every call of it inside a kernel, and words the place of every
expression for messages that are hardly ever shown, wrapping the line with textwrap: 1.4 of the 2.4 seconds that reading
the kernels of a full MHD scene took. Both are functions of the source alone. Results are the same to the byte; where a
version of Taichi has other names for them, nothing is changed.
"""

from functools import lru_cache

MOST = 1 << 16  # answers kept: 50 times what the largest scene asks for


def remember(taichi) -> None:
    """Keep the answers of Taichi's two slow questions."""
    from taichi.lang import kernel_impl
    from taichi.lang.ast import ast_transformer_utils

    for name in ("getsourcefile", "getsourcelines"):
        if hasattr(kernel_impl, name):
            setattr(kernel_impl, name, lru_cache(4096)(getattr(kernel_impl, name)))
    context = getattr(ast_transformer_utils, "ASTTransformerContext", None)
    if hasattr(context, "get_pos_info"):
        context.get_pos_info = kept(context.get_pos_info)


def kept(describe):
    """`describe` with its answers kept by place in the source."""
    known: dict = {}

    def get_pos_info(self, node) -> str:
        place = self.func.func, node.lineno, node.col_offset, node.end_lineno, node.end_col_offset, type(node)
        if place not in known:
            if len(known) > MOST:
                known.clear()
            known[place] = describe(self, node)
        return known[place]

    return get_pos_info
