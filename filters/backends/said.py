"""What a module says of how its functions are compiled."""

from __future__ import annotations

import sys

NAMES = ("ALLOCATION_FREE", "OPTIMISED_ALONE")


def says(module: str, name: str) -> bool:
    """What a module says of its functions, or else the package that it is in.

    ALLOCATION_FREE: they neither allocate nor return arrays. numba need not count references in them, which it would do
    for every array taken out of a record, and LLVM would not remove all of it: half the time of a short update.
    OPTIMISED_ALONE: their loops are vectorised before they become part of others.
    """
    while module:
        said = getattr(sys.modules.get(module), name, None)
        if said is not None:
            return bool(said)
        module = module.rpartition(".")[0]
    return False
