"""Linear algebra as plain loops.

Every kernel writes its result into `out` and allocates nothing, because an allocation costs as much as a small
matrix product and would distort a measured cost. `out` never shares memory with an input unless a docstring allows it.
"""

ALLOCATION_FREE = OPTIMISED_ALONE = True
"""Marks of the functions in this package, for compilers: see `compiled`."""
