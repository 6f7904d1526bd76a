"""Whether this machine can compile C."""

from __future__ import annotations

from filters.backends.c_compiler import compiler


def has_c() -> bool:
    try:
        return bool(compiler())
    except ValueError:
        return False
