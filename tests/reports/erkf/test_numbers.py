"""The numbers in the sentences of the report on the robust filter are those of its tables."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from reports.erkf import counts as ways
from reports.pages.numbers import power
from studies.robust.costs import HR_HZ, SYSTEMS
from tests.reports.erkf.page import costs_of, rebuilt, rows, stored, text

pytestmark = pytest.mark.exhaust  # the report has to be made

REPRODUCED = Path(__file__).parents[3] / "docs" / "reproduced.md"


def ratios(way: str, reference: str, digits: int) -> str:
    """Of the operations of two ways, with finite mu: "4.3 and 4.6", or "1.21" where both are the same."""
    found = (costs_of(way, system) / costs_of(reference, system) for system in SYSTEMS)
    return " and ".join(dict.fromkeys(f"{ratio:.{digits}f}" for ratio in found))


def test_operations() -> None:
    for sentence in (
        f"({ratios(ways.REPEATED, ways.PER_COLUMN, 2)} times fewer operations)",
        f"One QR for all columns takes {ratios(ways.GIVENS, ways.INVERSE, 2)} times as many operations",
        f"a QR for each column, {ratios(ways.PER_COLUMN, ways.INVERSE, 1)} times",
        f"Givens takes {ratios(ways.GIVENS_NATURAL, ways.GIVENS_ORDERED, 1)} times fewer than in the natural one",
        f"and {ratios(ways.INVERSE, ways.GIVENS_ORDERED, 1)} times fewer than the dense inverse",
        f"Givens takes {ratios(ways.GIVENS_ORDERED, ways.LU_ORDERED, 1)} times as many as LU",
        f"and {ratios(ways.GIVENS_ORDERED, ways.CLOSED, 1)} times as many as the closed form",
        f"that takes {ratios(ways.CLOSED, ways.KALMAN, 2)} times what a dense Kalman filter does",
        f"In the better order they take {ratios(ways.HOUSEHOLDER_ORDERED, ways.GIVENS_ORDERED, 2)}, "
        f"and dense {ratios(ways.HOUSEHOLDER, ways.GIVENS, 2)}.",
        f"({ratios(ways.FADDEEV, ways.LU, 2)} dense)",
        f"{costs_of(ways.INVERSE, 'position'):,} operations by a dense inverse",
        f"{costs_of(ways.CLOSED, 'position'):,} in closed form",
    ):
        assert sentence in text()
    natural = [
        costs_of(ways.GIVENS_NATURAL, column) / costs_of(ways.INVERSE_SKIPPING, column)
        for column in ("attitude, μ = ∞", "attitude", "position, μ = ∞", "position")
    ]
    assert min(natural) < 1 < max(natural)
    assert f"Givens takes {min(natural):.2f} to {max(natural):.2f} times as many, by system and μ." in text()


def test_processors_in_parallel() -> None:
    by_schedule = {(row["System"], row["Schedule"]): row for row in rows("parallel.csv")}
    dense, _, ordered = ways.SCHEDULES

    def both(schedule: str, column: str) -> str:
        return " and ".join(f"{int(by_schedule[system, schedule][column]):,}" for system in SYSTEMS)

    def units(schedule: str, system: str) -> int:
        return int(by_schedule[system, schedule]["P = 1"])

    skipping = " and ".join(f"{units(dense, system) / units(ordered, system):.0f}" for system in SYSTEMS)
    assert f"Dense, 1024 processors are {both(dense, 'speed-up')} times as fast as one" in text()
    assert f"skips zeros in a good order is already {skipping} times as fast" in text()
    assert f"{both(dense, 'stages')} of them dense, {both(ordered, 'stages')} with zeros skipped." in text()
    assert f"({both(ordered, 'P = 1')} units) is about as fast as 16 that do not ({both(dense, 'P = 16')})" in text()
    assert f"({both(ordered, 'P = 16')}) are faster than 1024 that do not ({both(dense, 'P = 1024')})" in text()


def test_rounding() -> None:
    found = stored().records("agreement")
    unpivoted = {r["case"]: r for r in found if r["way"] == "lu without pivoting" and not r["fails_in_step"]}
    pivoted = [r for r in found if r["way"] == "lu" and r["case"] in unpivoted]
    worst = [max(float(r["relative_largest"]) for r in each) for each in (unpivoted.values(), pivoted)]
    assert worst[0] > 1000 * worst[1]
    without, with_it = (" ".join(power(f"{value:.0e}").split()) for value in worst)
    assert f"relative errors of up to {without} †, where pivoting has {with_it} †" in text()
    (radians,) = (r for r in found if "radians" in r["case"] and r["way"] == "givens")
    assert f"smallest singular value differs by {100 * float(radians['relative_smallest']):.0f} % †" in text()


def test_the_drive() -> None:
    """Yaw is nearer to GPS than to the inertial unit, of the plain filter too; positions are as good between fixes."""
    (robust, plain) = (
        next(r for r in stored().records("attitude") if r["scale_error"] == "0.02" and r["method"] == method)
        for method in ("ERKF mu=1e5, gyro row", "EKF")
    )
    for of in (robust, plain):
        assert 5 * float(of["gps_deg"]) < float(of["imu_deg"])
    assert f"{robust['gps_deg']}° from GPS, {robust['imu_deg']}° from the IMU at 2 %" in text()
    assert f"the EKF has {plain['gps_deg']}° from GPS" in text()
    position = next(
        r for r in stored().records("position") if (r["scale_error"], r["method"]) == ("0.02", "ERKF mu=1e8, bias row")
    )
    (raw,) = stored().records("raw")
    for axis in ("north", "east", "down"):
        assert float(position[f"between_{axis}_m"]) == pytest.approx(float(position[f"fix_{axis}_m"]), rel=0.1)
        assert 5 * float(position[f"between_{axis}_m"]) < float(raw[f"held_{axis}_m"])


def test_the_schedule() -> None:
    speeds = {(row["System"], row["Way"]): row for row in rows("speeds.csv")}
    leon3 = {row["Way"]: row for row in rows("processors.csv") if row["Processor"] == "leon3"}
    least = {way: float(speeds["position", way]["L = 1"]) / float(speeds["position", way]["L = 40"]) for way in leon3}
    assert f"needs {least['inverse']:.0f} (inverse) to {least['closed form']:.0f} (closed form) times less" in text()
    assert leon3["inverse"]["in use at l"] == "k+20"
    assert "lands 20 steps later by the inverse on the leon3, and in the next step in closed form" in text()
    assert {leon3[way]["in use at l"] for way in ("closed form", "pivoted LU")} == {"k+1"}
    algorithm = float(speeds["position", "Givens"]["L = 1"]) / float(speeds["position", "closed form"]["L = 1"])
    assert least["Givens"] > algorithm
    for system in SYSTEMS:
        closed = [float(speeds[system, "closed form"][f"L = {L}"]) for L in (1, 5, 10, 20, 40)]
        for way in leon3:
            assert (np.array([float(speeds[system, way][f"L = {L}"]) for L in (1, 5, 10, 20, 40)]) >= closed).all()


def test_a_parallel_device_is_hardly_faster_than_the_closed_form() -> None:
    *_, last = rows("device.csv")
    closed = next(
        row for row in rows("processors.csv")
        if (row["System"], row["Processor"], row["Way"]) == ("position", "leon3", "closed form")
    )  # fmt: skip
    alone_ms = float(closed["in one period, %"]) / 100 * 1000 / HR_HZ
    assert float(last["step, ms"]) == pytest.approx(alone_ms, rel=0.25)
    assert f"64 units make the step of the position filter {last['times faster']} times faster" in text()
    (answered,) = (
        float(row["from fix to result, ms"]) for row in rows("ways.csv")
        if (row["System"], row["Way"]) == ("position", "closed form")
    )  # fmt: skip
    assert answered == pytest.approx(alone_ms, rel=2e-3)
    assert f"takes {answered:#.3g} ms with the propagation in it" in text()


def test_the_least_speeds_that_are_drawn_are_those_of_the_table() -> None:
    drawn = {
        (row["System"], row["Way"], int(row["L"])): float(row["million operations a second"])
        for row in rows("least-speeds.csv")
    }
    assert len(drawn) == 2 * 4 * 40
    for row in rows("speeds.csv"):
        for L in (1, 5, 10, 20, 40):
            assert float(row[f"L = {L}"]) == pytest.approx(drawn[row["System"], row["Way"], L], rel=0.005)


def test_what_is_said_to_be_reproduced_of_the_paper_has_the_same_numbers() -> None:
    page = REPRODUCED.read_text(encoding="utf-8")
    natural = " and ".join(
        f"{costs_of(ways.HOUSEHOLDER_NATURAL, column) / costs_of(ways.GIVENS_NATURAL, column):.2f}"
        for column in ("attitude, μ = ∞", "position, μ = ∞")
    )
    assert f"Householder takes {natural} times as many operations" in page
    assert f"Givens takes {ratios(ways.GIVENS_ORDERED, ways.FADDEEV_ORDERED, 1)} times as many" in page
    kept = [row["stable and convergent"] for row in rows("linear-sample.csv")]
    assert kept == ["1000"] * 3
    assert "in 3 times 1000 of 1000 random systems" in page
    stopped = int(rows("linear-sample.csv")[-1]["stopped by rounding †"])
    assert round(1000 / stopped) == 8
    assert "rounding stops about one filter in eight" in page
    kalman, finite, limit = (row for row in rows("linear.csv") if row["System"] == "decaying")
    wrong = "F wrong"
    said = (
        f"to an error of {kalman[wrong]} instead of {kalman['error, step 200']}, the robust one to {finite[wrong]} or"
    )
    assert said in page
    assert f"with $\\mu = \\infty$, {limit[wrong]} |" in page
    assert f"yes: Givens takes {ratios(ways.GIVENS_ORDERED, ways.LU_ORDERED, 1)} times as many operations" in page
    plain, *_, stated = (
        float(record["outage_end_m"])
        for record in stored().records("position")
        if record["accelerometer_error"] == "0.1" and record["method"].startswith(("EKF", "ERKF mu=1e8"))
    )
    assert f"makes ten seconds without GPS {stated / plain:.0f} times worse" in page
    assert {f"{name}.svg" for name in ("imu", "filters", "route", "attitude", "stability")} <= set(rebuilt())


def test_no_number_is_said_twice_or_to_absurd_digits() -> None:
    assert not re.findall(r"(?<![\d.,])([\d.,]+) and \1(?![\d.,])", text())
    assert not re.findall(r"\d{3,}\.\d+ %", text())


def test_what_is_said_in_short_is_short() -> None:
    """Six points, each read in some ten seconds."""
    _, *points = re.split(r" \d\. ", text().partition("**In short.**")[2].partition(" ## ")[0])
    assert len(points) == 6
    assert all(len(point.split()) <= 45 for point in points)
