"""What is said of when the dual-rate filter needs less is what its tables show, or nothing is said."""

from __future__ import annotations

from fractions import Fraction

import pytest

from reports.steffes.advantage import about_advantage, heavier_rows, needed_rows
from studies.steffes.advantage import Heavier, Needed

FOUND = [
    Needed("clone", Fraction(1, 2), 4),
    Needed("dual-rate", Fraction(4, 5), 8),
    Needed("larsen", Fraction(8, 5), 4),
]
UPDATES = [Heavier(Fraction(added), Fraction(2 + added), {5: Fraction(2 + added), 8: Fraction(1)}) for added in (0, 2)]
RATES = {N: (Fraction(2), Fraction(1)) for N in (10, 100)}


def test_the_sentences_tell_the_tables() -> None:
    said = about_advantage(FOUND, UPDATES, RATES, 8)
    assert said["named"] == ["Larsen 1.600"]
    assert said["less"] == ["Stochastic cloning 0.500, L = 4"]
    assert (said["others"], said["more"]) == (2, 1)
    assert (said["shares"], said["at_once"]) == (["50 %", "25 %"], ["100 %", "100 %"])
    assert [row[2:] for row in needed_rows(FOUND)[1:]] == [["0.62", "4", "no"], ["1.00", "8", ""], ["2.00", "4", "yes"]]
    assert heavier_rows(UPDATES)[-1] == ["2.0", "4.00", "4.00", "1.00", "100 %", "25 %"]


def test_nothing_is_said_that_does_not_hold() -> None:
    with pytest.raises(ValueError, match="named in Sec"):
        about_advantage([FOUND[2]._replace(speed=Fraction(1, 3)), *FOUND[:2]], UPDATES, RATES, 8)
    with pytest.raises(ValueError, match="N does not matter"):
        about_advantage(FOUND, UPDATES, {**RATES, 1000: (Fraction(3), Fraction(1))}, 8)
