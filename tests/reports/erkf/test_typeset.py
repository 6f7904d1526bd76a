"""How the tables of the report on the robust filter are written."""

from __future__ import annotations

import pytest

from reports.erkf import tables


@pytest.mark.parametrize(("name", "said"), [("KF mu=1e5, bias row", "EKF μ = 10⁵, bias row"), ("mu=inf", "μ = ∞")])
def test_filters_are_called_as_people_write_them(name: str, said: str) -> None:
    assert tables.spoken(name) == said


def test_no_line_of_a_cell_ends_within_an_interval_or_a_pair() -> None:
    ((interval, pair, small),) = tables.typeset([["0.12 ± 0.01, μ = ∞", "3.8 / no", "1e-11"]])
    assert [cell.count(" ") for cell in (interval, pair, small)] == [1, 0, 0]
    assert [" ".join(cell.split()) for cell in (interval, pair, small)] == [
        "0.12 ± 0.01, μ = ∞", "3.8 / no", "10⁻¹¹",
    ]  # fmt: skip


def test_tables_of_both_filters_are_one() -> None:
    found = tables.by_system({"attitude": [["date"], [1], [2]], "position": [["date"], [3]]})
    assert found == [["Filter", "date"], ["attitude", 1], ["attitude", 2], ["position", 3]]
