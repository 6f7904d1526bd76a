"""What patterns of zeros and ones say of products, and how they are checked."""

from __future__ import annotations

import numpy as np
import pytest

from filters.sparse.structure import (
    ANY,
    Pattern,
    Structure,
    check_structure,
    product,
    transition,
    transition_noise,
    with_losses,
)

F: Pattern = ("1*0", "01*", "001")
PENDULUM = Structure(F=("1*", "*1"), H=("10",), Q=("*0", "0*"), R=("*",))


def matrix_of(pattern: Pattern, seed: int) -> np.ndarray:
    random = np.random.default_rng(seed)
    return np.array([[random.normal() if entry == ANY else float(entry) for entry in row] for row in pattern])


def fits(matrix: np.ndarray, pattern: Pattern) -> bool:
    pairs = zip(matrix.ravel(), "".join(pattern), strict=True)
    return all(entry == ANY or number == float(entry) for number, entry in pairs)


def test_a_product_of_transitions_keeps_what_no_step_fills() -> None:
    assert product(F, F) == ("1**", "01*", "001")
    assert transition(F) == ("1**", "01*", "001")
    Phi = matrix_of(F, 0)
    for step in range(1, 6):
        Phi = matrix_of(F, step) @ Phi
        assert fits(Phi, transition(F))


def test_noise_spreads_as_far_as_the_transitions_take_it() -> None:
    Q: Pattern = ("000", "000", "00*")
    assert transition_noise(F, Q) == ("***", "***", "***")
    assert transition_noise(("100", "01*", "001"), Q) == ("000", "0**", "0**")
    assert transition_noise(("10", "01"), ("*0", "00")) == ("*0", "00")


def test_what_is_lost_is_no_one() -> None:
    lost = with_losses(PENDULUM._replace(R=("1",)))
    assert lost.H == ("*0",)
    assert lost.R == ("1",)


@pytest.mark.parametrize(
    ("structure", "said"),
    [
        (("1*", "*1"), "structure is \\(.*give a Structure"),
        (PENDULUM._replace(F=("1*",)), "F of structure has not 2 rows; give a string of 2 characters for each"),
        (PENDULUM._replace(F="1*"), "F of structure has not 2 rows"),
        (PENDULUM._replace(H=("1",)), "H of structure, row 0, is '1'; give 2 of the characters 0, 1 and \\*"),
        (PENDULUM._replace(H=("1x",)), "H of structure, row 0, is '1x'"),
        (PENDULUM._replace(Q=("*0", "**")), "Q of structure is not symmetric"),
    ],
)
def test_what_is_no_structure_is_refused(structure: object, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        check_structure("structure", structure, 2, 1)


def test_rows_may_be_a_list() -> None:
    assert check_structure("structure", PENDULUM._replace(H=["10"]), 2, 1) == PENDULUM
