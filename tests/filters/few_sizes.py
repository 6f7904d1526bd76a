"""Sizes of examples, fewer in C: there each combination of sizes is a program of its own, to be compiled."""

from __future__ import annotations

from filters.backends.choose import BackendName

COMBINATIONS = ((1, 1, 1), (2, 5, 7), (4, 4, 4))


def few(backend: BackendName, *sizes: int) -> tuple[int, ...]:
    """The sizes, one to three of them; in C, those of one of the combinations, but 0 stays 0."""
    if backend != "c":
        return sizes
    chosen = COMBINATIONS[sum(sizes) % len(COMBINATIONS)]
    return tuple(instead if size else 0 for size, instead in zip(sizes, chosen, strict=False))
