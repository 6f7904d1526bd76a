"""The model of a scenario: Phi and Q, and of each of its sensors H and R."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import chdir
from dataclasses import dataclass
from fractions import Fraction
from math import isclose
from pathlib import Path
from typing import NamedTuple

from filters.accuracy.sensors import SensorsModel, sensors_model
from filters.accuracy.shipped import SHIPPED_MODELS
from filters.arrays import FloatArray
from filters.modular.composition import ModularFilter
from filters.modular.linearised import linearised_filter
from sched_sim.bounds import short
from sched_sim.errors import InputError, option
from sched_sim.scenario.accuracy_asked import Seen
from sched_sim.scenario.scenario import Scenario
from studies.measurement.described import UNSAID
from studies.measurement.user_function import Returned, explained, returned_by
from studies.selection.model import Model, load_model, model_of, shipped_defaults

HOW = (
    "give a function package.module:function that returns a filters.accuracy.SensorsModel or a ModularFilter with the "
    f"scenario's sensors, or for one sensor a System or LinearModel; or one of {', '.join(SHIPPED_MODELS)}"
)


@dataclass(frozen=True)
class ScenarioModel:
    """of: with the scenario's sensors, in its order. model: the same for `outputs_of`, all sensors as one.

    linearised: of a filter or system that is not linear, at a state.
    """

    name: str
    of: SensorsModel
    model: Model
    linearised: bool


def load_scenario_model(
    asked: str | None, scenario: Scenario, folder: Path, said: Mapping[str, Seen] | None = None
) -> ScenarioModel:
    """asked: a name; None: the scenario's filter. folder: where its module is looked for first. said: H and R of
    sensors of which the model does not say them, or says others.

    Raises InputError that names the model, or the sensor, and what is wrong with it.
    """
    said = {} if said is None else said
    name = scenario.filter if asked is None else asked
    if name is None:
        raise InputError(f"{option('model')} is missing: {HOW}")
    names = [sensor.name for sensor in scenario.sensors]
    for sensor in said:
        if sensor not in names:
            raise InputError(
                f"[accuracy.sensors] has {short(repr(sensor))}, which is none of the scenario's sensors: "
                f"{', '.join(names)}"
            )
    found = _found(name, scenario.hr_hz, folder)
    lacking = [sensor for sensor in names if sensor not in said]
    which = f"{option('model')} {short(repr(name))}"
    matrices = {}
    for sensor in names:
        if isinstance(found.own, Mapping):
            own = found.own.get(sensor)
        else:
            own = found.own if lacking == [sensor] or len(names) == 1 else None
        H, R = said.get(sensor, Seen(None, None))
        if own is None and (H is None or R is None):
            raise InputError(f"{which} {_does_not_say(found.own, sensor, lacking)}")
        of_model = own or (None, None)
        matrices[sensor] = (of_model[0] if H is None else H, of_model[1] if R is None else R)
    with explained(which):
        of = sensors_model(found.Phi, found.Q, matrices, found.names)  # type: ignore[arg-type]  # none is None
    shipped = shipped_defaults(name)
    return ScenarioModel(name, of, Model(name, of.stacked, 0, shipped), found.linearised)


class _Found(NamedTuple):
    """own: H and R by sensor, or those of the only sensor that the model knows."""

    Phi: FloatArray
    Q: FloatArray
    own: Mapping[str, tuple[FloatArray, FloatArray]] | tuple[FloatArray, FloatArray]
    names: tuple[str, ...]
    linearised: bool


def _does_not_say(own: object, sensor: str, lacking: list[str]) -> str:
    there = f"[accuracy.sensors.{sensor}] in the scenario's file"
    if isinstance(own, Mapping):
        return (
            f"has no sensor {short(repr(sensor))}, but {', '.join(map(str, own))}: give it the names of the scenario, "
            f"or H and R under {there}"
        )
    return (
        f"has the H and R of one sensor, and the scenario has several: {', '.join(lacking) or sensor}: give H and R "
        f"under {there}, of all but one"
    )


def _found(name: str, hr_hz: Fraction | None, folder: Path) -> _Found:
    if ":" not in name and name not in SHIPPED_MODELS:
        raise InputError(f"{option('model')} {short(repr(name))} is unknown: {HOW}")
    if name in SHIPPED_MODELS:
        if hr_hz is None:
            raise InputError(
                f"{option('model')} {name} depends on the time of a step: give the scenario hr_hz, not speed"
            )
        linear = load_model(name, hr_hz).linear
        return _Found(linear.Phi, linear.Q, (linear.H, linear.R), linear.names, False)
    with chdir(folder):
        returned = returned_by(name, option("model"), HOW)
    which = f"{option('model')} {short(repr(name))}"
    if isinstance(returned.value, SensorsModel):
        with explained(which):
            of = sensors_model(*returned.value)
        return _Found(of.Phi, of.Q, of.sensors, of.names, False)
    composed, *typical = returned.value if isinstance(returned.value, tuple) else (returned.value,)
    if isinstance(composed, ModularFilter) and len(typical) <= 3:
        _check_step(which, composed, hr_hz)
        with explained(which):
            of = linearised_filter(composed, *typical)
        parts = [composed.predictor.kind, *(sensor.corrector.kind for sensor in composed.sensors)]
        return _Found(of.Phi, of.Q, of.sensors, (), any(kind != "linear" for kind in parts))
    model = _one_sensor(returned, name)
    linear = model.linear
    return _Found(linear.Phi, linear.Q, (linear.H, linear.R), linear.names, model.system is not None)


def _one_sensor(returned: Returned, name: str) -> Model:
    try:
        return model_of(returned, name)
    except InputError as error:
        if "returned a" in str(error):
            kind = type(returned.value).__name__
            raise InputError(
                f"{option('model')} {short(repr(name))}: {returned.function}() returned a {kind}; {HOW}"
            ) from None
        raise


def _check_step(which: str, composed: ModularFilter, hr_hz: Fraction | None) -> None:
    if hr_hz is None or composed.dt == UNSAID or isclose(composed.dt * float(hr_hz), 1, rel_tol=1e-9):
        return
    raise InputError(
        f"{which}: its dt = {composed.dt:g} s ({1 / composed.dt:g} Hz) is not that of the scenario, hr_hz = "
        f"{float(hr_hz):g}: mend the one that is wrong"
    )
