"""Names in C."""

from __future__ import annotations

import keyword

_WORDS = (
    "auto bool break case char const continue default do double else enum extern float for goto if inline int long "
    "real register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while "
    "abs acos asin atan atan2 cos cosh exp fabs floor fmod log pow sin sinh sqrt tan tanh y0 y1 yn j0 j1 jn gamma "
    "cbrt ceil copysign erf erfc exp2 expm1 fdim fma fmax fmin frexp hypot ilogb isfinite isinf isnan isnormal ldexp "
    "lgamma llrint llround log10 log1p log2 logb lrint lround modf nan nearbyint nextafter remainder remquo rint round "
    "scalbln scalbn signbit tgamma trunc "
    "main NAN INFINITY FAULT fault on_fault run_job repeat_job take_fault"
)
_KEYWORDS = frozenset(_WORDS.split())


def c_name(name: str) -> str:
    """The name of a variable, parameter, field or function, of the letters that every C compiler takes."""
    plain = "".join(map(_letters, name)).strip("_") or "unused"
    if plain[0].isdigit():
        plain = f"n{plain}"
    return f"{plain}_" if plain in _KEYWORDS or keyword.iskeyword(plain) else plain


def _letters(letter: str) -> str:
    """One of C, or several that stand for it: u3a6 for a Greek Phi."""
    if letter.isascii():
        return letter if letter.isalnum() else "_"
    return f"u{ord(letter):x}"
