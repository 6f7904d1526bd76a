"""A function of a system that gives something of another shape is named before the run: it would go on with a part."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.delayed import dual_rate, larsen, recalculate, standard
from filters.system import System
from filters.systems.example import example_system
from tests.strategies import Problem, problem

GOOD = problem(example_system(3, 2, 2), 5, 2, 4, 12, seed=0)

WRONG: list[tuple[str, Any, str]] = [
    ("F", lambda _j, _x, _u, _p: np.eye(2), r"F\(j, x, u, p\) has shape \(2, 2\); needed is \(3, 3\)"),
    ("Q", lambda _j, _p: np.eye(5), r"Q\(j, p\) has shape \(5, 5\); needed is \(3, 3\)"),
    ("H", lambda _k, _x, _p: np.ones((1, 3)), r"H\(k, x, p\) has shape \(1, 3\); needed is \(2, 3\)"),
    ("R", lambda _k, _p: np.eye(1), r"R\(k, p\) has shape \(1, 1\); needed is \(2, 2\)"),
    ("R", lambda _k, _p: 1.0, r"R\(k, p\) returns a float; needed is an array of numbers of shape \(2, 2\)"),
    ("F", lambda _j, _x, _u, _p: np.eye(3) + 0j, r"F\(j, x, u, p\) returns an array of complex128"),
    ("f", lambda _j, x, _u, _p, _out: 2.0 * x, r"f\(j, x, u, p, out\) does not write out\[0\]; it must write all"),
    ("h", lambda _k, x, _p, out: out.__setitem__(0, x[0]), r"h\(k, x, p, out\) does not write out\[1\]"),
]  # fmt: skip


@pytest.mark.parametrize("backend", ["reference", "numpy", "compiled"])
@pytest.mark.parametrize("run", [standard.run, recalculate.run, larsen.run, dual_rate.run])
@pytest.mark.parametrize(("name", "function", "message"), WRONG)
def test_functions_of_a_run(
    run: Callable[..., Any], backend: str, name: str, function: Callable[..., Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        run(*GOOD._replace(system=GOOD.system._replace(**{name: function})), backend=backend)


@pytest.mark.parametrize("of", ["system", "coarse"])
@pytest.mark.parametrize(("name", "function", "message"), WRONG)
def test_functions_of_a_multirate_run(of: str, name: str, function: Callable[..., Any], message: str) -> None:
    systems = {"system": GOOD.system, "coarse": GOOD.system}
    systems[of] = GOOD.system._replace(**{name: function})
    measurements = np.zeros((13, 2))
    with pytest.raises(ValueError, match=message):
        multirate_gain.run(
            systems["system"], 1, GOOD.x0, GOOD.P0, GOOD.inputs, measurements, coarse=systems["coarse"], form="u-d"
        )


def moved(array: Any) -> None:
    array[(0,) * array.ndim] += 0.1


def changing(name: str, what: int) -> System:
    """GOOD's, but a function of it changes one of its arguments, and gives what it would have given before."""
    whole = getattr(GOOD.system, name)

    def function(*given: Any) -> Any:
        result = whole(*given)
        moved(given[what].Phi if hasattr(given[what], "Phi") else given[what])
        return result

    return GOOD.system._replace(**{name: function})


@pytest.mark.parametrize("run", [standard.run, recalculate.run, larsen.run, dual_rate.run])
@pytest.mark.parametrize(
    ("name", "what", "said"),
    [
        ("f", 1, r"f\(j, x, u, p, out\) changes x, .*copy, x.copy\(\)"),
        ("f", 2, r"f\(j, x, u, p, out\) changes u, "),
        ("f", 3, r"f\(j, x, u, p, out\) changes p, .* a field of p named scratch"),
        ("F", 1, r"F\(j, x, u, p\) changes x, "),
        ("F", 2, r"F\(j, x, u, p\) changes u, "),
        ("F", 3, r"F\(j, x, u, p\) changes p, "),
        ("Q", 1, r"Q\(j, p\) changes p, "),
        ("h", 1, r"h\(k, x, p, out\) changes x, "),
        ("h", 2, r"h\(k, x, p, out\) changes p, "),
        ("H", 1, r"H\(k, x, p\) changes x, "),
        ("H", 2, r"H\(k, x, p\) changes p, "),
        ("R", 1, r"R\(k, p\) changes p, "),
    ],
)
def test_a_function_that_changes_what_it_is_given(run: Callable[..., Any], name: str, what: int, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        run(*fresh(changing(name, what)))


def fresh(system: System) -> Problem:
    """GOOD with a system whose parameters may be changed."""
    return GOOD._replace(system=system._replace(parameters=type(system.parameters)(*map(np.copy, system.parameters))))


def test_a_coarse_system_that_changes_what_it_is_given() -> None:
    coarse = fresh(changing("H", 1)).system
    with pytest.raises(ValueError, match=r"H\(k, x, p\) changes x, "):
        multirate_gain.run(GOOD.system, 1, GOOD.x0, GOOD.P0, GOOD.inputs, np.zeros((13, 2)), coarse=coarse)


class WithMemory(NamedTuple):
    noise: FloatArray
    scratch: tuple[FloatArray]


def remembering(_k: int, p: WithMemory) -> FloatArray:
    p.scratch[0][:] += 1.0
    return p.noise


def test_memory_of_its_own_is_a_function_s_to_change() -> None:
    system = System(
        1, 0, 1, _still, _one, remembering, _seen, _one_seen, remembering, WithMemory(np.eye(1), (np.eye(1),))
    )
    standard.run(system, 1, 0, 0, np.ones(1), np.eye(1), np.zeros((2, 0)), np.ones((3, 1)))
    unnamed = system._replace(parameters=Unnamed(*system.parameters), Q=lambda _j, p: p.memory[0].__iadd__(1.0))
    with pytest.raises(ValueError, match=r"Q\(j, p\) changes p, "):
        standard.run(unnamed, 1, 0, 0, np.ones(1), np.eye(1), np.zeros((2, 0)), np.ones((3, 1)))


class Unnamed(NamedTuple):
    noise: FloatArray
    memory: tuple[FloatArray]


def _still(_j: int, x: FloatArray, _u: FloatArray, _p: Any, out: FloatArray) -> None:
    out[:] = x


def _one(_j: int, _x: FloatArray, _u: FloatArray, _p: Any) -> FloatArray:
    return np.eye(1)


def _seen(_k: int, x: FloatArray, _p: Any, out: FloatArray) -> None:
    out[:] = x


def _one_seen(_k: int, _x: FloatArray, _p: Any) -> FloatArray:
    return np.eye(1)


@pytest.mark.parametrize("name", ["Q", "R"])
def test_a_noise_that_is_not_symmetric(name: str) -> None:
    size = 3 if name == "Q" else 2
    system = GOOD.system._replace(**{name: lambda _j, _p: np.tri(size)})
    with pytest.raises(ValueError, match=f"step 0: {name} of the system is not symmetric"):
        standard.run(*GOOD._replace(system=system))


@pytest.mark.parametrize(("size", "value"), [("states", 3.0), ("states", 0), ("inputs", -1), ("measurements", 0)])
def test_sizes_of_a_system(size: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"{size}={value} of the system must be a whole number, at least"):
        standard.run(*GOOD._replace(system=GOOD.system._replace(**{size: value})))


def test_numbers_too_large_for_a_float() -> None:
    with pytest.raises(ValueError, match="measurements holds a value that is no number: int too large"):
        standard.run(*GOOD._replace(measurements=[[10**400, 1]]))
    with pytest.raises(ValueError, match="x0 is no array of numbers: int too large"):
        standard.run(*GOOD._replace(x0=[10**400, 1, 1]))
    with pytest.raises(ValueError, match="inputs is no array of numbers: "):
        standard.run(*GOOD._replace(inputs=[[1.0], [1.0, 2.0]]))
