"""What a finite sample of execution times leaves open: how often slower ones come.

Of n independent executions none was slower than the slowest: then slower ones have a probability of at most ln(20) / n,
at 95 %, for (1 - p)^n = 1/20 (the rule of three). Several samples share the 5 %.
"""

from __future__ import annotations

from math import log


def unseen_mass(n: int, samples: int = 1) -> float:
    """The largest probability, at 95 % for so many samples together, of executions slower than all n of one."""
    return min(1.0, log(20 * samples) / n)
