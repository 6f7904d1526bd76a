"""What the report on the robust filter says of linear systems is true, by its own tables."""

from __future__ import annotations

import pytest

from tests.reports.erkf.page import rows, text

pytestmark = pytest.mark.exhaust  # the study takes a quarter of a minute; `studies/robust` has its tests


def test_stability_and_convergence_of_linear_systems() -> None:
    found = rows("linear.csv")
    robust = [row for row in found if "robust" in row["Filter"]]
    assert max(float(row["radius of the filter"]) for row in found) < 1
    largest = max(float(row["radius of the filter"]) for row in robust)
    steps = max(int(row["steps to one P"]) for row in robust)
    assert f"at most {largest}, and P is one after at most {steps} steps" in text()
    grown = {
        row["Filter"]: float(row["error, step 200"].replace(",", "")) for row in found if row["System"] == "growing"
    }
    assert grown["robust, μ = ∞"] > grown["robust, μ = 1"] > 100 * grown["Kalman filter"]
    decayed = [
        float(row["error, step 200"]) / float(row["error, step 50"]) for row in found if row["System"] == "decaying"
    ]
    assert max(decayed) < 1.2


def test_random_linear_systems() -> None:
    """In a hundred digits; in double precision some filters stop, in the limit alone and where no noise is left."""
    found = rows("linear-sample.csv")
    assert [row["Random systems"] for row in found] == ["finite μ, one noise", "μ = ∞, two noises", "μ = ∞, one noise"]
    for row in found:
        assert row["tried"] == row["stable and convergent"] == "1000"
        assert float(row["largest radius"]) < 1
    assert 0.997**1000 < 0.05 < 0.9971**1000
    assert "Of 3,000 random systems, stable and unstable ones, all are both, with a finite μ and with μ = ∞" in text()
    assert "with 95 % confidence at most 0.3 % of the systems of each kind are not" in text()
    *whole, stopped = (int(row["stopped by rounding †"]) for row in found)
    assert whole == [0, 0]
    assert stopped > 0
    assert f"the filter stops in {stopped} † of 1,000 systems" in text()


def test_where_the_model_is_wrong_the_robust_filters_are_better_and_where_it_is_right_worse() -> None:
    decaying = [row for row in rows("linear.csv") if row["System"] == "decaying"]
    right, wrong = ([row[column] for row in decaying] for column in ("error, step 200", "F wrong"))
    assert sorted(wrong, key=float, reverse=True) == wrong
    assert sorted(right, key=float) == right
    said = f"grows from {right[0]} to {wrong[0]}, the robust ones' from {right[1]} to {wrong[1]} (μ = 1) and from"
    assert said in text()
    assert f"from {right[2]} to {wrong[2]} (μ = ∞)" in text()
