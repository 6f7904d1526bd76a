"""The committed report is what the code makes of the studies, byte for byte, and what it says is true of them."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from reports.accuracy import tables
from reports.accuracy.report import build
from reports.accuracy.results import Results, results
from reports.accuracy.words import MODELS, deviation, more, percents, plain_name, unbroken
from studies.accuracy.given import given
from studies.accuracy.scale import EXACT, SUMMED, cheapest, earliest
from studies.accuracy.slow_processor import at_speeds
from tests.command_line import Run
from tests.reports import published

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
    published.is_complete("accuracy", rebuilt())
    published.is_self_contained(rebuilt())


@pytest.mark.parametrize("name", published.names("accuracy"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("accuracy", name, rebuilt())


def test_progress_is_told_from_start_to_end() -> None:
    found()
    assert [(done, 4) for done in range(5)] == TOLD


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.accuracy.results.results", lambda _progress: found())
    published.is_written("accuracy", rebuilt(), sched_sim, tmp_path)


def test_landing_later_costs_what_was_found_before() -> None:
    """To the digits of ACCURACY, at its foot."""
    costs = rows("costs.csv")
    waiting = [float(row["at the next fix, %"]) for row in costs]
    second = [float(row["every 2nd, %"]) for row in costs]
    decimals = (1, 1, 2, 1)
    assert [f"{cost:.{n}f}" for cost, n in zip(waiting, decimals, strict=True)] == ["3.7", "13.8", "0.09", "27.6"]
    assert [f"{cost:.0f}" for cost in second] == ["36", "44", "22", "83"]
    assert [row["rule, %"] for row in costs] == ["8.48", "36.3", "0.151", "108"]
    assert all(float(row["rule, %"]) > cost for row, cost in zip(costs, waiting, strict=True))


def test_in_short() -> None:
    for said in (
        "Used 872.5 ms (GPS), 377.5 ms (RTK) or 80 ms (camera)",
        "of the star tracker even 50 s after",
        "but 24.4 % for a camera at 2 Hz; if that lands on arrival, 30 ms late, 33.3 %",
        "is off by 1.65 m at 15 m/s and 110 ms",
        "+2.53 % (GPS) and +13.2 % (RTK) in the worst step, +5.72 and +27.7 % in the root mean square",
        "at a speed of 6 HR jobs per HR period the camera's worst standard deviation falls from 22.0 to 14.9 mm",
        "stochastic cloning needs 0.839 times what the standard filter needs without delay",
        "Larsen 1.55, recalculating 31.2",
        "landing at L = 53 instead of 44, needs 0.412",
        "a processor of speed 6 uses every 2nd frame, landing at L = 6: 22.0 mm",
        "landing at L = 6 too: 14.9 mm, 32.3 % less. With one in flight that takes a speed of 11",
    ):
        assert said in text()


def test_the_answer_is_short_and_begins_the_report() -> None:
    title, answer, figure, *_ = rebuilt()["index.md"].decode().split("\n\n")
    assert title.startswith("# ")
    assert answer.startswith("**Answer.** ")
    assert len(answer.split()) <= 50
    assert figure.endswith("(answer.svg)")


def test_the_answer_is_that_of_the_table_of_costs() -> None:
    costs = [{name: float(row[name]) for name in ("at the next fix, %", "every 2nd, %")} for row in rows("costs.csv")]
    assert all(row["at the next fix, %"] < row["every 2nd, %"] / 2 for row in costs)
    costs.sort(key=lambda row: row["every 2nd, %"])
    for said, of in (
        (r"([\d.]+) against ([\d.]+) % \(star tracker\)", costs[0]),
        (r"([\d.]+) against ([\d.]+) % \(camera\)", costs[-1]),
    ):
        ((waiting, second),) = re.findall(said, text())
        assert [float(waiting), float(second)] == pytest.approx(list(of.values()), rel=0.05)


def test_numbers_for_who_reads_in_a_hurry_have_two_digits() -> None:
    answer = text().partition("**Answer.** ")[2].partition(" ![")[0]
    assert all(len(found.replace(".", "").lstrip("0")) <= 2 for found in re.findall(r"[\d.]*\d", answer))


def test_columns_of_numbers_hold_nothing_else() -> None:
    """Else they would be aligned left, in the table of methods."""
    for row in rows("methods.csv"):
        for name in ("lands at L", "after, ms", "worst, m", "least power", "over standard"):
            assert row[name] == "-" or float(row[name].replace(",", "")) >= 0


def test_a_processor_that_cannot_keep_up_skips_frames() -> None:
    """As the text says beside its claim that skipping buys nothing."""
    skipped = {float(row["Speed"]) for row in rows("slow-processor.csv") if int(row["several: n"]) > 1}
    assert skipped
    assert max(skipped) < 6
    assert "cannot keep up with the fixes has to skip some" in text()


def test_every_second_fix_is_above_every_fix_wherever_both_land() -> None:
    worst = {(row["model"], row["every"], row["L"]): float(row["worst"]) for row in rows("all-landings.csv")}
    both = [key for key in worst if key[1] == "2" and (key[0], "1", key[2]) in worst]
    assert {model for model, _, _ in both} == set(MODELS)
    assert all(worst[key] > worst[key[0], "1", key[2]] for key in both)


def test_the_least_power_is_of_the_dual_rate_filter_and_on_arrival_of_stochastic_cloning() -> None:
    for name, placed in found().placed.items():
        every = [place for place in placed if place.every == 1]
        assert min(every, key=lambda place: place.speed).method == SUMMED
        arrived = [place for place in every if place.method in EXACT and place.lands == given(name).M]
        assert min(arrived, key=lambda place: place.speed).method in ("clone", "clone-split")


def test_one_frame_in_flight_uses_every_frame_only_from_the_speed_that_is_said_on() -> None:
    alone = {int(row["one: n"]) for row in rows("slow-processor.csv") if float(row["Speed"]) < 11}
    assert min(alone) == 2
    assert {row["one: n"] for row in rows("slow-processor.csv") if float(row["Speed"]) >= 11} == {"1"}


def test_the_two_tables_of_methods_are_all_of_the_file() -> None:
    whole = tables.methods(found())
    one, other = tables.shown_methods(whole)
    assert [len(row) for row in (one[0], other[0])] == [7, 5]
    assert {*one[0], *other[0]} == {*whole[0]}
    assert [row[0] for row in one] == [row[0] for row in whole]
    assert other[1][1:] == [whole[1][4], *whole[1][7:]]


def test_what_the_text_claims_without_a_number() -> None:
    """Later is better than fewer, nothing that skips is best for its power, and what is late is worth nothing alone."""
    for name, landing in found().landings.items():
        assert landing.waiting < landing.leaving_out(2)
        assert not [place for place in found().placed[name] if place.every > 1 and place.on_front]
        assert found().approximations[name].discarded.verdict == "diverges"
    fresh = found().approximations["ins-gps"].fresh
    assert fresh.believed is not None
    assert fresh.believed < 0.25 * fresh.total


def test_the_table_of_methods_is_that_of_their_designs() -> None:
    least, first = cheapest(found().placed["ins-gps"]), earliest(found().placed["ins-gps"])
    *methods, nothing = rows("methods.csv")
    assert nothing["verdict"] == "diverges: no bound"
    by_name = {plain_name(name): name for name in least}
    assert {row["Method"] for row in methods} == set(by_name)
    powers = [float(row["least power"]) for row in methods]
    assert powers == sorted(powers)
    for row, power in zip(methods, powers, strict=True):
        place = least[by_name[row["Method"]]]
        assert 0 <= power - place.speed < 1
        assert int(row["lands at L"]) == place.lands
        assert float(row["after, ms"]) == 2.5 * place.lands
        assert float(row["worst, m"]) == pytest.approx(place.accuracy.total, rel=5e-4)
        assert int(row["first at L"]) == first[by_name[row["Method"]]].lands
    assert {row["Method"]: row["textbook update"] for row in methods}["Larsen"] == "9687"


def test_exact_methods_that_land_on_arrival_are_equally_accurate_and_those_that_are_named_do() -> None:
    of = {row["Method"]: row for row in rows("methods.csv") if row["verdict"] == "exact"}
    arrived = {name: row["worst, m"] for name, row in of.items() if row["lands at L"] == "44"}
    assert {"Recalculate", "Larsen", "Stochastic cloning", "Carried gain"} <= arrived.keys()
    assert len(set(arrived.values())) == 1
    assert {name: row["lands at L"] for name, row in of.items() if name not in arrived} == {
        "Delayed horizon": "48",
        "Dual-rate": "53",
    }


def test_the_speed_that_a_landing_needs_is_that_of_the_text() -> None:
    assert all(of.speed == max(1 + Fraction(20, of.L - 2), 1 + Fraction(20, 4 * of.every)) for of in found().choices)
    assert "needs the speed 1 + 20 / (L − 2), and at least 1 + 20 / (4 n) to keep up" in text()


def test_verdicts() -> None:
    verdicts = {row["Method"]: row["verdict"] for row in rows("methods.csv")}
    assert verdicts["Dual-rate, Q′"] == "approximate: < 0.001 %"
    assert verdicts["PX4 output predictor"] == "approximate: +2.53 %, rms +5.72 %"
    assert verdicts["Fuse as fresh"] == "wrong: biased by 1.65 m at 15 m/s"
    assert verdicts["Carried gain"] == verdicts["Dual-rate"] == "exact"


def test_powers_of_each_model() -> None:
    for row in rows("powers.csv"):
        for name, cell in zip(MODELS, [*row.values()][1:], strict=True):
            place = next(one for key, one in cheapest(found().placed[name]).items() if plain_name(key) == row["Method"])
            assert cell.endswith(f"({place.lands})")


def test_uncompensated_corrections_are_unstable_for_the_camera() -> None:
    verdicts = {row["Model"]: row["verdict"] for row in rows("in-flight.csv")}
    assert [name for name, verdict in verdicts.items() if verdict == "unstable"] == ["Camera"]


def test_the_table_of_the_slow_processor_is_of_the_choices() -> None:
    best = at_speeds(found().choices)
    for row in rows("slow-processor.csv"):
        speed = max(known for known in best if known <= float(row["Speed"]))
        alone, several = best[speed]
        assert alone is not None
        assert (int(row["one: n"]), int(row["one: L"])) == (alone.every, alone.L)
        assert (int(row["several: n"]), int(row["several: L"])) == (several.every, several.L)
        assert (row["better by, %"] == "-") == (alone == several)


def test_designs_and_landings_are_all_there() -> None:
    assert len(rows("all-designs.csv")) == sum(len(placed) for placed in found().placed.values())
    curves = [curve for landing in found().landings.values() for curve in landing.curves.values()]
    assert len(rows("all-landings.csv")) == sum(len(curve.landings) for curve in curves)
    assert len(rows("all-choices.csv")) == len(found().choices)


def test_figures_as_they_are_written() -> None:
    assert deviation("star-tracker", 4.8e-6) == "4.80 µrad"
    assert deviation("ins-gps", float("inf")) == "no bound"
    assert [percents(share) for share in (0.5, 1e-6, float("inf"))] == ["50.0", "< 0.001", "no bound"]
    assert [more(share) for share in (0.025, 1e-6, 1e-15)] == ["+2.50 %", "< 0.001 %", "+0 %"]
    assert unbroken([["1.65 m", "< 0.001 %", "dual-rate", "INS, GPS 0.5 m"]]) == [
        [cell.replace("~", "\N{NO-BREAK SPACE}") for cell in ("1.65~m", "<~0.001~%", "dual-rate", "INS, GPS~0.5~m")]
    ]


def test_a_claim_that_no_longer_holds_is_not_printed() -> None:
    landings = dict(found().landings)
    camera = landings["camera"]
    landings["camera"] = camera._replace(skipping={**camera.skipping, 2: camera.at_arrival})
    with pytest.raises(ValueError, match="lose least and most by leaving out"):
        build(found()._replace(landings=landings))
