"""What samples leave open is counted over all executions, and bounded by the worst case."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from math import log

import pytest

from sched_sim.costs.table import CostTable
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.probability.stated import StatedCost
from studies.probability.answer import Answer, answer
from studies.probability.question import Question, certain, stated_and_constant
from studies.probability.unseen import resolution

N_SAMPLES = 1000


def sample(*values: int, worst: int | None = None) -> StatedCost:
    repeated = [Fraction(values[number % len(values)]) for number in range(N_SAMPLES)]
    return StatedCost(repeated, worst=None if worst is None else Fraction(worst), autocorrelation=0.0)


def question(method: str, stated: Mapping[str, StatedCost], timing: Timing, speed: int) -> Question:
    costs, constant, pieces = stated_and_constant(CostTable("none", "us", {}), method, Options(), stated, "minimum")
    return Question(method, costs, constant, pieces, timing, Fraction(speed), cycles=20)


def recalculate(replay: StatedCost, speed: int) -> Answer:
    stated = {"propagate": certain(Fraction(2)), "update": certain(Fraction(3)), "replay": replay}
    return answer(question("recalculate", stated, Timing(10, 4, 4), speed))


def test_a_job_of_several_executions_may_have_an_unseen_one_in_each() -> None:
    found = recalculate(sample(1, 2), 40)
    assert found.resolution.job == pytest.approx(4 * log(20) / N_SAMPLES)
    assert found.resolution.cycle == pytest.approx(4 * log(20) / N_SAMPLES)
    assert found.hr_miss.bound is None


def test_several_samples_share_the_confidence() -> None:
    stated = {"propagate": sample(2), "update": certain(Fraction(3)), "replay": sample(1)}
    found = resolution(question("recalculate", stated, Timing(10, 4, 4), 40))
    assert found.job == pytest.approx((1 + 4) * log(40) / N_SAMPLES)
    assert found.cycle == pytest.approx((10 + 4) * log(40) / N_SAMPLES)


def test_what_was_not_seen_is_at_the_worst_case() -> None:
    found = recalculate(sample(1, worst=7), 14)  # 2 + 3 + 4 x 1 <= 14, and with one of 7 more than that
    assert found.hr_miss.first == (0, 0)
    unseen = log(20) / N_SAMPLES
    assert found.hr_miss.bound == pytest.approx((1 - (1 - unseen) ** 4) / 10, rel=1e-4)  # or the next one too
    assert found.late.bound == pytest.approx(1 - (1 - unseen) ** 4)
    assert recalculate(sample(1, worst=2), 14).hr_miss.bound == 0


def test_a_bound_of_the_dual_rate_filter_holds_for_every_cost_up_to_the_worst() -> None:
    """Shorter work may do harm there: all that is up to the worst case is no worse than the bound."""
    timing = Timing(4, 0, 2)
    known = {"hr_propagate": 10, "hr_restart": 10, "hr_update": 12, "lr_propagate": 4}
    rest = {kind: certain(Fraction(cost)) for kind, cost in known.items()}
    bound = answer(question("dual-rate", rest | {"lr_update": sample(5, worst=30)}, timing, 24))
    assert bound.bound is not None
    assert not bound.bound.exact
    unseen = log(20) / N_SAMPLES
    for cost in range(6, 31):
        mixed = StatedCost([Fraction(5), Fraction(cost)], [1 - Fraction(unseen), Fraction(unseen)])
        true = answer(question("dual-rate", rest | {"lr_update": mixed}, timing, 24))
        for one, other in ((true.hr_miss, bound.hr_miss), (true.late, bound.late)):
            assert other.bound is not None
            assert one.first.upper <= other.bound + 1e-12
            assert one.long_run is not None
            assert one.long_run.upper <= other.bound + 1e-12


def test_what_piles_up_without_end_is_never_called_impossible() -> None:
    stated = {"propagate": certain(Fraction(11)), "update": certain(Fraction(3)), "replay": certain(Fraction(3))}
    found = answer(replace(question("recalculate", stated, Timing(10, 4, 4), 10), cycles=60))
    assert found.late.long_run is None
    assert found.not_followed == 1
    for figure in found.figures:  # in the last cycle all is further behind than is followed
        assert figure.last.upper == 1


def test_landings_and_any_miss() -> None:
    stated = {kind: certain(Fraction(1)) for kind in ("hr_restart", "hr_update", "lr_propagate", "lr_update")}
    stated["hr_propagate"] = StatedCost([Fraction(10), Fraction(31)], [Fraction(999, 1000), Fraction(1, 1000)])
    stated["hr_restart"] = stated["hr_propagate"]
    found = answer(question("dual-rate", stated, Timing(4, 0, 1), 30))
    assert [figure.what for figure in found.landings[:2]] == ["lands at L = 1", "lands at L = 2"]
    assert found.landings[1].first.upper == pytest.approx(9.99e-4)
    assert found.any_hr_miss.lower == pytest.approx(1e-3)
    assert found.any_hr_miss.upper == pytest.approx(20 * 4 * 1e-3)
    assert found.blocks is None
