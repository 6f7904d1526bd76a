"""The committed report is what the code makes of the results stored in it, byte for byte, and what it says is true."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from reports.modular import build
from reports.modular_costs import OPERATIONS
from reports.modular_results import TABLES, Results, read
from studies import late_measurements, modular_costs
from tests.command_line import Run
from tests.reports import published


@cache
def stored() -> Results:
    return read(published.FOLDER / "modular")


@cache
def rebuilt() -> dict[str, bytes]:
    return build(stored())


def text() -> str:
    return published.text(rebuilt())


def rows(name: str) -> list[dict[str, str]]:
    return published.rows(rebuilt(), name)


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("modular", rebuilt())
    published.is_self_contained(rebuilt())


def test_the_page_is_not_too_large() -> None:
    assert len(rebuilt()["index.html"]) < 1_500_000


@pytest.mark.parametrize("name", published.names("modular"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("modular", name, rebuilt())


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.modular_results.results", lambda _thorough, _progress: stored())
    monkeypatch.setattr("reports.modular.build", lambda found: rebuilt() if found is stored() else {})
    published.is_written("modular", rebuilt(), sched_sim, tmp_path)


def test_what_is_stored_is_read_back() -> None:
    assert set(stored().tables) == set(TABLES)
    for name, content in stored().files().items():
        assert content == (published.FOLDER / "modular" / name).read_bytes()


# ---------------------------------------------------------------------------------------------- what the text claims


def test_dropout_of_80_percent_is_felt() -> None:
    """In every reading but one the residual grows; in the last it falls."""
    error, innovation, after = rows("claim.csv")
    assert all(3 < float(error[name]) < 6 for name in ("position", "velocity", "acceleration"))
    assert 1.4 < float(innovation["position"]) < 1.6
    assert float(innovation["acceleration"]) > 2.5
    assert float(after["position"]) < 0.7
    errors = [float(row["position"].split(" ± ")[0].replace(",", "")) for row in rows("dropout.csv")]
    assert errors == sorted(errors)


def test_what_decides_is_the_time_between_measurements() -> None:
    of = {row["In a period"]: row for row in rows("rates.csv")}
    assert float(of["20"]["error at 80 %"]) > 100
    assert float(of["400"]["error at 80 %"]) < 3
    assert all(float(row["times"]) > 2.1 for row in of.values())
    assert of["100"]["borne, %"] == "80.0"


def test_where_its_model_is_true_the_filter_is_as_accurate_as_it_says() -> None:
    for row in rows("consistency.csv"):
        if row["Filter"] == "usual, its own model true":
            assert float(row["inside, %"]) > 90
            assert float(row["NEES"]) == pytest.approx(3, abs=0.15)
        if row["Filter"] == "usual":
            assert float(row["NEES"]) < 2.54


def test_the_run_that_is_drawn_is_half_dropped() -> None:
    run = stored().columns("oscillator")
    for name in ("position", "acceleration"):
        assert np.isnan(run[f"{name} measured"]).mean() == pytest.approx(0.5, abs=0.08)


def test_position_keeps_to_the_claim_on_the_rocket_and_each_axis_does_not() -> None:
    of = {row["Residual"]: row for row in rows("readings.csv")}
    assert float(of["position / distance from the pad"]["all, from s"]) < 0.6
    assert of["position / distance from the pad"]["hold, %"] == "100"
    assert float(of["worst axis / its coordinate"]["hold, %"]) < 60
    assert of["orientation / all turned"]["hold, %"] == "100"
    assert float(of["orientation / net turn"]["hold, %"]) < 100
    assert float(of["nose / turn of the nose"]["hold, %"]) < 100


def test_the_extended_predictor_does_as_well() -> None:
    of = {row["Filter"]: row for row in rows("rocket-errors.csv")}
    for one, other in (("unscented", "extended"), ("dropout 95 %", "extended, dropout 95 %")):
        for name in ("position", "velocity", "acceleration", "turn rate", "orientation"):
            assert float(of[one][name]) == pytest.approx(float(of[other][name]), rel=0.005)


def test_the_filter_is_surprised_by_thrust_alone() -> None:
    means = {row["Phase"]: float(row["dropout 0 %"].split(" ± ")[0]) for row in rows("rocket-nees.csv")}
    assert all(12 < mean < 17.5 for mean in means.values())
    onset = stored().records("rocket-nees", case="unscented", phase="thrust onset", of="acceleration")
    assert [float(row["mean"]) > 4 for row in onset] == [True]


def test_what_ignoring_a_delay_costs() -> None:
    of = {(row["Sensors"], row["Way"]): row for row in rows("late.csv")}
    both, alone = "position, acceleration", "position"
    assert float(of[both, "as new"]["10 late"]) > 6 * float(of[both, "recalculate"]["10 late"])
    assert float(of[alone, "as new"]["2 late"]) < float(of[alone, "recalculate"]["2 late"])
    for sensors in (both, alone):
        for name in (f"{delay} late" for delay in (0, 2, 4, 6, 8, 10)):
            larsen, recalculate = (float(of[sensors, way][name]) for way in ("larsen", "recalculate"))
            assert larsen == pytest.approx(recalculate, rel=0.01)
    assert len({of[alone, "dual-rate"][f"{delay} late"] for delay in (0, 2, 4, 6, 8)}) == 1


def test_linear_and_extended_cost_the_same() -> None:
    of = {(row["Filter"], row["Part"]): row for row in rows("parts.csv")}
    for part in ("predict", "correct"):
        for n in (3, 6, 9, 15):
            linear, extended, unscented = (
                int(of[kind, part][f"n = {n}"].replace(",", "")) for kind in ("linear", "extended", "unscented")
            )
            assert extended == pytest.approx(linear, rel=0.06)
            assert 1.3 < unscented / extended < 3


def test_the_stored_counts_are_those_of_the_code() -> None:
    counted = {key: str(number) for key, number in modular_costs.operations().items()}
    assert {(r["kind"], r["states"], r["part"]): r[OPERATIONS] for r in stored().records("parts")} == counted
    for row in stored().records("late"):
        work = late_measurements.work(row["sensors"], row["way"], int(row["delay"]))
        assert (row["mean"], row["longest"]) == (f"{work.mean:.1f}", str(work.longest))


def test_another_machine_changes_only_what_is_marked_as_measured() -> None:
    """Other times: in tables and text only what has the mark changes, and no figure but the one that shows times."""
    tables = dict(stored().tables)
    heading, *body = tables["parts"]
    times = [number for number, head in enumerate(heading) if "†" in str(head)]
    tables["parts"] = [heading]
    for at, row in enumerate(body):
        cells = enumerate(row)
        tables["parts"].append([f"{float(cell) * (2 + at % 3):.3g}" if n in times else cell for n, cell in cells])
    tables["machine"] = [tables["machine"][0], ["another", "now", "none", "none"]]
    heading, *body = tables["schedule-misses"]
    at = heading.index("times_slower")
    tables["schedule-misses"] = [heading, *([*row[:at], 2 * int(row[at]), *row[at + 1 :]] for row in body)]
    other = build(stored()._replace(tables=tables))
    published.differs_only_where_marked(rebuilt(), other, ["parts.svg", "misses.svg", "one-fix.svg"])


def test_recalculating_in_the_loop_is_late_on_an_idle_processor() -> None:
    of = {(row["Late fix"], row["correction"]): row for row in rows("processors.csv")}
    (busy,) = [head for head in rows("processors.csv")[0] if head.startswith("busy")]
    loop, held = "loop, % †", "holds to †"
    assert float(of["recalculate, extended", "in the loop"][busy]) < 50
    assert float(of["recalculate, extended", "in the loop"][loop]) > 1
    assert float(of["recalculate, extended", "preempted"][loop]) < 1
    holds = [int(of["recalculate, extended", "in the loop"][held]), int(of["recalculate, extended", "preempted"][held])]
    assert holds[0] < holds[1] < int(of["larsen, extended", "preempted"][held])
    assert int(of["recalculate, unscented", "preempted"][held]) <= holds[1]
