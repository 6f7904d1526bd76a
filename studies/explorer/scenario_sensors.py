"""The sensors of a scenario: how they measure, and in which steps their corrections land."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sched_sim.scenario.distribution import finished_or_not
from sched_sim.scenario.file_units import shown
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.outcome import SensorFigures
from sched_sim.scenario.scenario import Sensor
from sched_sim.scenario.sensor_times import times
from studies.explorer.scenario_found import ScenarioFound
from studies.explorer.scenario_jobs import DEEPEST
from studies.probability.beside_sampled import Beside


@dataclass(frozen=True, slots=True)
class SensorView:
    """times: its rate and delay, in words. taken, dropped, arrived, on_the_way, landed, not_landed: measurements; late:
    how many missed the deadline, to land in step k + land_by.

    L, counts: corrections by l - k, in the order of L; exact: how likely one lands there, at the most, None where that
    is not known. quantiles: of all that arrived; most_often: the L of most,
    and their share.
    """

    name: str
    kind: str
    hz: float | None
    every: str
    least_delay: int
    longest_delay: int
    dropout: float
    priority: int
    times: str
    land_by: int
    land_by_ms: float | None
    taken: int
    dropped: int
    arrived: int
    on_the_way: int
    landed: int
    not_landed: int
    late: int
    L: Sequence[int]
    counts: Sequence[int]
    exact: Sequence[float] | None
    quantiles: Mapping[str, float | None] | None
    most_often: tuple[int, float] | None


def sensor_views(found: ScenarioFound) -> list[SensorView]:
    scenario, outcome = found.scenario, found.outcome
    said = times(scenario) or [_in_steps(sensor) for sensor in scenario.sensors]
    return [
        _sensor(found, sensor, outcome.sensors[sensor.name], line)
        for sensor, line in zip(scenario.sensors, said, strict=True)
    ]


def _in_steps(sensor: Sensor) -> str:
    late = "" if not sensor.delayed else f"; {sensor.least_delay} to {sensor.longest_delay} steps late"
    if sensor.least_delay == sensor.longest_delay:
        late = late.replace(f"{sensor.least_delay} to ", "")
    return f"{sensor.name}: every {shown(sensor.every)} steps{late}"


def _sensor(found: ScenarioFound, sensor: Sensor, figures: SensorFigures, said: str) -> SensorView:
    scenario = found.scenario
    landing = found.exact.landing if isinstance(found.exact, Beside) else {}
    exact = {L: one.bounds.upper for L, one in landing.items() if one.bounds.upper > max(one.floor, DEEPEST)}
    L = sorted({*figures.achieved, *exact})
    achieved = None
    if figures.achieved:
        achieved = finished_or_not(list(figures.achieved.elements()), figures.not_landed)
    often = figures.achieved.most_common(1)
    return SensorView(
        name=sensor.name,
        kind=correct_kind(sensor),
        hz=None if scenario.hr_hz is None else float(scenario.hr_hz / sensor.every),
        every=shown(sensor.every),
        least_delay=sensor.least_delay,
        longest_delay=sensor.longest_delay,
        dropout=sensor.dropout,
        priority=sensor.priority,
        times=said.partition(": ")[2],
        land_by=sensor.land_by,
        land_by_ms=None if scenario.hr_hz is None else float(1000 * sensor.land_by / scenario.hr_hz),
        taken=figures.taken,
        dropped=figures.dropped,
        arrived=figures.arrived,
        on_the_way=figures.on_the_way,
        landed=figures.achieved.total(),
        not_landed=figures.not_landed,
        late=found.outcome.jobs[correct_kind(sensor)].misses,
        L=L,
        counts=[figures.achieved[step] for step in L],
        exact=[exact.get(step, 0.0) for step in L] if exact else None,
        quantiles=achieved,
        most_often=(often[0][0], often[0][1] / figures.arrived) if often else None,
    )
