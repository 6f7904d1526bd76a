"""Which systems the same predictors and correctors run, and how many lines of code they and each system take.

"Few lines of code" and "the same code to be used for a variety of projects" are what MacCormack and Rubinstein claim of
predictors and correctors that leave evolution and observation to the user.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable
from types import ModuleType
from typing import Any, NamedTuple, TypeAlias

from filters.modular import ModularFilter, correctors, predictors, sigma_points
from filters.modular.predictors import Kind
from filters.systems import rocket_filter, spring_mass
from studies.modular import costs, parameter_state
from studies.modular.oscillator import USUAL
from studies.modular.oscillator_run import ACCELERATION_SIGMA, POSITION_SIGMA_M, step_s

Code: TypeAlias = ModuleType | Callable[..., Any]

KINDS: tuple[Kind, ...] = costs.KINDS
PARTS: tuple[Code, ...] = (predictors, correctors)
"""What all systems share, beside the sigma points."""
POINTS: tuple[Code, ...] = (sigma_points,)


class SharedCode(NamedTuple):
    """A system. states: the length of its error, least and greatest; predictors, correctors: the kinds of them that run
    it; lines: of code, its own."""

    name: str
    states: tuple[int, int]
    predictors: tuple[Kind, ...]
    correctors: tuple[Kind, ...]
    lines: int


def systems() -> tuple[SharedCode, ...]:
    """Those of the report."""
    position, acceleration = (spring_mass.Instrument(float(s)) for s in (POSITION_SIGMA_M, ACCELERATION_SIGMA))
    tracker = spring_mass.tracker(step_s(USUAL), 1.0, position, acceleration)
    flown = [rocket_filter.rocket_filter("unscented"), rocket_filter.rocket_filter("extended")]
    drag = [costs.filter_of(kind, states) for kind in KINDS for states in costs.STATES]
    return (
        _system(
            "oscillator, no spring known", [tracker],
            spring_mass.tracker, spring_mass.transition, spring_mass.white_jerk,
        ),
        _system(
            "oscillator, stiffness as a state", [parameter_state.stiffness_filter()],
            parameter_state.stiffness_filter, parameter_state.swing_on, parameter_state.accelerated,
        ),
        _system(
            "rocket", flown,
            rocket_filter.rocket_filter, rocket_filter.sensors, rocket_filter.process_noise, rocket_filter.move,
            rocket_filter.specific_force, rocket_filter.attitude,
        ),
        _system(
            "motion with drag", drag,
            costs.filter_of, costs.move, costs.move_jacobian, costs.see, costs.see_jacobian,
        ),
    )  # fmt: skip


def code_lines(*code: Code) -> int:
    """How many lines hold code: not those that are blank, or hold nothing but a comment or a docstring."""
    return sum(len(_lines(inspect.getsource(each))) for each in code)


def _lines(source: str) -> set[int]:
    tree = ast.parse(source)
    said = {line for node in ast.walk(tree) if _is_text(node) for line in _extent(node)}
    blank = {at for at, line in enumerate(source.splitlines(), 1) if not line.strip() or line.lstrip()[0] == "#"}
    return {line for node in tree.body for line in _extent(node)} - said - blank


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _extent(node: Any) -> range:
    return range(
        min([node.lineno, *(each.lineno for each in getattr(node, "decorator_list", ()))]), node.end_lineno + 1
    )


def _system(name: str, filters: list[ModularFilter], *own: Code) -> SharedCode:
    states = [each.predictor.states for each in filters]
    predicting = {each.predictor.kind for each in filters}
    correcting = {sensor.corrector.kind for each in filters for sensor in each.sensors}
    return SharedCode(
        name,
        (min(states), max(states)),
        tuple(kind for kind in KINDS if kind in predicting),
        tuple(kind for kind in KINDS if kind in correcting),
        code_lines(*own),
    )
