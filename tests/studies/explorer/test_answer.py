"""The sentence that a person reads first: what it says is so, and its numbers are those of the commands."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim import Task
from studies.explorer.answer import answer
from studies.explorer.given import Given
from studies.explorer.words import listed
from studies.selection.choose import choose_filter
from tests.studies.explorer.questions import found_of

GPS = "hr_hz=400&measurement_hz=5&delay_ms=110"


@pytest.mark.parametrize(
    ("query", "state", "sentence"),
    [
        (
            "N=10&M=4&L=8",
            "holds",
            "dual-rate needs 0.77 standard steps per HR period: its correction lands at L = 8, as late as is allowed",
        ),
        (
            "N=100&M=10&L=80",
            "holds",
            "dual-rate needs 0.66 standard steps per HR period: its correction lands at L = 29 of the 80 allowed",
        ),
        (
            "N=10&M=4&L=8&speed=0.7",
            "misses",
            "dual-rate at speed 0.7 misses deadlines: the LR update of the measurement of step 0 is late first, and it "
            "needs 0.77 standard steps per HR period, 10 % more",
        ),
        (
            "N=10&M=4&speed=1.4&method=larsen",
            "misses",
            "larsen at speed 1.4 misses deadlines: the HR job of step 4 is late first, and it needs 1.47 standard "
            "steps "
            "per HR period, 5 % more",
        ),
        (
            "N=10&M=4&method=larsen&speed=0.001",
            "misses",
            "larsen at speed 0.001 misses deadlines: the HR job of step 0 is late first, and it needs 1.47 standard "
            "steps "
            "per HR period, 1,470 times as much",
        ),
        (
            f"{GPS}&processor=leon3",
            "holds",
            "dual-rate on leon3 meets every deadline: its correction lands at L = 45 (112.5 ms) of the 80 allowed, "
            "and it "
            "takes 14.7 % of the part",
        ),
        (
            f"{GPS}&model=ins-gps",
            "holds",
            "dual-rate needs 4581 operations per HR period: its correction lands at L = 65 (162.5 ms) of the 80 "
            "allowed, "
            "where the worst standard deviation of position is 0.381 m; leon3 would do: 14.7 % of it is needed",
        ),
        (
            f"{GPS}&model=ins-gps&within=0.38&processor=leon3",
            "holds",
            "dual-rate on leon3 keeps position within 0.38 m: its correction lands at L = 45 (112.5 ms) of the 62 "
            "allowed, "
            "and it takes 14.7 % of the part",
        ),
        (
            f"{GPS}&model=ins-gps&within=0.38",
            "inaccurate",
            "dual-rate does not keep position within 0.38 m: its correction lands at L = 65 (162.5 ms), where it is "
            "0.381 m; give L 62, for which it needs 4600.7 operations per HR period",
        ),
        (
            f"{GPS}&model=ins-gps&within=0.373",
            "inaccurate",
            "dual-rate cannot keep position within 0.373 m: at best it is 0.3734 m, landing at L = 45 (112.5 ms); "
            "clone-split, clone, carried-gain and 3 more can",
        ),
        (
            f"{GPS}&model=ins-gps&within=0.3",
            "inaccurate",
            "dual-rate cannot keep position within 0.3 m: at best it is 0.3734 m, landing at L = 45 (112.5 ms); no "
            "method "
            "can, the best is 0.373 m, by recalculate, larsen, clone and 3 more (without delay 0.3566 m): allow more, "
            "measure more often, or shorten the delay",
        ),
        (
            f"{GPS}&model=ins-gps&within=0.4&processor=rp2040",
            "misses",
            "dual-rate on rp2040 misses deadlines: the HR job of step 0 is late first, and it needs 112 % of rp2040; "
            "on it "
            "delayed-horizon, clone-split and clone would do; leon3 would do: 14.7 % of it is needed",
        ),
        (
            f"{GPS}&model=ins-gps&within=0.4&method=fuse-as-fresh",
            "unknown",
            "whether fuse-as-fresh keeps position within 0.4 m is not known: its error is how far the measured "
            "quantities "
            "move during the delay, which is not known here: `sched-sim accuracy --motion` takes it",
        ),
        (
            f"{GPS}&model=ins-gps&within=0.4&method=standard&processor=leon3",
            "holds",
            "standard (no delay) on leon3 keeps position within 0.4 m: it corrects the step of the measurement itself, "
            "and it takes 20.3 % of the part",
        ),
        (
            "model=ins-gps&metric=rms&costs=steffes2014&within=0.4",
            "holds",
            "dual-rate keeps position within 0.4 m rms: at its least speed, 0.66 standard steps per HR period, its "
            "correction lands at L = 63 (157.5 ms) of the 80 allowed",
        ),
    ],
)
def test_in_words(query: str, state: str, sentence: str) -> None:
    said = answer(found_of(query))
    assert (said.state, said.sentence) == (state, sentence)


@settings(max_examples=12)
@given(
    st.sampled_from(["dual-rate", "larsen", "clone", "delayed-horizon"]),
    st.integers(1, 9),
    st.floats(0.3, 0.45),
    st.sampled_from(["", "&processor=leon3", "&processor=rp2040", "&processor=cortex-m7"]),
)
def test_what_it_says_is_so(method: str, M: int, within: float, processor: str) -> None:
    query = f"N=10&M={M}&hr_hz=400&model=ins-gps&method={method}&within={within:.4f}{processor}"
    found = found_of(f"{query}&costs=counted-9-3-3")
    said, plan = answer(found), found.plan
    std = None if found.figures is None else found.figures.at(plan.landed)
    accurate = std is not None and std <= float(f"{within:.4f}")
    assert said.state == ("misses" if not plan.fits else "holds" if accurate else "inaccurate")
    assert (found.timeline.misses > 0) <= (said.state == "misses")
    least = [plan.least, *(of.least for of in found.kept.values() if of.least is not None)]
    shares = [on.needed for on in found.parts if on.needed is not None]
    shares += [of.speed / found.asked.pace for of in least if found.asked.pace is not None]
    for number in re.findall(r"([\d.]+) % of", said.sentence):
        assert any(0 <= Fraction(number) / 100 - share < share / 99 for share in shares)


def test_the_latest_landing_is_that_of_choose_filter() -> None:
    of = next(of for of in choose_filter(0.38, "ins-gps", methods=["dual-rate"], every=(1,)).keeping
              if of.variant.departures == 0)  # fmt: skip
    assert f"give L {of.L}" in answer(found_of(f"{GPS}&model=ins-gps&within=0.38")).sentence


def test_a_task_that_is_late_first_is_named() -> None:
    given_task = Given(tasks=(Task("control", Fraction(1), Fraction("0.3"), priority=30),))
    said = answer(found_of("N=10&M=4&L=8&speed=0.8", given_task))
    assert said.state == "misses"
    assert "task control is late first" in said.sentence


def test_of_methods_whose_schedule_is_not_looked_at_it_says_whether_they_are_accurate_enough() -> None:
    """Where each takes a simulation."""
    query = "N=10&M=4&model=camera&costs=counted-9-3-3&method=dual-rate&policy=edf"
    best = answer(found_of(f"{query}&within=0.0239")).sentence
    assert "recalculate, larsen, clone and 3 more would be accurate enough" in best
    assert "the best is 0.02243 m, by recalculate, larsen" in answer(found_of(f"{query}&within=0.01")).sentence


def test_long_lists_are_cut() -> None:
    assert listed(["a"]) == "a"
    assert listed(["a", "b"]) == "a and b"
    assert listed(["a", "b", "c", "d"]) == "a, b, c and d"
    assert listed(["a", "b", "c", "d", "e"]) == "a, b, c and 2 more"
