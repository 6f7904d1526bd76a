"""Every job of every method: same results in every version, known operation counts, inputs left as they are."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from filters.backends.choose import arguments_for, function_for
from filters.backends.counted import Operations, count
from filters.backends.repeat import repeat
from filters.covariance_forms import COVARIANCE_FORMS
from filters.factored.form import FactoredForm
from filters.jobs import Job
from filters.multirate_gain import covariance_gain
from filters.registry import ALL_METHODS, DELAYED_METHODS, MULTIRATE_METHODS
from filters.systems.example import example_system
from filters.systems.navigation import simulate_drive
from tests.filters.cases import CASES, Case, arrays_in
from tests.filters.translation.cases import HAS_COMPILER
from tests.strategies import problem

KINDS = {
    "standard": ["propagate", "update"],
    "recalculate": ["propagate", "update", "replay"],
    "larsen": ["propagate", "propagate_accumulate", "update", "gain", "correct", "compensate"],
    "dual-rate": [
        "hr_restart", "hr_propagate", "hr_propagate_sum", "hr_propagate_euler", "hr_update",
        "lr_propagate", "lr_propagate_euler", "lr_update", "lr_gain", "lr_correct",
    ],
    "clone": ["propagate", "start", "carry", "update", "couple", "compensate"],
    "clone-split": ["propagate", "start", "carry", "update"],
    "carried-gain": ["propagate", "update", "carry", "land", "couple", "compensate"],
    "delayed-horizon": ["predict", "update", "replay", "propagate_covariance"],
    "px4-predictor": ["predict", "propagate", "update", "pull", "shift_output"],
    "augmentation": ["predict_0", "predict_1", "update_0", "update_1", "update_2"],
    "fuse-as-fresh": ["propagate", "update"],
    "multirate": ["state_update", "covariance_gain"],
    "multirate-square-root": ["state_update", "covariance_gain"],
    "multirate-ud": ["state_update", "covariance_gain"],
}  # fmt: skip

SYSTEM = example_system(9, 3, 3)

OF_A_FORM = [
    ("standard", "propagate"), ("standard", "update"), ("larsen", "propagate_accumulate"), ("larsen", "update"),
    ("clone", "start"), ("clone", "update"), ("clone", "couple"),
]  # fmt: skip
"""Jobs that call every function of a covariance form between them."""


def all_jobs(form: str = "textbook") -> dict[tuple[str, str], Job]:
    system = example_system(4, 2, 2, seed=5)
    return {
        (method.name, kind): job
        for method in ALL_METHODS.values()
        for kind, job in method.jobs(system, form, seed=1).items()
    }


each_job = pytest.mark.parametrize("key", list(all_jobs()), ids="-".join)


def test_names_of_methods_and_kinds() -> None:
    found = {name: list(method.jobs(example_system(2, 1, 1))) for name, method in ALL_METHODS.items()}
    assert found == KINDS
    assert {**DELAYED_METHODS, **MULTIRATE_METHODS} == ALL_METHODS
    assert all(job.kind == kind for (_, kind), job in all_jobs().items())


def results(backend: str, job: Job, index: int = 0) -> list[np.ndarray]:
    arguments = arguments_for(backend, job.arguments(index))
    returned = function_for(backend, job.function)(*arguments)
    if job.function is covariance_gain:
        arguments = with_covariances(job.arguments(index)[1], arguments)
    return arrays_in((arguments, returned))


def with_covariances(form: FactoredForm, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """The factors among the arguments of `covariance_gain`, which are not unique, replaced by what they stand for."""
    found = list(arguments)
    for position in (7, 8, 10):
        found[position] = np.empty_like(arguments[position])
        form.covariance(arguments[position], found[position])
    return tuple(found)


@each_job
@pytest.mark.parametrize("form", COVARIANCE_FORMS)
def test_numpy_does_what_the_loops_do(key: tuple[str, str], form: str) -> None:
    job = all_jobs(form)[key]
    for found, expected in zip(results("numpy", job), results("reference", job), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-13)


COMPILED = ("dual-rate",) if HAS_COMPILER else ("dual-rate", "carried-gain", "multirate-ud")
"""Whose jobs, but for that noise by Eq. 24, numba compiles in each run; all in `make exhaust`. In C all run each time,
for they are soon compiled (`tests/filters/translation`)."""


@pytest.mark.parametrize(
    "key",
    [
        pytest.param(key, marks=() if key[0] in COMPILED and "euler" not in key[1] else pytest.mark.exhaust)
        for key in all_jobs()
    ],
    ids="-".join,
)
def test_compiled_does_what_the_loops_do(key: tuple[str, str]) -> None:
    job = all_jobs()[key]
    for found, expected in zip(results("compiled", job), results("reference", job), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-15)


@pytest.mark.exhaust
@pytest.mark.parametrize("key", OF_A_FORM, ids="-".join)
@pytest.mark.parametrize("form", ["joseph", "short"])
def test_compiled_forms_do_what_the_loops_do(key: tuple[str, str], form: str) -> None:
    job = all_jobs(form)[key]
    for found, expected in zip(results("compiled", job), results("reference", job), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-15)


@each_job
@pytest.mark.parametrize("form", COVARIANCE_FORMS)
def test_a_job_leaves_its_inputs_so_that_it_can_be_repeated(key: tuple[str, str], form: str) -> None:
    job = all_jobs(form)[key]
    arguments = job.arguments(0)
    once = [array.copy() for array in arrays_in((arguments, job.function(*arguments)))]
    twice = arrays_in((arguments, job.function(*arguments)))
    for first, second in zip(once, twice, strict=True):
        np.testing.assert_array_equal(first, second)


@each_job
def test_argument_sets_differ_and_are_reproducible(key: tuple[str, str]) -> None:
    job = all_jobs()[key]
    first, again, other = (arrays_in(job.arguments(index)) for index in (0, 0, 1))
    assert all(np.array_equal(a, b) for a, b in zip(first, again, strict=True))
    assert [a.shape for a in first] == [b.shape for b in other]
    assert not all(np.array_equal(a, b) for a, b in zip(first, other, strict=True))
    assert not any(np.shares_memory(a, b) for a in first[10:] for b in other[10:])


@each_job
def test_argument_sets_hold_no_memory_as_it_comes(key: tuple[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    """It may hold anything, and two sets of one index would differ by it."""
    monkeypatch.setattr(np, "empty", lambda shape, dtype=float: np.full(shape, np.nan, dtype))
    monkeypatch.setattr(np, "empty_like", lambda like: np.full_like(like, np.nan))
    assert all(np.isfinite(array).all() for array in arrays_in(all_jobs()[key].arguments(0)))


@pytest.mark.exhaust
def test_repeating_in_compiled_code_gives_the_same_as_once() -> None:
    job = all_jobs()["larsen", "update"]
    arguments = job.arguments(0)
    function_for("compiled", repeat)(arguments_for("compiled", job.function), arguments_for("compiled", arguments), 5)
    for found, expected in zip(arrays_in(arguments), results("compiled", job), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-15)


@pytest.mark.slow
@pytest.mark.parametrize(
    "method",
    [pytest.param(name, marks=() if name in COMPILED else pytest.mark.exhaust) for name in DELAYED_METHODS],
)
def test_whole_runs_agree_between_backends(method: str) -> None:
    case = next((case for case in CASES if case.method == method), Case(method, {}, "at-arrival"))
    data = problem(example_system(4, 2, 2, seed=5), 5, 2, 4, 17, seed=2)
    for noise in ("exact", "sum", "euler") if method == "dual-rate" else (None,):
        options = {"low_rate_noise": noise} if noise else {}
        expected = case.run(data, backend="reference", **options)
        for backend in ("numpy", "compiled"):
            for found, value in zip(case.run(data, backend=backend, **options), expected, strict=True):
                np.testing.assert_allclose(found, value, rtol=1e-11, atol=1e-12)


@pytest.mark.slow
def test_a_nonlinear_model_is_compiled_too() -> None:
    drive = simulate_drive(steps=40, N=10, seed=0)
    arguments = (drive.system, 10, 4, 8, drive.x0, drive.P0, drive.inputs, drive.truth.measurements)
    run = ALL_METHODS["dual-rate"].run
    for found, value in zip(run(*arguments, backend="compiled"), run(*arguments), strict=True):
        np.testing.assert_allclose(found, value, rtol=1e-10, atol=1e-12)


def test_jobs_of_a_nonlinear_model_start_from_its_typical_state() -> None:
    drive = simulate_drive(steps=1, N=1, seed=0)
    job = ALL_METHODS["standard"].jobs(drive.system, "textbook", seed=0, x0=drive.x0)["propagate"]
    operations = count(job.function, *job.arguments(0))
    assert operations.function == 4  # sin and cos, in f and in F
    assert abs(job.arguments(0)[3].x[3] - drive.x0[3]) < 10


def test_the_forms_of_the_multirate_gain_do_the_same() -> None:
    """From the same covariance, in whatever form, the same gain; and the state update does not see the form."""
    jobs = [method.jobs(example_system(4, 2, 2, seed=5), "textbook", seed=1) for method in MULTIRATE_METHODS.values()]
    for kind, index in (("state_update", -1), ("covariance_gain", -3)):
        found = []
        for of_form in jobs:
            arguments = of_form[kind].arguments(0)
            of_form[kind].function(*arguments)
            found.append(arguments[index])
        for other in found[1:]:
            np.testing.assert_allclose(other, found[0], rtol=1e-10, atol=1e-12)


def product(n: int, m: int, p: int) -> Operations:
    return Operations(multiply=n * m * p, add=n * (m - 1) * p)


def cholesky(p: int) -> Operations:
    return Operations((p - 1) * p * (p + 1) // 6, (p - 1) * p * (p + 1) // 6, p * (p - 1) // 2, p)


def unit_lower(p: int) -> Operations:
    products = (p - 2) * (p - 1) * p // 6 + p * (p - 1) // 2
    return Operations(products, products, p * (p - 1) // 2)


def terms_update(n: int, p: int) -> Operations:
    """z; V = W L^-T, L^-1 z and G = V D^-1; x + G (L^-1 z); P - V G^T on and below its diagonal."""
    pairs, half = p * (p - 1) // 2, n * (n + 1) // 2
    solved = Operations((n + 1) * pairs + n * p, (n + 1) * pairs, p)
    return Operations(add=p) + solved + product(n, p, 1) + Operations(add=n) + Operations(half * p, half * p)


@pytest.mark.parametrize(("n", "u", "p"), [(9, 3, 3), (4, 2, 1), (5, 1, 3)])
def test_operations_of_the_jobs_in_textbook_form(n: int, u: int, p: int) -> None:
    system = example_system(n, u, p)
    found = {
        (name, kind): count(job.function, *job.arguments(0))
        for name, method in ALL_METHODS.items()
        if name in DELAYED_METHODS or name == "multirate"
        for kind, job in method.jobs(system).items()
    }
    square, vector = Operations(add=n * n), Operations(add=n)
    f = product(n, n, 1) + Operations(multiply=n * u, add=n * u)
    cube = product(n, n, n)
    inverse = Operations(2 * p * p + 2 * p * p * (p - 1), 2 * p * p * (p - 1), p)
    H_P_Ht = product(n, n, p) + product(p, n, n) + product(p, n, p) + Operations(add=p * p)
    gain = H_P_Ht + inverse + product(n, p, p)
    error = product(p, n, 1) + Operations(add=p) + product(n, p, 1)
    covariance = product(n, p, n) + square + cube
    quadratic = cube + cube + square
    cross, S, h = product(n, n, p), product(p, n, p) + Operations(add=p * p), product(p, n, 1)
    subtracted, factor, by_terms = Operations(add=p), unit_lower(p), terms_update(n, p)
    expected = {
        ("standard", "propagate"): f + quadratic,
        ("standard", "update"): gain + covariance + error + vector,
        ("larsen", "propagate_accumulate"): f + quadratic + cube,
        ("larsen", "update"): gain + error + product(n, n, 1) + vector
        + product(n, n, p) + product(n, p, n) + cube + cube + square,
        ("larsen", "gain"): gain + covariance,
        ("larsen", "correct"): error + product(n, n, 1) + vector,
        ("larsen", "compensate"): product(n, n, 1) + vector,
        ("dual-rate", "hr_restart"): f,
        ("dual-rate", "hr_propagate"): f + cube + quadratic,
        ("dual-rate", "hr_propagate_sum"): f + cube + square,
        ("dual-rate", "hr_propagate_euler"): f + cube + square,
        ("dual-rate", "hr_update"): product(n, n, 1) + vector,
        ("dual-rate", "lr_propagate"): quadratic,
        ("dual-rate", "lr_propagate_euler"): quadratic + square,
        ("dual-rate", "lr_update"): gain + covariance + error,
        ("dual-rate", "lr_gain"): gain + covariance,
        ("dual-rate", "lr_correct"): error,
        ("clone", "start"): cross + S + inverse + h,
        ("clone", "carry"): product(n, n, p),
        ("clone", "update"): product(n, p, p) + subtracted + product(n, p, 1) + vector + product(n, p, n) + square,
        ("clone", "couple"): product(p, n, p) + product(p, p, p) + product(n, p, p) + Operations(add=n * p),
        ("clone-split", "start"): cross + h,
        ("clone-split", "update"): S + factor + by_terms,
        ("carried-gain", "update"): gain + covariance + h,
        ("carried-gain", "land"): subtracted + product(n, p, 1) + vector,
        ("carried-gain", "couple"): product(p, n, p),
        ("clone", "compensate"): Operations(multiply=p * p, add=p * p),
        ("carried-gain", "compensate"): Operations(multiply=p * p, add=p * p),
        ("multirate", "state_update"): f + error + vector,
        ("multirate", "covariance_gain"): quadratic + gain + covariance + Operations(multiply=n * p),
    }  # fmt: skip
    expected["recalculate", "propagate"] = expected["recalculate", "replay"] = expected["standard", "propagate"]
    for method in ("larsen", "clone", "clone-split", "carried-gain", "px4-predictor", "fuse-as-fresh"):
        expected[method, "propagate"] = expected["standard", "propagate"]
    expected["clone-split", "carry"] = expected["carried-gain", "carry"] = expected["clone", "carry"]
    for method in ("recalculate", "delayed-horizon", "px4-predictor", "fuse-as-fresh"):
        expected[method, "update"] = expected["standard", "update"]
    for key in ("delayed-horizon", "predict"), ("delayed-horizon", "replay"), ("px4-predictor", "predict"):
        expected[key] = f
    expected["delayed-horizon", "propagate_covariance"] = quadratic
    expected["px4-predictor", "pull"] = Operations(multiply=2 * n, add=3 * n)
    expected["px4-predictor", "shift_output"] = vector
    assert {key: operations for key, operations in found.items() if key[0] != "augmentation"} == expected


PROPAGATE = [key for key in all_jobs() if "propagate" in key[1] or key[1] == "replay"]


@pytest.mark.parametrize("key", PROPAGATE, ids="-".join)
@pytest.mark.parametrize("form", ["joseph", "short"])
def test_every_form_propagates_with_as_many_operations(key: tuple[str, str], form: str) -> None:
    job, literal = all_jobs(form)[key], all_jobs("textbook")[key]
    assert count(job.function, *job.arguments(0)) == count(literal.function, *literal.arguments(0))


@pytest.mark.parametrize(("n", "u", "p"), [(9, 3, 3), (4, 2, 1), (5, 1, 4)])
def test_operations_of_the_updates_in_short_form(n: int, u: int, p: int) -> None:
    jobs = {name: method.jobs(example_system(n, u, p), "short") for name, method in ALL_METHODS.items()}
    S = product(p, n, n) + product(p, n, p) + Operations(add=p * p)
    factor, h = cholesky(p), product(p, n, 1)
    solve = Operations(p * (p - 1) * n + 2 * p * n, p * (p - 1) * n, 2 * p)
    error = product(p, n, 1) + Operations(add=p) + product(n, p, 1)
    covariance = Operations(multiply=n * n * p, add=n * n * p)
    kinds = [("standard", "update"), ("larsen", "update"), ("dual-rate", "lr_update"), ("clone", "start"),
             ("clone", "update"), ("clone", "couple"), ("clone-split", "update"),
             ("carried-gain", "update")]  # fmt: skip
    found = {key: count(job.function, *job.arguments(0)) for key in kinds for job in [jobs[key[0]][key[1]]]}
    assert found == {
        ("standard", "update"): S + factor + solve + error + covariance + Operations(add=n),
        ("larsen", "update"): S + factor + solve + error + covariance + product(n, n, 1) + Operations(add=n)
        + product(n, n, p) + product(p, n, n),
        ("dual-rate", "lr_update"): S + factor + solve + error + covariance,
        ("clone", "start"): S + unit_lower(p) + h,
        ("clone", "update"): terms_update(n, p),
        ("clone", "couple"): product(p, n, p) + Operations(p * p * p, p * p * (p - 1), p)
        + product(n, p, p) + Operations(add=n * p),
        ("clone-split", "update"): product(p, n, p) + Operations(add=p * p) + unit_lower(p) + terms_update(n, p),
        ("carried-gain", "update"): S + factor + solve + covariance + h,
    }  # fmt: skip


def test_counts_of_cloning_are_those_of_its_prototype_or_less() -> None:
    """9 states, 3 inputs, 3 measurements, `short`: propagate 3042, start 686, carry 459, update 711."""
    found = {
        name: [count(job.function, *job.arguments(0)).total for job in ALL_METHODS[name].jobs(SYSTEM, "short").values()]
        for name in ("clone", "clone-split", "carried-gain")
    }
    assert found == {
        "clone": [3042, 683, 459, 417, 363, 18],
        "clone-split": [3042, 510, 459, 590],
        "carried-gain": [3042, 1340, 459, 57, 153, 18],
    }


def test_operation_counts_reach_the_printed_tables() -> None:
    """Steffes 2014, Tables 1 to 3: 9 states, 3 inputs, 3 measurements, M = 4; standard propagate + update = 1."""
    costs = {
        (name, kind): count(job.function, *job.arguments(0)).total
        for name, method in ALL_METHODS.items()
        for kind, job in method.jobs(example_system(9, 3, 3)).items()
    }
    unit = costs["standard", "propagate"] + costs["standard", "update"]
    replayed = costs["recalculate", "update"] + 4 * costs["recalculate", "replay"]
    printed_and_counted = [
        (0.45, costs["recalculate", "propagate"]), (2.36, replayed), (0.45, costs["recalculate", "propagate"]),
        (0.66, costs["larsen", "propagate_accumulate"]), (0.66, costs["larsen", "propagate_accumulate"]),
        (0.81, costs["larsen", "update"]), (0.45, costs["larsen", "propagate"]),
        (0.04, costs["dual-rate", "hr_restart"]), (0.63, costs["dual-rate", "hr_propagate"]),
        (0.03, costs["dual-rate", "hr_update"]), (0.63, costs["dual-rate", "hr_propagate"]),
        (0.41, costs["dual-rate", "lr_propagate"]), (0.56, costs["dual-rate", "lr_update"]),
    ]  # fmt: skip
    squares = [(counted / unit - printed) ** 2 for printed, counted in printed_and_counted]
    assert math.sqrt(sum(squares) / len(squares)) < 0.05
