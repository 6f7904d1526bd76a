"""What emulated cores say anew: the known loop, shipped instructions, published jobs, whole folders."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

from reports.embedded.results import shipped
from reports.pages.stored import records
from sched_sim.costs.table import CostTable
from studies.embedded.folders import folder
from studies.embedded.known_loop import INSTRUCTIONS, check
from studies.embedded.published import instructions, times_us
from studies.measurement.emulation.targets import TARGETS
from studies.measurement.emulation.toolchain import versions
from studies.measurement.published_timings import PublishedTiming, published_timings
from tests.boards import needs_board

stored = cache(shipped)


def table(target: str, *methods: str) -> CostTable:
    """Shipped, of these methods, or of all."""
    whole = stored()[0][target, "textbook"]
    return replace(whole, costs={method: whole.costs[method] for method in methods or whole.costs})


def as_shipped(target: str) -> None:
    """Skips where other instructions may be right."""
    about = table(target).provenance
    if versions() != {name: about[name] for name in ("compiler", "emulator")}:
        pytest.skip("another compiler or emulator than the shipped instructions are of")


@needs_board
def test_shipped_instructions_are_counted_again_and_others_are_seen() -> None:
    as_shipped("cortex-m4f")
    whole = table("cortex-m4f", "standard")
    costs = whole.costs["standard"]
    other = replace(whole, costs={"standard": {**costs, "update": costs["update"] / Fraction(2)}})
    assert check(TARGETS["cortex-m4f"], other) == ("cortex-m4f", (INSTRUCTIONS, INSTRUCTIONS), 2, 1)


@needs_board
@pytest.mark.exhaust
@pytest.mark.parametrize("target", TARGETS)
def test_all_shipped_instructions_are_counted_again(target: str) -> None:
    as_shipped(target)
    assert check(TARGETS[target], table(target)) == (target, (INSTRUCTIONS, INSTRUCTIONS), 41, 0)


def of(source: str, job: str) -> PublishedTiming:
    return next(timing for timing in published_timings() if (timing.source, timing.job) == (source, job))


@needs_board
def test_published_jobs_run_on_the_core_of_their_part() -> None:
    as_shipped("cortex-m7")
    step = next(timing for timing in published_timings() if timing.job == "step" and timing.states == 2)
    (row,) = [row for row in records(stored()[1]["boards"]) if (row["job"], row["states"]) == ("step", "2")]
    assert instructions(step) == int(row["instructions"])


def test_a_part_of_which_no_core_is_emulated_has_no_instructions() -> None:
    assert instructions(of("ESP-DSP", "dot product")) is None


def test_instructions_take_the_cycles_that_the_part_states() -> None:
    """1 to 2.65 cycles at 180 MHz."""
    assert times_us(of("KFCore", "predict"), 360) == (2, Fraction("5.3"))


@pytest.mark.parametrize(
    ("source", "job"),
    [
        ("KFCore", "predict"),
        ("KFCore", "update, short"),
        ("KFCore", "U-D predict"),
        ("KFCore", "U-D update"),
        ("eskf-rs", "predict, sparse"),
    ],
)
def test_what_was_timed_of_a_job_as_it_is_written_lies_in_the_range(source: str, job: str) -> None:
    timing = of(source, job)
    (row,) = [row for row in records(stored()[1]["boards"]) if (row["source"], row["job"]) == (source, job)]
    least, most = times_us(timing, int(row["instructions"]))
    assert least <= timing.least_us <= timing.most_us <= most


@needs_board
def test_a_folder_compiles_to_what_is_shipped() -> None:
    as_shipped("cortex-m4f")
    found = folder("standard", "single")
    (row,) = [row for row in records(stored()[1]["folders"]) if (row["method"], row["precision"]) == found[:2]]
    assert (str(found.code), str(found.ram)) == (row["code"], row["ram"])
