"""Choosing a filter from Python: against a search of every landing, and what a notebook shows."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from filters.accuracy import LinearModel, lossless, shipped_model, with_low_rate_noise
from filters.systems.linear import linear_system
from sched_sim import InputError, Options, Timing, least_speed, load_part, select
from sched_sim.design.methods import METHODS as SCHEDULED
from studies import choose_filter, compare_accuracy
from studies.selection.choice import Choice
from studies.selection.choose import chosen, within_of
from studies.selection.conditions import Conditions
from studies.selection.costs import tables_for
from studies.selection.front import front
from studies.selection.methods import METHODS
from studies.selection.model import load_model
from studies.selection.outputs import outputs_of
from studies.selection.parts import OnPart, by_cost
from studies.selection.question import Question
from studies.selection.sampling import Sampling

Phi = np.array([[1.0, 1.0], [0.0, 1.0]])
Q = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
CV = LinearModel(Phi, Q, np.array([[1.0, 0.0]]), np.eye(1))
COSTS = ["counted-9-3-3"]
"""Where they do not matter: without them they are counted, which takes a while."""


def choice(within: float, **more: Any) -> Choice:
    return choose_filter(within, CV, [0], N=10, M=4, **more)


@pytest.mark.parametrize(
    ("within", "metric"),
    [
        (6.2, "rms"),
        *(
            pytest.param(within, metric, marks=pytest.mark.exhaust)
            for within in (4.4, 4.9, 5.5, 6.2, 9.0)
            for metric in ("worst", "rms")
        ),
    ],
)
def test_it_is_what_a_search_of_every_landing_finds(within: float, metric: str) -> None:
    """Each way that keeps it, with its latest landing and its least speed; no other does."""
    found = choice(within, every=(1, 2), metric=metric)
    tables = tables_for(load_model(CV, None), None)
    expected = {}
    for table in tables:
        for every in (1, 2):
            for name in ("recalculate", "larsen", "dual-rate"):
                for noise in ("exact", "sum", "euler") if name == "dual-rate" else ("exact",):
                    for gain in ("at-update", "precomputed") if name == "dual-rate" else ("at-update",):
                        options = Options(low_rate_noise=noise, gain=gain)  # type: ignore[arg-type]
                        latest, law = None, SCHEDULED[name].law("next-step")
                        last = 4 if law.only_first else law.last_of_use(10 * every, 4)
                        for L in range(4 + law.after, last + 1):
                            accuracy = with_low_rate_noise(CV, [0], 10 * every, L, options.low_rate_noise)
                            if getattr(accuracy, metric) > within:
                                break
                            latest = L
                        if latest is not None:
                            least = least_speed(select(table, name, options), Timing(10 * every, 4, latest), options)
                            expected[table.name, every, name, noise, gain] = latest, least.speed
    got = {
        (
            of.variant.table.name,
            of.variant.every,
            of.variant.method,
            of.variant.options.low_rate_noise,
            of.variant.options.gain,
        ): (of.L, of.least.speed)
        for of in found.keeping
        if of.least is not None
        and of.variant.method in ("recalculate", "larsen", "dual-rate")
        and not of.variant.is_beside(Options())
    }
    assert got == expected
    best = {of.variant.method for of in found.best}
    assert best & {"recalculate", "larsen", "dual-rate"} == {name for _, _, name, _, _ in expected}


def test_without_delay_the_standard_filter_takes_part() -> None:
    found = choose_filter(4.0, CV, [0], N=10, M=0)
    names = [of.variant.method for of in found.best]
    assert "standard" in names
    assert "standard" not in [of.variant.method for of in choice(9.0).best]


def test_with_several_in_flight_those_that_bear_it_take_part() -> None:
    """Counted at 9 states: 14 steps late and measured every 10, one other is on its way at k."""
    found = choose_filter(9.0, CV, [0], N=10, M=14, methods=["larsen", "clone", "clone-split"], costs=["counted-9-3-3"])
    assert {of.variant.method: of.least.speed for of in found.best if of.least} == {
        "larsen": 3042 + 1377 + 3171,
        "clone": 3042 + 459 + 765 + 360,
    }
    (other,) = found.others
    assert other.variant.method == "clone-split"
    assert "one measurement is on its way at a time" in other.reason


@pytest.mark.parametrize("every", [2, 0, [0], [1.5], [], [True], "1"])
def test_every_is_whole_numbers(every: Any) -> None:
    for ask in (lambda: choice(9.0, every=every, costs=COSTS), lambda: compare_accuracy("ins-gps", every=every)):
        with pytest.raises(InputError, match=r"every is .*: give whole numbers of at least 1"):
            ask()


def test_parts_without_a_rate_are_refused_before_anything_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.selection.choose.tables_for", lambda *_: pytest.fail("counted"))
    with pytest.raises(InputError, match="processor without hr_hz"):
        choice(9.0, processors=["leon3"])


def test_a_unit_that_is_no_word_stays_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        'name = "mine"\nunit = "ms"\n[costs.larsen]\npropagate = 1\npropagate_accumulate = 2\nupdate = 3\n',
        encoding="utf-8",
    )
    assert "least speed in ms per HR period" in str(choice(9.0, costs=[str(tmp_path / "mine.toml")]))


@pytest.mark.parametrize("name", ["processors", "costs", "methods"])
def test_a_text_in_place_of_names_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=rf"{name} is 'larsen': give a list of names, \['larsen'\]"):
        choice(9.0, **{name: "larsen"})


def test_parts_as_they_are() -> None:
    found = choice(9.0, hr_hz=100, processors=[load_part("leon3"), "cortex-m4f"])
    assert {on.part.name for of in found.best for on in of.parts} == {"leon3", "cortex-m4f"}
    for of in found.best:
        assert of.cheapest is not None
        assert of.cheapest.std == pytest.approx(lossless(CV, [0], of.N, of.cheapest.landed or 0).worst, rel=0.01)


def test_a_users_own_system_is_counted() -> None:
    system = linear_system(Phi, np.zeros((2, 0)), CV.H, Q, CV.R)
    by_system, by_matrices = (choose_filter(9.0, model, [0], N=10, M=4) for model in (system, CV))
    assert [of.least for of in by_system.best] == [of.least for of in by_matrices.best]


def test_notebooks_show_it() -> None:
    found = choice(4.45)
    shown = found._repr_html_()
    assert "<table>" in shown
    assert "within 4.45" in shown
    assert all(of.variant.method in shown for of in (*found.best, *found.others))
    assert "at best" in shown
    assert "worst" in compare_accuracy(CV, [0], N=10, M=4)._repr_html_()


def test_what_is_printed_is_a_table() -> None:
    """Not the matrices; with what is below the table of the command."""
    found = choose_filter(0.38, "ins-gps", processors=["cortex-m0plus"])
    accuracies = compare_accuracy("ins-gps", methods=["larsen", "augmentation"], delay_ms=500)
    for shown in (str(found), repr(found), str(accuracies)):
        assert "array(" not in shown
        assert shown.splitlines()[1].split()[0] == "method"
        assert max(map(len, shown.splitlines()[:4])) < 180
    assert "too slow: cortex-m0plus" in str(found)
    assert "no part will do: cortex-m0plus" in str(found)
    assert "not px4-predictor: 0.3824 m at best" in str(found)
    assert "does not land" in str(accuracies)
    assert "augmentation: one measurement is on its way at a time" in str(accuracies)


@pytest.mark.exhaust
def test_the_front_is_what_no_other_design_beats() -> None:
    model = load_model("ins-gps", None)
    sampling = Sampling.of(shipped_model("ins-gps"))
    question = Question(model, outputs_of(model), sampling, 0.38, "worst", Conditions(), tables_for(model, None))
    points = front(question, ["recalculate", "larsen", "dual-rate"], (1, 2)).points
    best = [of for of in points if of.on_front]
    assert {of.every for of in best} == {1}
    assert {of.method for of in best} >= {"larsen", "dual-rate"}
    for of in points:
        better = [other for other in points if other.std <= of.std and other.speed <= of.speed and other is not of]
        assert of.on_front == all((other.std, other.speed) == (of.std, of.speed) for other in better)
    latest = chosen(question).best[0]
    assert latest.std is not None
    assert min(of.speed for of in points if of.std <= 0.38) == float(latest.least.speed if latest.least else 0)


def test_each_scheduled_method_of_a_late_measurement_has_an_accuracy() -> None:
    late = {name for name in SCHEDULED if not name.startswith(("multirate", "robust"))}
    assert late <= set(METHODS)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"within": 0}, "within is 0: it must be greater than 0"),
        ({"within": float("nan")}, "within is 'nan'"),
        ({"model": "nix"}, "model 'nix' is unknown"),
        ({"model": 3}, "model: model\\(\\) returned a int"),
        ({"output": [5]}, "output of shape \\(1,\\) is not of this model"),
        ({"output": [[0.0, 0.0]]}, "a row of zeros is no output"),
        ({"output": [[1.0, 0.0, 0.0]]}, "output of shape \\(1, 3\\)"),
        ({"output": [0, 1, 0]}, "state 0 is there twice"),
        ({"output": [[1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]}, "rows 0 and 2 are the same"),
        ({"N": 0}, "N is 0"),
        ({"N": 2.5}, "N is 2.5: give a whole number"),
        ({"M": -1}, "M is -1"),
        ({"metric": "mean"}, "metric 'mean' is unknown"),
        ({"methods": ["kalman"]}, "method 'kalman' is unknown"),
        ({"processors": ["leon3"]}, "processor without hr_hz"),
        ({"delay_ms": 5}, "need hr_hz"),
        ({"tau_s": -1}, "tau is -1"),
    ],
)
def test_what_cannot_be_is_named(arguments: dict[str, Any], said: str) -> None:
    given: dict[str, Any] = {"within": 9.0, "model": CV, "output": [0], "N": 10, "M": 4, "costs": COSTS} | arguments
    with pytest.raises(InputError, match=said):
        choose_filter(**given)


def test_of_parts_that_are_as_good_the_less_busy_is_first() -> None:
    part = load_part("leon3")
    needed = Fraction(1, 2)
    worse, better = (OnPart(part, needed, load, landed=4) for load in (Fraction(2, 5), Fraction(1, 5)))
    assert sorted([worse, better], key=by_cost)[0] is better
    priced = [replace(on, part=replace(part, price=Fraction(3))) for on in (worse, better)]
    assert sorted(priced, key=by_cost)[0] is priced[1]


def test_what_waits_for_one_measurement_is_told_once_with_what_would_do() -> None:
    """In the units that are known, every number of them true."""
    methods = ["augmentation", "delayed-horizon", "larsen"]
    in_time = {"model": "ins-gps", "delay_ms": 500, "methods": methods}
    late = "with delay_ms 500 (M 200) others are taken before it arrives, every 200 ms (N 80)"
    remedy = "choose method recalculate, larsen, clone, carried-gain or dual-rate, or every 3"
    of_both = {(of.variant.method, of.reason) for of in choose_filter(1, every=[1], **in_time).others}
    assert {reason for _, reason in of_both} == {f"one measurement is on its way at a time, and {late}: {remedy}"}
    rows = compare_accuracy(every=[1, 2, 3], **in_time).rows
    assert {row.every for row in rows if row.accuracy is None} == {1, 2}
    with pytest.raises(
        InputError, match=r"augmentation, delayed-horizon: .*every 2 steps \(N 2\): choose .*, or every 4$"
    ):
        compare_accuracy(CV, [0], N=2, M=7, methods=["augmentation", "delayed-horizon"])
    with pytest.raises(
        InputError, match=r"no step is left .* with M 4, every 4 steps \(N 4\): .* larsen, .* or every 2$"
    ):
        compare_accuracy(CV, [0], N=4, M=4, methods=["delayed-horizon"])


def test_a_bound_is_a_number() -> None:
    assert within_of("0.38") == 0.38


def test_where_rates_do_not_divide_the_least_speed_holds_for_the_intervals_as_they_come() -> None:
    """By hand: the HR job of step 27 has a measurement of its own, a landing, and two on their way."""
    found = choose_filter(
        9.0,
        "ins-gps",
        hr_hz=400,
        measurement_hz=30,
        delay_ms=67.5,
        methods=["larsen"],
        costs=["counted-9-3-3"],
        every=[1],
    )
    assert [of.least.speed for of in found.best if of.least] == [9390]
