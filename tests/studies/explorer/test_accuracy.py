"""The accuracy by landing that the explorer shows: that of the closed form, each curve computed once."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import pytest
from hypothesis import given, settings

from filters.accuracy import with_low_rate_noise
from studies.explorer import accuracy as kept
from studies.explorer.accuracy import Accuracy, accuracy
from studies.selection.compare import compared, figure
from studies.selection.methods import METHODS
from studies.selection.question import Question
from tests.studies.explorer.questions import question, questions

LOSSY = ("px4-predictor", "fuse-as-fresh")


def landings_of(found: Accuracy) -> list[int]:
    return [] if found.curve is None else [found.curve.first + at for at in range(len(found.curve.figures))]


@settings(max_examples=8)
@given(questions())
def test_it_is_that_of_a_comparison_at_each_landing(asked: Question) -> None:
    for method in METHODS:
        if method in (*LOSSY, "discard"):
            continue
        found = accuracy(asked, method)
        landings = landings_of(found)
        assert (found.curve is None) == bool(found.reason)
        for L in landings[:: max(len(landings) - 1, 1)]:
            if METHODS[method].landing == "later" and not METHODS[method].lossless:
                continue
            (row,) = compared(
                asked.model,
                asked.outputs,
                asked.sampling,
                L=L if METHODS[method].landing == "later" else None,
                methods=[method],
                metric=asked.metric,
                options=asked.options,
            ).rows
            assert row.accuracy is not None
            assert found.at(L) == pytest.approx(figure(row.accuracy, asked.metric), rel=1e-9)


def test_low_rate_noise_counts_for_the_dual_rate_filter_alone() -> None:
    asked = question(N=10, M=4)
    rough = replace(asked, options=replace(asked.options, low_rate_noise="euler"))
    model, rows = asked.model.linear, asked.outputs.rows
    for of in (asked, rough):
        noise = of.options.low_rate_noise
        assert accuracy(of, "dual-rate").at(8) == pytest.approx(with_low_rate_noise(model, rows, 10, 8, noise).worst)
        assert accuracy(of, "delayed-horizon").at(8) == pytest.approx(accuracy(asked, "dual-rate").at(8))


def test_a_method_that_lands_at_arrival_is_as_accurate_whatever_l_is_asked_for() -> None:
    found = accuracy(question(), "larsen")
    assert landings_of(found) == [44]
    assert found.at(44) == found.at(80) == accuracy(question(), "clone").at(44)
    assert landings_of(accuracy(question(), "standard")) == [0]


def test_a_later_landing_than_all_of_use_is_known_where_it_is_asked_for() -> None:
    assert accuracy(question(), "dual-rate").at(200) is None
    last = accuracy(question(), "dual-rate", last=200)
    assert landings_of(last) == [*range(45, 201)]
    assert last.at(200) == pytest.approx(
        with_low_rate_noise(question().model.linear, [0, 1, 2], 80, 200, "exact").worst
    )


def test_moving_l_or_what_is_allowed_computes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor does a model that was loaded again."""
    accuracy(question(), "dual-rate")
    monkeypatch.setattr(kept, "by_landing", lambda *_: pytest.fail("computed again"))
    for within in (0.3, 0.4, inf):
        for method in ("dual-rate", "larsen", "clone"):
            assert accuracy(question(within=within), method).at(45)


def test_the_long_sum_is_left_out_unless_it_is_wanted() -> None:
    """0.3729 is what loses nothing; 0.3824 is what the predictor makes of it."""
    for within in (inf, 0.37, 0.38):
        found = accuracy(question(within=within), "px4-predictor")
        assert found == Accuracy(None, "more than 0.3729 m: choose it to see how much")
        wanted = accuracy(question(within=within), "px4-predictor", whole=True)
        assert wanted.at(44) == pytest.approx(0.38236, rel=1e-4)


def test_a_sum_that_takes_long_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a fast loop with a short delay it is three thousand million multiplications."""
    monkeypatch.setattr(kept, "at_arrival", lambda *_: pytest.fail("was computed"))
    fast = question(N=200, M=34, hr_hz=1000, within=0.5)
    found = accuracy(fast, "px4-predictor", whole=True)
    assert found.reason == (
        "its accuracy is a sum over too many steps: `sched-sim accuracy --method px4-predictor` takes it"
    )


@pytest.mark.parametrize(
    ("method", "hr_hz", "said"),
    [
        ("px4-predictor", None, "its time constant is in seconds: give hr_hz"),
        ("fuse-as-fresh", 400, "its error is how far the measured quantities move during the delay"),
        ("delayed-horizon", 400, "no step is left"),
        ("augmentation", 400, ""),
    ],
)
def test_a_method_that_lacks_something_says_what(method: str, hr_hz: int | None, said: str) -> None:
    found = accuracy(question(N=44, M=44, hr_hz=hr_hz), method)
    assert said in found.reason
    assert (found.curve is None) == bool(said)


def test_too_many_steps_are_told_not_computed() -> None:
    found = accuracy(question(N=1_000_000), "larsen")
    assert "at most" in found.reason
    assert found.at(44) is None
