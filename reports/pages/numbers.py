"""Numbers as the reports write them."""

from __future__ import annotations

import re
from fractions import Fraction
from math import floor, log10

WITHIN = re.compile(
    r"(?P<other><code>.*?</code>|<[^>]*>)"
    r"|(?P<day>\b\d{4}-\d\d-\d\d\b)"
    r"|(?<=\d) (?=(?:%|°|(?:ms|µs|s|min|mm|m|µrad|MHz|Hz|KB)\b))"
    r"|(?<=\b\w) (?=[=≤≥<>/+−] )|(?<=\b\w [=≤≥<>/+−]) (?=[-−\w])"
    r"|(?:(?<=Eq\.)|(?<=Eqs\.)|(?<=Fig\.)|(?<=Figs\.)|(?<=Sec\.)|(?<=Secs\.)) (?=\(?\w)",
    re.DOTALL,
)
"""In HTML: what is no text, a day, or the space before a unit, on either side of the sign of a short equation, or
between a name and its number."""
HYPHENATED = re.compile(r"[^\s<>]*-[^\s<>]*(?![^<]*>)")
"""A word of code that a browser would break after its hyphen; in no tag."""
SCIENTIFIC = re.compile(r"([\d.]+)e([-+]?\d+)")
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def percent(share: Fraction) -> str:
    """Without the sign, which stands in the heading: two decimals, and four below 0.1 %."""
    value = 100 * float(share)
    return f"{value:.2f}" if abs(value) >= 0.1 else f"{value:.4f}"


def decimal(value: Fraction) -> str:
    return f"{float(value):.2f}"


def significant(value: Fraction | float, digits: int = 3) -> str:
    """So many digits, with commas between thousands; such as a rate in Hz."""
    rounded = float(f"{float(value):.{digits}g}")
    return f"{rounded:,.0f}" if rounded >= 10 ** (digits - 1) else f"{rounded:#.{digits}g}"


def power(number: str) -> str:
    """As people write it, with no end of a line in it: 3 × 10⁻¹⁶ for "3e-16", 10⁻¹¹ for "1e-11"; another text as it
    is."""
    found = SCIENTIFIC.fullmatch(number)
    if found is None:
        return number
    times = "" if found[1] == "1" else f"{found[1]} × ".replace(" ", "\N{NO-BREAK SPACE}")
    return f"{times}{raised(found[2])}"


def raised(exponent: str) -> str:
    """The power of ten, such as 10⁻⁶ for "-06"."""
    return f"10{str(int(exponent)).translate(RAISED)}"


def plus_minus(value: float, standard_error: float) -> str:
    """± twice the standard error, in one digit, in two where the first is 1; the value to the same place."""
    error = 2 * standard_error
    digits = 2 if f"{error:e}".startswith("1") else 1
    rounded = float(f"{error:.{digits}g}")
    if not rounded:
        return f"{significant(value)} ± 0"
    place = digits - 1 - floor(log10(rounded))
    return " ± ".join(f"{round(part, place):,.{max(place, 0)}f}" for part in (value, rounded))


def between(value: float, low: float, high: float) -> str:
    """Three digits, and the interval in as many."""
    return f"{significant(value)} ({significant(low)} to {significant(high)})"


def span(low: str, high: str) -> str:
    """From one figure to another; one where they are the same, to the digits that are shown."""
    return low if low == high else f"{low} to {high}"


def duration(seconds: float) -> str:
    """How long something took, as one says it: "less than 1 s", "41 s", "3 min 20 s"."""
    if seconds < 1:
        return "less than 1 s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def unbroken(html: str) -> str:
    """The same, with no end of a line in a day, an option or a name of code, between a number and its unit, or in
    "n = 5"."""

    def kept(found: re.Match[str]) -> str:
        day = f'<span class="day">{found["day"]}</span>' if found["day"] else ""
        other = found["other"] or ""
        code = HYPHENATED.sub(r'<span class="word">\g<0></span>', other) if other.startswith("<code>") else other
        return code or day or "\N{NO-BREAK SPACE}"

    return WITHIN.sub(kept, html)
