"""Names in C."""

from __future__ import annotations

import keyword

_WORDS = (
    "auto bool break case char const continue default do double else enum extern float for goto if inline int long "
    "real register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while "
    "abs acos asin atan atan2 cos cosh exp fabs floor fmod log pow sin sinh sqrt tan tanh y0 y1 yn j0 j1 jn gamma "
    "main NAN INFINITY FAULT"
)
_KEYWORDS = frozenset(_WORDS.split())


def c_name(name: str) -> str:
    """The name of a variable, parameter or field."""
    plain = name.strip("_") or "unused"
    return f"{plain}_" if plain in _KEYWORDS or keyword.iskeyword(plain) else plain
