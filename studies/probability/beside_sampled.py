"""The exact probabilities of a scenario's misses, beside those of its simulation, where its structure allows."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

import numpy as np

from sched_sim.probability.outcome import Bounds, CycleProbabilities, Floats, Probabilities
from sched_sim.scenario.kinds import correct_kind, gain_kind
from sched_sim.scenario.load import loads
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.shares import percent
from studies.probability.answer import exactly, mean
from studies.probability.of_scenario import AsDesigns, as_designs
from studies.probability.unseen import resolution

MOST_LOAD = 0.9
"""Beyond, it may take minutes."""


class Exact(NamedTuple):
    """A probability in the mean of the first cycles, and below which samples say nothing."""

    bounds: Bounds
    floor: float


class Longer(NamedTuple):
    """How likely a predict job takes longer than so many ticks, of which an HR period has `ticks`, at the most."""

    ticks: int
    exceedance: Floats
    floor: float


class Beside(NamedTuple):
    """misses: by kind of job, in the mean of so many measurement cycles; why: others are not there, in words;
    longer: response times of predict jobs; landing: by l - k, of those that arrive, at the most."""

    misses: Mapping[str, Exact]
    cycles: int
    why: str
    longer: Longer | None = None
    landing: Mapping[int, Exact] = {}


def followed(scenario: Scenario) -> AsDesigns | str:
    """The designs that are followed exactly, or why there are none, in words."""
    designs = as_designs(scenario)
    if not isinstance(designs, str) and (load := sum(one.share for one in loads(scenario))) > MOST_LOAD:
        return f"the load is {percent(load)}, and what is left to do would be followed for long"
    return designs


def beside_sampled(scenario: Scenario) -> Beside:
    """Of the first cycles of the scenario, at most a thousand. Raises InputError where its costs are more than can be
    followed."""
    designs = followed(scenario)
    if isinstance(designs, str):
        return Beside({}, 0, designs)
    (sensor,) = scenario.sensors
    predict = exactly(designs.predict)
    own, cycles = resolution(designs.predict), designs.predict.cycles
    misses = {"predict": Exact(mean(lambda cycle: cycle.hr_miss, predict), own.job)}
    longer = Longer(predict.ticks, _exceedance(predict), own.job)
    if designs.correct is None:
        return Beside(misses, cycles, designs.why, longer)
    correct = predict if designs.correct is designs.predict else exactly(designs.correct)
    if scenario.late == "dual-rate" and _latest(correct) > sensor.every:
        return Beside({}, 0, "a correction may land after the next measurement was taken, which takes more work")
    floor = resolution(designs.correct).cycle
    misses[correct_kind(sensor)] = Exact(mean(lambda cycle: _late(cycle, sensor, correct), correct), floor)
    if scenario.late == "dual-rate":
        misses[gain_kind(sensor)] = Exact(mean(lambda cycle: cycle.misses.get("lr_propagate"), correct), floor)
    steps = sorted({L for cycle in correct.cycles for L in cycle.landing})
    landing = {L: Exact(mean(partial(_landing, L=L, found=correct), correct), floor) for L in steps}
    return Beside(misses, cycles, "", longer, landing)


def _exceedance(found: Probabilities) -> Floats:
    """Of the responses of HR jobs, in the mean of the first cycles."""
    tails = [cycle.responses["hr"].upper for cycle in found.cycles]
    length = max(map(len, tails))
    return np.asarray(np.mean([np.pad(tail, (0, length - len(tail)), "edge") for tail in tails], axis=0))


def _landing(cycle: CycleProbabilities, L: int, found: Probabilities) -> Bounds:
    """Of the corrections whose measurement arrives."""
    lower, upper = cycle.landing.get(L, Bounds(0.0, min(cycle.behind, 1.0)))
    return Bounds(lower / (1 - found.lost), min(upper / (1 - found.lost), 1.0))


def _latest(found: Probabilities) -> int:
    return max(L for cycle in found.cycles for L in cycle.landing)


def _late(cycle: CycleProbabilities, sensor: Sensor, found: Probabilities) -> Bounds:
    """Of the corrections whose measurement arrives."""
    late = [bounds for L, bounds in cycle.landing.items() if sensor.land_by < L]
    lower, upper = (sum(bounds[side] for bounds in late) for side in (0, 1))
    return Bounds(lower / (1 - found.lost), min((upper + cycle.behind) / (1 - found.lost), 1.0))
