"""Functions of C that do what operators do in Python."""

from __future__ import annotations

HELPERS = {
    "from_end": """/* An index of an axis of so many; negative ones count from its end. */
static inline int from_end(int index, int length)
{
    return index < 0 ? index + length : index;
}
""",
    "floor_mod": """/* a modulo b, of the sign of b. */
static inline int floor_mod(int a, int b)
{
    const int rest = a % b;
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}
""",
    "floor_div": """/* a / b, rounded down. */
static inline int floor_div(int a, int b)
{
    const int quotient = a / b;
    return a % b != 0 && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}
""",
    "real_mod": """/* a modulo b, of the sign of b. */
static inline real real_mod(real a, real b)
{
    const real rest = fmod{f}(a, b);
    if (rest == 0) {
        return copysign{f}(0, b);
    }
    return (rest < 0) != (b < 0) ? rest + b : rest;
}
""",
    "whole_of": """/* a without its fraction, as an int. */
static inline int whole_of(real a)
{
    if (!(a >= (real)-2147483648.0 && a < (real)2147483648.0)) {
        FAULT("int() of a number that an int of 32 bits does not hold");
        return 0;
    }
    return (int)a;
}
""",
    "square": """static inline real square(real a)
{
    return a * a;
}
""",
}
"""By name; {f} is the ending of the functions of single precision."""
