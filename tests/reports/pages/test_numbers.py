"""Numbers as the reports write them."""

from __future__ import annotations

import pytest

from reports.pages.numbers import plus_minus


@pytest.mark.parametrize(
    ("value", "standard_error", "said"),
    [
        (2.5411, 0.1, "2.5 ± 0.2"),
        (1.9312, 0.0096, "1.931 ± 0.019"),
        (15.42, 0.5, "15.4 ± 1.0"),
        (86.44, 4.0, "86 ± 8"),
        (188.4, 9.2, "188 ± 18"),
        (1234.0, 160.0, "1,200 ± 300"),
        (0.0475, 0.0029, "0.048 ± 0.006"),
        (3.0, 0.0, "3.00 ± 0"),
    ],
)
def test_a_value_and_its_error_end_at_one_place(value: float, standard_error: float, said: str) -> None:
    assert plus_minus(value, standard_error) == said
