"""An expression of C in the making."""

from __future__ import annotations

from dataclasses import dataclass

from filters.translation.kinds import Kind
from filters.translation.origins import ANYWHERE, Origins

PRIMARY, POSTFIX, UNARY, PRODUCT, SUM, COMPARED, AND, OR, CHOICE = 0, 1, 2, 3, 4, 6, 11, 12, 13
"""How tightly operators bind, the tightest first, as the C standard numbers them."""


@dataclass(frozen=True)
class Value:
    """text, and the level at which its outermost operator binds.

    by_pointer: it is a record, and the text a pointer to one. rows: of a long array, how many it has.
    passing: it is in memory that the next round of a loop fills anew. origins: of an array, of those in a record, or of
    the array that it is a number of. as_real: of a whole number that may be more than an int holds, computed among
    reals; it is read where a real is made of it.
    """

    text: str
    kind: Kind
    level: int = PRIMARY
    by_pointer: bool = False
    rows: str = ""
    passing: bool = False
    origins: Origins = ANYWHERE
    as_real: str = ""

    def within(self, level: int) -> str:
        """The text, in parentheses where operators of this level would tear it apart."""
        return self.text if self.level <= level else f"({self.text})"
