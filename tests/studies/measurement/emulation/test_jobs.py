"""Jobs on emulated cores: the numbers of native C, and counts that say of methods what counted operations say."""

from __future__ import annotations

from functools import cache
from types import FunctionType

import numpy as np
import pytest

from filters.backends.choose import arguments_for, function_for
from filters.covariance_forms import COVARIANCE_FORMS, CovarianceFormName
from filters.jobs import Job
from filters.registry import ALL_METHODS
from filters.systems.example import example_system
from filters.translation.kinds import kind_of
from filters.translation.unit import Unit
from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from studies.measurement.emulation.jobs import as_shown, emulate
from studies.measurement.emulation.memory import memory_of
from studies.measurement.emulation.targets import TARGETS
from studies.measurement.methods import measure
from tests.boards import needs_board
from tests.c_compiler import has_c

pytestmark = needs_board

SMALL = example_system(3, 1, 2)
KINDS = {"standard": ("propagate", "update"), "dual-rate": ("hr_propagate", "lr_update")}


def jobs(method: str) -> dict[str, Job]:
    every = ALL_METHODS[method].jobs(SMALL, "textbook", 0, None)
    return {kind: every[kind] for kind in KINDS[method]}


def shown_by_native(job: Job, index: int) -> bytes:
    """What is in its arguments after a run as C on this machine."""
    assert isinstance(job.function, FunctionType)
    arguments = job.arguments(index)
    function_for("c", job.function)(*arguments_for("c", arguments))
    translated = Unit("double").function(job.function, tuple(map(kind_of, arguments)))
    given = zip(translated.parameters, arguments, strict=True)
    return as_shown(tuple(value for name, value in given if name in translated.used), "double")


@pytest.mark.skipif(not has_c(), reason="there is no C compiler")
@pytest.mark.parametrize("target", ["cortex-m7", "cortex-m4-soft"])
@pytest.mark.parametrize("method", KINDS)
def test_doubles_are_those_of_native_c_to_the_last_bit(method: str, target: str) -> None:
    found = emulate(jobs(method), TARGETS[target], "double", sets=2, shows=True)
    for kind, job in jobs(method).items():
        for index in range(2):
            assert found[kind].shown[index] == shown_by_native(job, index)


@pytest.mark.parametrize("target", ["cortex-m4f", "cortex-m33"])
def test_floats_are_those_of_doubles_rounded(target: str) -> None:
    found = emulate(jobs("standard"), TARGETS[target], "single", sets=1, shows=True)
    for kind, job in jobs("standard").items():
        arguments = job.arguments(0)
        job.function(*arguments)
        expected = np.frombuffer(as_shown(arguments, "single"), np.float32)
        np.testing.assert_allclose(np.frombuffer(found[kind].shown[0], np.float32), expected, rtol=1e-4, atol=1e-5)


def test_two_runs_are_the_same() -> None:
    target = TARGETS["cortex-m4-soft"]
    once, again = (emulate(jobs("standard"), target, "double", sets=2) for _ in range(2))
    assert once == again
    assert once["propagate"].instructions[0] > 100


NINE, IN_ORDER = example_system(9, 3, 3), ["standard", "recalculate", "larsen", "dual-rate"]


@cache
def by_operations() -> CostTable:
    return measure(NINE, "counted", name="any", methods=IN_ORDER).normalised()


@pytest.mark.parametrize("target", ["cortex-m4f", pytest.param("cortex-m7", marks=pytest.mark.exhaust)])
def test_instructions_rank_methods_as_counted_operations_do(target: str) -> None:
    """N = 10, M = 4, L = 8, nine states: least speeds in standard steps differ by less than 2 %."""
    emulated = measure(NINE, "emulated", name="any", methods=IN_ORDER, target=target).normalised()
    for method in IN_ORDER[1:]:
        by_counts, by_instructions = (
            float(least_speed(select(table, method, Options()), Timing(10, 4, 8), Options()).speed)
            for table in (by_operations(), emulated)
        )
        assert by_instructions == pytest.approx(by_counts, rel=0.02)


@pytest.mark.exhaust
@pytest.mark.skipif(not has_c(), reason="there is no C compiler")
@pytest.mark.parametrize("form", COVARIANCE_FORMS)
@pytest.mark.parametrize("target", ["cortex-m7", "cortex-m4-soft"])
def test_every_job_gives_the_bits_of_native_c(target: str, form: CovarianceFormName) -> None:
    for method in ALL_METHODS.values():
        every = method.jobs(SMALL, form, 0, None)
        found = emulate(every, TARGETS[target], "double", sets=1, shows=True)
        for kind, job in every.items():
            assert found[kind].shown[0] == shown_by_native(job, 0)


def test_a_parameter_that_no_float_holds_is_refused() -> None:
    large = SMALL._replace(parameters=SMALL.parameters._replace(Q=1e60 * SMALL.parameters.Q))
    job = ALL_METHODS["standard"].jobs(SMALL, "textbook", 0, None)["propagate"]
    with_large = job._replace(arguments=lambda index: (large, *job.arguments(index)[1:]))
    with pytest.raises(ValueError, match=r"parameter .*e\+5.*, too large for single precision"):
        emulate({"propagate": with_large}, TARGETS["cortex-m4f"], "single", sets=1)


def test_memory_of_the_dual_rate_filter_is_that_of_its_arrays_by_task() -> None:
    """HR and LR have a workspace each, and three transitions are there in all: LR reads one while HR fills two."""
    n, m, p = SMALL.states, SMALL.inputs, SMALL.measurements
    every = ALL_METHODS["dual-rate"].jobs(SMALL, "textbook", 0, None)
    target = TARGETS["cortex-m4f"]
    memory = memory_of("dual-rate", every, emulate(every, target, "single", sets=1), target, "single")
    work, transition, estimate = 4 * n * n + 4 * n * p + 3 * p * p + n + p, 2 * n * n, n + n * n
    assert memory["HR"]["ram"] == 4 * (work + 2 * transition + 4 * n + m)
    assert memory["LR"]["ram"] == 4 * (work + transition + n * n + estimate + p + (p + n * p + n))
    assert memory["model"] == {"code": 4 * sum(array.size for array in SMALL.parameters), "ram": 0, "stack": 0}
    assert all(0 < memory[task][what] < 4096 for task in ("HR", "LR") for what in ("code", "stack"))
