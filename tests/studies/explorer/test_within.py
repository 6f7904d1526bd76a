"""What each method needs to keep an accuracy: what `choose_filter` says of these options alone."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.options import Options
from sched_sim.errors import InputError
from sched_sim.processors.part_file import load_part
from sched_sim.schedule.tasks import Task
from studies.explorer import within as kept
from studies.explorer.cheapest import cheapest
from studies.explorer.parts import verdicts
from studies.explorer.within import OF_CURRENT, keeping
from studies.selection.choice import Candidate
from studies.selection.choose import chosen
from studies.selection.question import Question
from tests.studies.explorer.questions import PARTS, question, questions, where

METHODS = [method for method in DELAYED_METHODS if method != "fuse-as-fresh"]


def all_of(asked: Question, method: str) -> Candidate | None:
    """By `studies.choose_filter`, with each part; None where no way keeps the accuracy."""
    try:
        found = chosen(asked, [method], (1,))
    except InputError:
        return None
    (of,) = (*found.best, *found.others)
    return of


@settings(max_examples=15)
@given(questions(), st.sampled_from(METHODS))
def test_it_is_what_choose_filter_says(asked: Question, method: str) -> None:
    expected = all_of(asked, method)
    got = keeping(asked, [method], method, where(asked))[method]
    if expected is None or expected.least is None:
        assert got.least is None
        assert got.reason
        return
    alone = SCHEDULED[method].law(asked.options.feedback).last_alone(asked.sampling.N, asked.sampling.M)
    if alone is not None and alone < (expected.L or 0):
        assert got.least is not None
        assert (got.L, got.least.speed >= expected.least.speed) == (alone, True)
        return
    got, expected = (replace(of, allowed=min(of.allowed or 0, alone or of.allowed or 0)) for of in (got, expected))
    assert replace(got, parts=()) == replace(expected, parts=())
    assert got.parts == expected.parts[:1]


def test_of_the_design_that_the_explorer_starts_with() -> None:
    asked = question(within=0.38)
    found = keeping(asked, METHODS, "dual-rate", where(asked))
    assert {method: (of.L, of.cheapest and of.cheapest.name) for method, of in found.items() if of.L is not None} == {
        "standard": (0, "leon3"),
        "recalculate": (44, "cortex-m7"),
        "larsen": (44, "leon3"),
        "dual-rate": (62, "leon3"),
        "clone": (44, "rp2040"),
        "clone-split": (44, "rp2040"),
        "carried-gain": (44, "leon3"),
        "delayed-horizon": (62, "rp2040"),
        "augmentation": (44, "desktop"),
    }
    assert found["px4-predictor"].reason == "more than 0.3729 m: choose it to see how much"
    chosen_too = keeping(asked, ["px4-predictor"], "px4-predictor", where(asked))["px4-predictor"]
    assert chosen_too.reason == "0.3824 m at best, landing at L=44"


def test_prices_come_before_what_is_to_spare() -> None:
    dear, cheap = (replace(load_part(name), price=Fraction(price)) for name, price in (("rp2040", 9), ("leon3", 2)))
    asked = question(within=0.38, parts=(dear, cheap))
    found, expected = keeping(asked, ["clone"], "clone", where(asked))["clone"], all_of(asked, "clone")
    assert found.parts[0].part is cheap
    assert expected is not None
    assert found.parts == expected.parts[:1]


def test_the_part_that_is_chosen_comes_before_cheaper_ones_where_it_does() -> None:
    asked = question(within=0.4)
    at = where(asked)
    assert at is not None
    chosen = next(part for part in PARTS if part.name == "cortex-m4f")
    found = keeping(asked, METHODS, "dual-rate", replace(at, chosen=chosen))
    others = keeping(asked, METHODS, "dual-rate", at)
    does = {method: of for method, of in found.items() if of.cheapest is not None}
    assert {method for method, of in does.items() if of.cheapest and of.cheapest.name == "cortex-m4f"} == {
        "standard", "larsen", "dual-rate", "clone", "clone-split", "carried-gain", "delayed-horizon",
    }  # fmt: skip
    for method in ("recalculate", "augmentation"):
        assert found[method] == others[method]
    alone = verdicts(replace(at, parts=(chosen,)), "dual-rate", asked.sampling.timing(44, 80), lambda _: None)
    assert [replace(on, std=None) for on in found["dual-rate"].parts] == list(alone)


def test_where_no_part_is_fast_enough_the_nearest_is_told() -> None:
    slow = question(within=0.4, hr_hz=20_000, parts=PARTS[:3])
    found = keeping(slow, ["recalculate"], "recalculate", where(slow))["recalculate"]
    expected = all_of(slow, "recalculate")
    assert expected is not None
    assert found.cheapest is None
    assert found.reason == expected.reason
    assert "no part is fast enough: the nearest" in found.reason


@pytest.mark.parametrize("rate", [400, 2800])
def test_the_first_place_is_that_of_all_of_them_by_cost(rate: int) -> None:
    """Also for a landing after the next measurement, whose least speed may take a search."""
    asked = question(N=4, M=1, hr_hz=rate, parts=PARTS[::3])
    timing = asked.sampling.timing(1, 5)
    for options in (Options(), Options(cpus=2), Options(feedback="same-step", lr_propagate_by="l")):
        at = where(replace(asked, options=options))
        assert at is not None
        each = verdicts(at, "dual-rate", timing, lambda _: None)
        assert cheapest(at.places("dual-rate"), timing, options, ()) == [each[0]]


def test_where_each_takes_simulations_only_the_current_method_is_looked_at() -> None:
    """The least speed is with the tasks, in the unit of the costs; on parts they take seconds."""
    asked = question(N=4, M=2, within=0.5, parts=PARTS[:2])
    on_parts = replace(asked, tasks=(Task("control", Fraction(1), Fraction(1, 10**6), priority=5),))
    busy = replace(asked, parts=(), tasks=(Task("control", Fraction(1), Fraction(100), priority=5),))
    found = keeping(busy, ["larsen", "clone"], "clone", where(on_parts))
    assert (found["larsen"].reason, found["larsen"].allowed) == (OF_CURRENT, 2)
    alone, expected = all_of(busy, "clone"), all_of(on_parts, "clone")
    assert alone is not None
    assert expected is not None
    assert found["clone"].least == alone.least
    assert found["clone"].parts == expected.parts[:1]


def test_landings_after_the_next_measurement_are_left_alone_where_there_are_others() -> None:
    for N, M, L in ((1500, 600, 1500), (80, 44, 80), (10, 10, 20)):
        asked = question(N=N, M=M, hr_hz=None, within=9.0)
        assert keeping(asked, ["dual-rate"], "dual-rate", None)["dual-rate"].L == L


def test_moving_l_computes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    first = keeping(question(within=0.38), METHODS, "dual-rate", where(question()))
    monkeypatch.setattr(kept, "considered", lambda *_: pytest.fail("computed again"))
    assert keeping(question(within=0.38), METHODS, "dual-rate", where(question())) == first


def test_what_a_table_lacks_is_told() -> None:
    found = keeping(question(within=0.5, costs="steffes2014", parts=()), ["clone"], "clone", None)["clone"]
    assert "steffes2014 has no costs of it" in found.reason
