"""What `simulate --scenario` says of the sensors' times."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.scenario.sensor_times import times
from tests.command_line import Run
from tests.scenarios import BY_HAND, scenario, sensor

THIRD = Fraction(40, 3)


@pytest.mark.parametrize(
    ("of", "said"),
    [
        (sensor("gps", 80), "gps: 5 Hz = every 80 steps"),
        (sensor("gps", 1, 1), "gps: 400 Hz = every step; 2.5 ms late = 1 step"),
        (sensor("gps", 80, 44), "gps: 5 Hz = every 80 steps; 110 ms late = 44 steps"),
        (sensor("gps", 80, [44, 48]), "gps: 5 Hz = every 80 steps; 110, 120 ms late = 44, 48 steps"),
        (sensor("gps", 80, range(48, 81)), "gps: 5 Hz = every 80 steps; 120 to 200 ms late = 48 to 80 steps"),
        (sensor("gps", 80, offset=2), "gps: 5 Hz = every 80 steps; the first at 5 ms = 2 steps"),
        (sensor("gps", THIRD), "gps: 30 Hz = every 40/3 steps; taken in steps 0, 14, 27, 40, ..."),
        (sensor("gps", 7), "gps: 57.14 Hz = every 7 steps"),
        (
            sensor("gps", 200, Fraction("44.4"), offset=Fraction("1.2")),
            "gps: 2 Hz = every 200 steps; the first at 3 ms = 1.2 steps; taken in steps 2, 202; 111 ms late = 44.4 "
            "steps; used 44 steps later",
        ),
        (
            sensor("gps", THIRD, Fraction("44.4")),
            "gps: 30 Hz = every 40/3 steps; taken in steps 0, 14, 27, 40, ...; 111 ms late = 44.4 steps; used 44 to 45 "
            "steps later",
        ),
    ],
)
def test_each_sensor_has_a_line(of: object, said: str) -> None:
    assert times(scenario(10, BY_HAND, of, hr_hz=400)) == [said]  # type: ignore[arg-type]
    assert times(scenario(10, BY_HAND, of)) == []  # type: ignore[arg-type]


def test_it_is_below_the_table_and_in_the_document(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(
        'name = "s"\nhr_hz = 400\nduration_s = 1\n[predictor]\ncost_us = 100\n'
        '[[sensor]]\nname = "camera"\nhz = 30\ndelay_ms = 110\ncost_us = 100\n'
    )
    out = sched_sim("simulate --scenario s.toml").out
    assert out.splitlines()[-1] == (
        "camera: 30 Hz = every 40/3 steps; taken in steps 0, 14, 27, 40, ...; 110 ms late = 44 steps"
    )
    camera = json.loads(sched_sim("simulate --scenario s.toml --format json").out)["sensors"]["camera"]
    assert (camera["hz"], camera["every"], camera["least_delay"], camera["longest_delay"]) == (30, 40 / 3, 44, 44)
    assert camera["taken"] == 30
