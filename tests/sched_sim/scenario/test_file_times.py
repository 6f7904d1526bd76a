"""Times of a scenario file as people have them: what they are in steps, and what is refused."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.errors import InputError
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.scenario.scenario_file import read_scenario

HEAD = 'name = "s"\nhr_hz = 400\nduration_s = 20\n'
GPS = 'name = "gps"\nhz = 5\ncost_ms = 1\n'


def read(folder: Path, sensor: str = GPS, head: str = HEAD, predictor: str = "cost_us = 500\n") -> Scenario:
    path = folder / "s.toml"
    path.write_text(f"{head}[predictor]\n{predictor}[[sensor]]\n{sensor}")
    return read_scenario(path)


def gps_of(folder: Path, more: str) -> Sensor:
    return read(folder, GPS + more).sensors[0]


@pytest.mark.parametrize(
    ("more", "found"),
    [
        ("", {}),
        ("every = 80", {}),
        ("delay_ms = 110", {"delays": (44,)}),
        ("delay_ms = [110, 111]", {"delays": (44, Fraction("44.4"))}),
        ("delay_ms = { least = 120, most = 200 }", {"delays": range(48, 81)}),
        ("delay_ms = 110\ndelay = 44\noffset_ms = 3\noffset = 1.2", {"delays": (44,), "offset": Fraction(6, 5)}),
        ("delay_ms = { least = 120, most = 122.5 }\ndelay = [48, 49]", {"delays": (48, 49)}),
        ('delay = "40/3"', {"delays": (Fraction(40, 3),)}),
        ("land_within_ms = 200", {"land_by": 80}),
        ("land_within_ms = 201.9\nland_by = 80", {"land_by": 80}),
        ("land_within_ms = 202.5", {"land_by": 81}),
    ],
)
def test_times_are_steps(tmp_path: Path, more: str, found: dict[str, Any]) -> None:
    sensor = gps_of(tmp_path, more)
    assert sensor.every == 80
    assert {name: getattr(sensor, name) for name in found} == found or [*sensor.delays] == [*found["delays"]]


def test_a_spread_between_steps_has_both_ends(tmp_path: Path) -> None:
    delays = gps_of(tmp_path, "delay_ms = { least = 121, most = 200 }").delays
    assert (delays[0], delays[-1], len(delays)) == (Fraction("48.4"), 80, 32)


def test_a_duration_is_the_steps_that_start_within_it(tmp_path: Path) -> None:
    for duration, steps in (("20", 8000), ("0.0101", 5), ("20\nsteps = 8000", 8000)):
        assert read(tmp_path, head=HEAD.replace("20", duration)).steps == steps


@pytest.mark.parametrize("hz", ["30", '"400/7"', "29.97"])
def test_rates_that_do_not_divide_are_exact(tmp_path: Path, hz: str) -> None:
    sensor = read(tmp_path, GPS.replace("5", hz)).sensors[0]
    assert sensor.every == 400 / Fraction(hz.strip('"'))
    assert sum(1 for _ in sensor.measurements(400_000, 0)) == -(-400_000 // sensor.every)
    assert sensor.land_by == int(sensor.every) - 1


@given(
    every=st.fractions(1, 20, max_denominator=6),
    offset=st.fractions(0, 5, max_denominator=6),
    within_ms=st.decimals(0, 60, places=1),
)
def test_landing_by_then_is_within_the_time_of_every_measurement(
    tmp_path_factory: pytest.TempPathFactory, every: Fraction, offset: Fraction, within_ms: Any
) -> None:
    """And it is the last such step of the one that waits longest for its step."""
    folder = tmp_path_factory.mktemp("s")
    more = f'every = "{every}"\noffset = "{offset}"\nland_within_ms = {within_ms}\n'
    if "/" not in str(every):
        more = more.replace(f'"{every}"', str(every))
    if "/" not in str(offset):
        more = more.replace(f'"{offset}"', str(offset))
    steps = 400 * Fraction(within_ms) / 1000
    sensor = f'name = "gps"\ncost_ms = 1\n{more}'
    if any(k - t > steps for k, t in instants(every, offset)):
        with pytest.raises(InputError, match="land_within_ms"):
            read(folder, sensor)
        return
    land_by = read(folder, sensor).sensors[0].land_by
    landings = [k + land_by - t for k, t in instants(every, offset)]
    assert max(landings) <= steps < max(landings) + 1


def instants(every: Fraction, offset: Fraction) -> list[tuple[int, Fraction]]:
    """The step and the instant of enough measurements for all there are."""
    of_all = [offset + number * every for number in range(12)]
    return [(-(-instant.numerator // instant.denominator), instant) for instant in of_all]


def test_a_scenario_in_ms_is_the_one_in_steps(tmp_path: Path) -> None:
    in_ms = read(tmp_path, GPS + "delay_ms = { least = 120, most = 200 }\noffset_ms = 5\nland_within_ms = 250\n")
    in_steps = read(
        tmp_path,
        'name = "gps"\nevery = 80\ncost = 1\ndelay = { least = 48, most = 80 }\noffset = 2\nland_by = 100\n',
        'name = "s"\nhr_hz = 400\nunit = "ms"\nsteps = 8000\n',
        "cost = 0.5\n",
    )
    assert in_ms == in_steps
    assert run_scenario(in_ms).sensors["gps"].taken == 100


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("delay_ms = -1", "sensor 'gps'.delay_ms: must be 0 or more: no measurement arrives before it is taken (given"),
        ("delay_ms = [1, -1]", "sensor 'gps'.delay_ms: entry 1 is -1: must be 0 or more: no measurement arrives"),
        ("delay_ms = { least = -1, most = 3 }", "sensor 'gps'.delay_ms: must be 0 or more: no measurement arrives"),
        ("delay_ms = { least = 5, most = 3 }", "sensor 'gps'.delay_ms: least = 5 is above most = 3: exchange them"),
        ("delay_ms = { least = 5 }", "delay_ms: has no most: give both, as { least = 120, most = 200 }, in ms"),
        ("delay_ms = 1e12", "sensor 'gps': delay 400000000000 is above 10,000,000 HR steps: give fewer"),
        (
            "delay_ms = { least = 0, most = 1e18 }",
            "sensor 'gps': delay 400000000000000000 is above 10,000,000 HR steps",
        ),
        (
            "every = 13\ndelay = 43\ndelay_ms = 110",
            "do not agree: leave out the one that is wrong; delay = 43 and delay",
        ),
        ("offset_ms = -1", "sensor 'gps'.offset_ms: must be at least 0 (given: -1)"),
        ("land_within_ms = -1", "sensor 'gps'.land_within_ms: must be at least 0 (given: -1)"),
        (
            "delay_ms = 121\nland_within_ms = 122",
            "sensor 'gps': land_within_ms = 122 is before any correction can land: a measurement is used in the first "
            "step at its arrival or after it; give 122.5 or more",
        ),
        ("every = 13", "sensor 'gps': every = 13 and hz = 5 (every 80 steps) do not agree: leave out the one that"),
        ("delay = 43\ndelay_ms = 110", "sensor 'gps': delay = 43 and delay_ms = 110 (44 steps) do not agree"),
        (
            "delay = [48, 80]\ndelay_ms = { least = 120, most = 200 }",
            "delay = [48, 80] and delay_ms = { least = 120, most = 200 } ({ least = 48, most = 80 } steps) do not",
        ),
        ("offset = 1\noffset_ms = 3", "sensor 'gps': offset = 1 and offset_ms = 3 (1.2 steps) do not agree"),
        ("land_by = 70\nland_within_ms = 200", "land_by = 70 and land_within_ms = 200 (land_by 80) do not agree"),
    ],
)
def test_a_wrong_time_of_a_sensor_is_refused_by_name(tmp_path: Path, more: str, said: str) -> None:
    with pytest.raises(InputError, match=re.escape(said)):
        gps_of(tmp_path, more)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("hz = 5", "hz = 0"), "sensor 'gps'.hz: must be greater than 0 (given: 0)"),
        (("hz = 5", "hz = -5"), "sensor 'gps'.hz: must be greater than 0 (given: -5)"),
        (("hz = 5", "hz = 500"), "hz = 500 is above hr_hz = 400: a sensor measures once in a step at most; give 400"),
        (("duration_s = 20", "duration_s = 0"), "duration_s: must be greater than 0 (given: 0)"),
        (("duration_s = 20", "duration_s = 20\nsteps = 8001"), "steps = 8001 and duration_s = 20 (8000 steps) do not"),
        (("duration_s = 20", "duration_s = 1e6"), "duration_s = 1000000 is 400,000,000 steps: give at most 10,000,000"),
        (("duration_s = 20", ""), "steps: is missing: write `steps = ...`, or `duration_s = ...` beside hr_hz"),
    ],
)
def test_a_wrong_rate_or_duration_is_refused_by_name(tmp_path: Path, change: tuple[str, str], said: str) -> None:
    with pytest.raises(InputError, match=re.escape(said)):
        read(tmp_path, GPS.replace(*change), HEAD.replace(*change))


DUAL_RATE = f'late = "dual-rate"\ncosts = "costs.toml"\n{HEAD}'


@pytest.fixture
def dual_rate_costs(tmp_path: Path) -> None:
    of_gps = [f"[samples.{kind}]\ngps = [1]\n" for kind in ("gain", "lr_correct", "hr_pass")]
    parts = "hr_propagate = [1]\nhr_restart = [1]\nhr_update = [1]\nlr_propagate = [1]\n"
    (tmp_path / "costs.toml").write_text(f'name = "c"\nunit = "us"\n[samples]\n{parts}{"".join(of_gps)}')


@pytest.mark.usefixtures("dual_rate_costs")
@pytest.mark.parametrize(
    ("times", "land_by"),
    [
        ("hz = 5", 79),
        ("hz = 5\ndelay_ms = 110", 44 + 79),
        ("every = 1\ndelay = 3", 4),
        ('every = "3/2"\ndelay = 3', 4),
        ("hz = 5\ndelay_ms = 110\nland_within_ms = 112.5", 45),
    ],
)
def test_corrections_of_the_dual_rate_filter_land_in_a_later_step_than_that_of_the_arrival(
    times: str, land_by: int, tmp_path: Path
) -> None:
    (found,) = read(tmp_path, f'name = "gps"\n{times}\n', DUAL_RATE, "").sensors
    assert found.land_by == land_by


@pytest.mark.usefixtures("dual_rate_costs")
@pytest.mark.parametrize(
    ("sensor", "predictor", "said"),
    [
        ("land_within_ms = 112", "", "land_within_ms = 112 is before any correction can land.* give 112.5 or more"),
        ("land_by = 44", "", "land_by 44 must be more than the least delay 44"),
        (
            "cost_ms = 1",
            "",
            r'the cost of sensor gps has no meaning with late = "dual-rate": its tasks have other parts',
        ),
        ("", "cost_ms = 1\n", r"the cost of \[predictor\] has no meaning"),
        ("priority = 5", "", "priority 5 must be more than 10, that of \\[predictor\\]"),
    ],
)
def test_what_the_dual_rate_filter_cannot_have_is_refused(
    sensor: str, predictor: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=said):
        read(tmp_path, f'name = "gps"\nhz = 5\ndelay_ms = 110\n{sensor}\n', DUAL_RATE, predictor)


@pytest.mark.parametrize(
    ("key", "steps"), [("hz", "every"), ("delay_ms", "delay"), ("offset_ms", "offset"), ("land_within_ms", "land_by")]
)
def test_a_time_needs_hr_hz(tmp_path: Path, key: str, steps: str) -> None:
    head = 'name = "s"\nspeed = 1\nsteps = 20\n'
    said = f"sensor 'gps'.{key}: it needs hr_hz, the steps in a second: give hr_hz, or {steps} = ... in steps instead"
    with pytest.raises(InputError, match=re.escape(f"{said} (given: 5)")) as caught:
        read(tmp_path, f'name = "gps"\nevery = 4\ncost = 1\n{key} = 5\n', head, "cost = 1\n")
    assert ";" not in str(caught.value)
    with pytest.raises(InputError, match=r"duration_s: it needs hr_hz, .* or steps = "):
        read(tmp_path, 'name = "gps"\nevery = 4\n', f"{head}duration_s = 5\n")


def test_where_hr_hz_cannot_be_read_nothing_is_said_of_the_times(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        read(tmp_path, GPS + "delay_ms = 110\n", HEAD.replace("400", "-400"))
    assert str(caught.value).endswith("s.toml': hr_hz: must be greater than 0 (given: -400)")
