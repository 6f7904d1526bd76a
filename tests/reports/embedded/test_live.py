"""Live runs in the report on boards: kept as tables, and said as they came out, whatever that is."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest

from reports.embedded.live import about_live, live_rows, live_tables, recorded
from reports.embedded.results import shipped
from reports.pages.stored import as_stored
from sched_sim.errors import InputError
from studies.embedded.stairs import CYCLES, SPEED, Record, design, judged, record
from studies.live.measure import Measured
from studies.live.stairs import through_two_steps

ABOUT = {"machine": "a desktop", "kernel": "Linux", "date": "2026-11-29", "core": "3"}


def runs(landed: Callable[[Measured], int | None], disturbed: int = 0, cycles_each: int = 60) -> Record:
    """Cycles at each speed, of which so many are disturbed; landed: where they land, given one that is right."""
    found = []
    for of in through_two_steps(design(cycles_each)):
        right = judged(of.speed, [(None, False)], 0, 0.0)
        cycles = [(landed(right), number < disturbed) for number in range(cycles_each)]
        found.append(judged(of.speed, cycles, 0, 0.01))
    return Record(found, judged(SPEED, [(None, False)] * 10, 0, 0.0), ABOUT)


def right(of: Measured) -> int:
    return of.predicted


def test_what_is_stored_is_read_back() -> None:
    of = runs(right, disturbed=1)
    again = recorded(as_stored(live_tables(of)))
    assert again == of
    assert again.swapped.achieved == [None] * 10


def test_every_word_is_said_as_it_is() -> None:
    assert about_live(runs(right))["words"] == "corrections land where they are predicted to"
    assert about_live(runs(lambda of: of.predicted + 1))["word"] == "disagrees"
    assert about_live(runs(right, disturbed=20))["words"] == "too much was taken from the core for a verdict"
    assert about_live(runs(right, cycles_each=10))["words"] == "the cycles are too few for a verdict"
    assert about_live(runs(right, disturbed=60))["far"] == "0 of 0 undisturbed cycles and 420 of all 420"


def test_speeds_too_few_alone_may_be_enough_together_and_that_is_said() -> None:
    found = about_live(runs(right))
    assert found["word"] == "agrees"
    assert found["far"] == "420 of 420 undisturbed cycles and 420 of all 420"
    assert found["verdicts"] == (
        "0 agree, 0 disagree, 7 are inconclusive (7 for too few cycles, 0 for too many disturbed ones), 5 are near a "
        "step and have no verdict"
    )


def test_one_speed_that_disagrees_or_is_disturbed_is_not_hidden_by_the_others() -> None:
    of = runs(right, cycles_each=400)
    first = next(run for run in of.runs if run.agreement.word == "agrees" and run.design.speed > Fraction(85, 100))
    wrong = first._replace(achieved=[first.predicted + 1] * 10 + first.achieved[10:])
    spoilt = first._replace(disturbed=[True] * 100 + first.disturbed[100:])
    for other, word, said in ((wrong, "disagrees", "6 agree, 1 disagree,"), (spoilt, "inconclusive", "1 are inconcl")):
        found = about_live(of._replace(runs=[other if run is first else run for run in of.runs]))
        assert found["word"] == word
        assert said in found["verdicts"]


def test_a_verdict_near_a_step_does_not_count() -> None:
    def right_but_near(of: Measured) -> int:
        near = Fraction(1, 100)
        steps = (Fraction(49, 60), Fraction(91, 100))
        return of.predicted + any(abs(of.design.speed / step - 1) <= near for step in steps)

    assert about_live(runs(right_but_near))["word"] == "agrees"
    verdicts = [row[-1] for row in live_rows(runs(right_but_near).runs)[1:]]
    assert set(verdicts) == {"inconclusive: few", "near"}
    assert {row[-1] for row in live_rows(runs(right, cycles_each=300).runs)[1:]} == {"agrees", "near"}


def test_the_record_that_ships_is_of_twelve_speeds_and_of_swapped_priorities_which_disagree() -> None:
    _, tables = shipped()
    of = recorded(tables)
    assert [run.design.speed for run in of.runs] == [each.speed for each in through_two_steps(design())]
    assert {run.design.cycles for run in of.runs} == {CYCLES}
    assert about_live(of)["word"] == "agrees"
    assert about_live(of)["swapped"] == "disagrees"
    assert about_live(of)["differing"] == 0


def test_without_the_right_there_is_no_record(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> None:
        raise InputError("live needs the right to real-time priorities")

    monkeypatch.setattr("studies.embedded.stairs.check_rights", refuse)
    with pytest.raises(InputError, match="right to real-time"):
        record()


def test_a_compiler_that_is_missing_is_a_fault_of_the_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.embedded.stairs.check_rights", lambda: None)
    monkeypatch.setattr("shutil.which", lambda _name: None)
    monkeypatch.delenv("CC", raising=False)
    with pytest.raises(InputError, match="live runs need a C compiler: install gcc or clang"):
        record()
