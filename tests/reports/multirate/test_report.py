"""The committed report is what the code makes of the studies, byte for byte, and what it says is true of them."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from reports.multirate import tables
from reports.multirate.costs import every, least_time_of, our_forms, patents_form, time_of
from reports.multirate.limits import limits
from reports.multirate.report import build
from reports.multirate.results import PERIODS, SHOWN, N, Results, results
from reports.multirate.said import beaten_from
from reports.multirate.words import VEHICLE_SYSTEMS, reading_text, scenario_text
from sched_sim.design.load import utilization
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.multirate import patent
from studies.multirate.accuracy import ACCELERATION_NOISES, GOOD, Reading, largest_good
from studies.multirate.limit import tending
from tests.command_line import Run
from tests.reports import published

pytestmark = pytest.mark.exhaust  # the study takes 20 s; `studies/multirate` has its tests

TOLD: list[tuple[int, int]] = []
"""(done, total), as `found` went on."""


@cache
def found() -> Results:
    return results(lambda done, total, _what: TOLD.append((done, total)))


@cache
def rebuilt() -> dict[str, bytes]:
    return build(found())


def text() -> str:
    return published.text(rebuilt())


def rows(name: str) -> list[dict[str, str]]:
    return published.rows(rebuilt(), name)


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("patent-multirate", rebuilt())
    published.is_self_contained(rebuilt())


@pytest.mark.parametrize("name", published.names("patent-multirate"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("patent-multirate", name, rebuilt())


def test_progress_is_told_from_start_to_end() -> None:
    found()
    total = TOLD[-1][1]
    assert [(done, total) for done in range(total + 1)] == TOLD


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.multirate.results.results", lambda _progress: found())
    published.is_written("patent-multirate", rebuilt(), sched_sim, tmp_path)


def test_an_unknown_report_is_answered_with_both_names(sched_sim: Run) -> None:
    result = sched_sim("report patent")
    assert result.code == 2
    assert "steffes2014" in result.err
    assert "patent-multirate" in result.err


def test_the_three_cases_are_those_of_the_patent() -> None:
    """Their loads from n and rate, by the job costs, are those that the study has from the printed counts."""
    costs = least_time_of(patents_form(), load_part("patent"))
    cases = zip(tables.CASES, patent.loads(), strict=True)
    for case, printed in cases:
        assert 100 * utilization(costs, every(case.n), 1 / case.rate_hz) == printed.complete_percent
    assert [row["computed, %"] for row in rows("loads.csv")] == ["4.17", "16.69", "4.10"]
    assert [row["with state update, %"] for row in rows("loads.csv")] == ["4.36", "17.45", "4.10"]


def test_the_answer_is_short_and_begins_the_report() -> None:
    title, answer, figure, *_ = rebuilt()["index.md"].decode().split("\n\n")
    assert title.startswith("# ")
    assert answer.startswith("**Answer.** ")
    assert len(answer.removeprefix("**Answer.** ").split()) <= 50
    assert figure.endswith("(answer.svg)")


def test_the_limit_holds_from_the_n_that_is_said_on() -> None:
    """By the table of loads, for the patent's counts and for each form."""
    loads = {int(row["n"]): row for row in rows("load-by-n.csv")}
    for row in rows("limit-by-form.csv"):
        (column,) = [name for name in row if name.startswith("within")]
        least = int(row[column].removeprefix("n = "))
        name = row["Counts and form"]
        assert all((float(load[name]) <= patent.LIMIT_PERCENT) == (n >= least) for n, load in loads.items())
        assert row["load there, %"] == loads[least][name]
        assert row["load at n = 1, %"] == loads[1][name]
    assert (loads[4]["the patent's counts"], loads[3]["the patent's counts"]) == ("4.93", "6.32")
    assert "that asks for n = 4 or more" in text()


def test_a_square_root_may_take_as_long_as_is_said() -> None:
    """By the table of loads without them: what is left of 5 % in n seconds, for each of a form's square roots."""
    longest = []
    for row in rows("limit-by-form.csv"):
        roots = {f"≥ {form.name}": form.square_roots for form in our_forms().values()}.get(row["Counts and form"])
        if roots:
            n = int(row["within 5 % from"].removeprefix("n = "))
            longest.append(10 * n * (patent.LIMIT_PERCENT - float(row["load there, %"])) / roots)
    assert len(longest) == 2
    assert f"no more than {int(10 * min(longest)) / 10:g} ms, as long as {int(min(longest) / 0.03)} of the" in text()


def test_only_a_receiver_that_hardly_manoeuvres_has_an_n_for_both_limits() -> None:
    good = {row["System"]: int(row["good to n"]) for row in rows("steady.csv") if row["System"].startswith("receiver")}
    assert [name for name, n in good.items() if n >= 4] == ["receiver 0.05, calm"]
    assert "Both limits are kept for calm only." in text()
    assert f"up to n = {said_of_three(good.values())}" in text()


def test_the_answer_is_that_of_the_tables() -> None:
    loads = {row["n"]: row["the patent's counts"] for row in rows("load-by-n.csv")}
    times = [f"{settled(system, 'averaged')[4]:.3g}" for system in VEHICLE_SYSTEMS.values()]
    assert f"only every 4th step: load falls from {loads['1']} to {loads['4']} %" in text()
    assert f"position variance is {times[0]} times the optimum" in text()
    assert f"On the road it is {times[1]} times, in turning aircraft {times[2]}." in text()


def said_of_three(values: Iterable[object]) -> str:
    calm, road, aircraft = values
    return f"{calm} (calm), {road} (road) and {aircraft} (aircraft)"


def settled(system: str, reading: Reading) -> dict[int, float]:
    """Ratios of the table by n, the gain in use at once."""
    asked = (scenario_text(system), reading_text(reading), "0")
    of = [row for row in rows("accuracy.csv") if (row["system"], row["filter"], row["L"]) == asked]
    return {int(row["n"]): float(row["steady_mean"]) for row in of}


def test_systems_and_filters_have_one_name_in_all_tables_and_on_the_page() -> None:
    accuracies = rows("accuracy.csv")
    assert {row["system"] for row in accuracies} == {row["System"] for row in rows("steady.csv")}
    for name in {row["filter"].partition(",")[0].partition(":")[0] for row in accuracies}:
        assert f"**{name.capitalize()}" in text()


def test_from_which_n_on_skipping_measurements_is_better() -> None:
    """Of each receiver, by the table: it was said of the aircraft alone."""
    said = {"calm": None, "road": 17, "aircraft": 7}
    for (vehicle, system), first in zip(VEHICLE_SYSTEMS.items(), said.values(), strict=True):
        averaged, skipped = settled(system, "averaged"), settled(system, "skipped")
        better = [n for n in averaged if skipped[n] < averaged[n]]
        assert (better[0] if better else None) == first == beaten_from(found(), system), vehicle
    assert "on the road from n = 17 on and in the aircraft from n = 7 on" in text()


def test_in_short() -> None:
    for said in (
        "takes 4.10 % of its processor instead of 17.45 %. The highest rate rises from 5.7 Hz to 24.4 Hz, if",
        "1.053 (calm), 1.449 (road) and 3.590 (aircraft) times the optimum. The patent",
        "rises to 144 times the optimum. A gain in each of the first 20 steps keeps it within 1.136 times.",
        "1.619 (calm), 2.396 (road) and 5.137 (aircraft) times the optimum",
        "11 of the 12 processors that come with this project, with at most 37 % load, but not on the patent's own (",
        "of its 4.10 % the state updates alone take 0.76 %",
    ):
        assert said in text()


def test_a_settled_gain_is_constant_and_one_after_the_start_is_not() -> None:
    table = rows("constancy.csv")
    largest = max(float(row["settled"].removeprefix("< ")) for row in table)
    assert f"nearly constant, as the patent says: within {largest:.2g} % in 5 steps" in text()
    assert f"that of a state changes by at most {largest:.2g} % of itself" in text()
    receivers = [row for row in table if row["System"].startswith("receiver")]
    assert all(float(row["from step 0"]) == 100 and float(row["from step 10"]) > 5 for row in receivers)
    assert f"by less than 5 % from step {said_of_three(row['below 5 % from step'] for row in receivers)} on" in text()
    assert all(f"{row['from step 10']} % ({row['System'].partition(', ')[2]})" in text() for row in receivers)


def test_the_divided_gain_is_too_small_where_the_loss_is_large() -> None:
    """Of each receiver; by the table of gains."""
    last = rows("gains.csv")[-1]
    for name in ("receiver 0.05, calm", "receiver 0.3, road", "receiver 1, aircraft"):
        assert float(last[f"{name}, divided"]) < 0.7 * float(last[f"{name}, optimal"])
    assert "should believe 0.19 (calm), 0.33 (road) and 0.52 (aircraft) of an innovation" in text()
    assert "and believe 0.13 (calm), 0.17 (road) and 0.19 (aircraft)." in text()


def test_a_shorter_time_between_gains_makes_the_division_exact_and_more_measurements_do_not() -> None:
    more, faster = rows("more.csv"), rows("faster.csv")
    vehicles = ("calm", "road", "aircraft")
    for name in vehicles:
        assert [float(row[name]) for row in more] == sorted(float(row[name]) for row in more)
        assert float(more[-1][name]) > float(more[0][name]) == 1.0
        assert [float(row[name]) for row in faster] == sorted((float(row[name]) for row in faster), reverse=True)
        assert float(faster[-1][name]) == 1.0
    assert float(faster[-1]["aircraft, with R"]) > 1.3
    fixed = {
        row["divided gain, R/n"] for row in rows("limits.csv") if row["receiver"] == "aircraft" and row["n"] != "5"
    }
    assert {f"{float(value):.3f}" for value in fixed} == {"0.269"}


def test_from_the_rate_that_is_said_on_five_is_good_and_the_limit_is_lost() -> None:
    rates = limits().least_hz
    for vehicle, noise in zip(rates, ACCELERATION_NOISES, strict=True):
        assert tending(noise, float(1 / rates[vehicle]), N).averaged_ratio <= GOOD
        assert tending(noise, float(1 / (rates[vehicle] - Fraction(1, 10))), N).averaged_ratio > GOOD
    said = said_of_three(f"{float(hz):g}" for hz in rates.values())
    calm, road, aircraft = (f"{4.1004 * float(hz):.3g}" for hz in rates.values())
    assert f"from {said} measurements a second on, at {calm}, {road} and {aircraft} % load" in text()


def test_late_are_as_many_state_updates_as_the_schedule_lists() -> None:
    late = [
        row
        for row in rows("rates.csv")
        if [row[key] for key in ("schedule", "work", "late")] == ["One loop", "SU", "yes"]
    ]
    assert f"covariance and gain are late, and {len(late)} of {N} state updates" in text()


def test_what_the_text_claims_without_a_number() -> None:
    """R is nowhere right, and for the aircraft no better than skipping; nothing is good beyond the rule."""
    for name, share in found().shares.items():
        averaged, sampled = (found().of(name, reading) for reading in ("averaged", "sampled"))
        assert all(a.steady_mean < b.steady_mean for a, b in zip(averaged, sampled, strict=True) if a.n > 1)
        assert largest_good(averaged) <= tables.rule(share)
        assert all((row.n - 1) * share <= tables.RULE for row in averaged if row.steady_mean <= GOOD)
    assert found().at("gps 1", "sampled", 5).steady_mean > found().at("gps 1", "skipped", 5).steady_mean
    skipped, averaged = (found().of("gps 1", reading) for reading in ("skipped", "averaged"))
    better = {n: one.steady_mean < other.steady_mean for n, one, other in zip(PERIODS, skipped, averaged, strict=True)}
    assert [n for n in PERIODS if n > 1 and better[n]] == list(range(7, 21))
    assert "from n = 7 on skipping is better" in text()


@pytest.mark.parametrize("name", ["random walk 0.0001", "random walk 0.001"])
def test_slow_random_walks_lie_on_the_curve_of_the_rule(name: str) -> None:
    for row in found().of(name, "averaged"):
        spent = (row.n - 1) * found().shares[name]
        if spent <= tables.RULE:
            assert row.steady_mean - 1 == pytest.approx(spent**2 / 8, rel=0.1)


def test_starts_with_no_step_at_full_rate_are_the_runs_of_the_study() -> None:
    for n in SHOWN:
        study = found().at("gps 0.05", "averaged", n)
        assert found().starts[n][0] == pytest.approx(study.worst, rel=1e-9)
        assert found().courses[n].max() == pytest.approx(study.worst, rel=1e-9)
        assert int(found().courses[n].argmax()) == study.worst_step


def test_no_step_is_named_where_all_ratios_are_alike() -> None:
    named = [row["worst_step"] for row in rows("accuracy.csv") if row["n"] == "1" and row["L"] == "0"]
    assert set(named) == {"-"}


def test_every_processor_has_a_verdict_on_every_form() -> None:
    of = rows("processors.csv")
    assert [row["Processor"] for row in of] == [name for name in shipped_parts() for _ in range(4)]
    verdicts = {row["runs"] for row in of}
    assert verdicts == {"yes", "no", tables.NO_SQRT}
    for row in of:
        missing = row["runs"] == tables.NO_SQRT
        assert missing == (row["load, %"] == "-") == (row["highest, Hz"] == "-")


def test_a_processor_without_square_root_has_no_time_for_a_form_that_needs_it() -> None:
    part = load_part("patent")
    for form in our_forms().values():
        assert (time_of(form, part) is None) == (form.square_roots > 0)
        assert least_time_of(form, part).covariance_gain > 0
