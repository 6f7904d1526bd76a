"""What a designer is told of a design: what it says is so, and what it offers mends it."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.accuracy import LinearModel
from sched_sim import CostTable, Task, Timing, least_speed, read_costs
from sched_sim.costs.table import Cost
from sched_sim.design.less_work import less_work
from studies.explorer.given import Given
from studies.explorer.grounds import grounds
from studies.explorer.warnings import warnings
from studies.selection.model import load_model
from studies.selection.remarks import BOUND
from tests.studies.explorer.questions import found_of

GPS = "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps"
PAPERS = "costs are those that S. Steffes printed, in steps of the standard filter: give a model, or costs of your own"


def dual_rate_costs(hr: int, restart: int, update: int) -> CostTable:
    kinds = {"hr_propagate": hr, "hr_restart": restart, "hr_update": update, "lr_propagate": 2, "lr_update": 8}
    return CostTable(
        "mine", "standard step", {"dual-rate": {kind: Cost.of(Fraction(of)) for kind, of in kinds.items()}}
    )


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("N=10&M=4&L=8", []),
        ("N=100&M=10&L=80", ["lands at 29 of the 80 you allow: L = 29 needs the same processor"]),
        ("N=100&M=10&L=80&policy=edf", ["lands at 29 of the 80 you allow"]),
        ("N=10&M=4&L=8&speed=1.2", ["lands at 5 of the 8 you allow: this processor keeps L = 5 as well"]),
        ("N=10&M=4&method=larsen", []),
        ("N=10&M=4&L=8&speed=0.7", []),
        (
            "N=10&M=4&L=8&speed=0.77",
            ["nothing is to spare: what takes longer than its cost is late; take a faster processor"],
        ),
        (
            "N=10&M=4&L=8&speed=0.79",
            ["only 2.5 % is to spare: what takes that much longer is late; take a faster one"],
        ),
    ],
)
def test_of_a_design_in_steps(query: str, said: list[str]) -> None:
    assert [*warnings(found_of(query))] == [*said, PAPERS]


@settings(max_examples=40)
@given(st.integers(2, 40), st.data(), st.sampled_from(["next-step", "same-step"]), st.sampled_from(["m", "l"]))
def test_the_landing_that_is_offered_needs_the_same(N: int, data: st.DataObject, feedback: str, by: str) -> None:
    M = data.draw(st.integers(0, N - 2))
    L = data.draw(st.integers(M + 1, N - 1))
    found = found_of(f"N={N}&M={M}&L={L}&feedback={feedback}&lr_propagate_by={by}")
    told = [int(number) for number in re.findall(r"L = (\d+) needs the same", " ".join(warnings(found)))]
    assert told == ([found.plan.landed] if found.plan.landed != L else [])
    for landed in told:
        assert least_speed(found.plan.costs, Timing(N, M, landed), found.asked.design.options) == found.plan.least


def test_no_later_landing_needs_less() -> None:
    (first, second, _) = warnings(found_of("N=10&M=4&L=30"))
    assert first == "lands at 12 of the 30 you allow: L = 12 needs the same processor"
    assert second == "L = 30 needs what L = 14 does: no later one needs less"
    assert found_of("N=10&M=4&L=14").plan.least == found_of("N=10&M=4&L=30").plan.least


def test_less_work_that_may_be_late_is_told_with_what_is_enough() -> None:
    """Of what lands at k + 1, whose HR job is another than that of other steps."""
    mine = Given(costs={"mine": dual_rate_costs(hr=2, restart=9, update=3)})
    found = found_of("N=4&M=0&L=3&costs=mine", mine)
    late = "work that takes less than its cost may land in another step and be late"
    assert f"{late}: at 12 standard steps per HR period none is" in warnings(found)
    assert less_work(found.plan.costs, found.plan.timing, found.plan.speed).holds is False
    assert less_work(found.plan.costs, found.plan.timing, 12).holds is True


@pytest.mark.parametrize(
    ("query", "said"),
    [
        (
            f"{GPS}&processor=leon3&method=larsen",
            "what leon3 takes over what is counted was never measured: time the jobs there, with the C that "
            "`sched-sim code` writes",
        ),
        (
            f"{GPS}&processor=cortex-m4f&method=larsen&hr_hz=2600".replace("hr_hz=400&", ""),
            "too slow by counts, but cortex-m4f took 0.68 to 1.05 (KFCore, STM32F429) of them, and may need only "
            "71.5 %: "
            "time the jobs there, with the C that `sched-sim code` writes",
        ),
        (
            f"{GPS}&processor=cortex-m4f&method=larsen&hr_hz=2380".replace("hr_hz=400&", ""),
            "fits by counts, but cortex-m4f took 0.68 to 1.05 (KFCore, STM32F429) of them, and may need 101 % of its "
            "speed: time the jobs there, with the C that `sched-sim code` writes",
        ),
        (
            f"{GPS}&method=px4-predictor",
            "approximate output: it follows a correction with a time constant of its own, and does not jump: clone "
            "lands "
            "as early, and is exact",
        ),
        (
            "N=10&M=4&hr_hz=400&processor=leon3",
            "costs are of 9 states, 3 inputs and 3 measurements: give a model, or costs of your own",
        ),
        (
            "model=camera&costs=counted-9-3-3",
            "costs are of 9 states and 3 measurements, camera has 3 and 1: leave costs out, and its own operations are "
            "counted",
        ),
        (
            f"{GPS}&statistic=p95",
            "statistic p95 changes nothing: each cost is one figure, counted or stated",
        ),
        (GPS.replace("measurement_hz=5", "measurement_hz=5.00001"), BOUND),
    ],
)
def test_it_is_told(query: str, said: str) -> None:
    assert said in warnings(found_of(query))


def test_a_part_that_was_measured_and_fits_either_way_is_not_doubted() -> None:
    assert warnings(found_of(f"{GPS}&processor=cortex-m4f&method=larsen")) == ()


def test_of_measured_costs_it_is_told_what_they_are(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        'name = "mine"\nunit = "us"\nbusy = "load 3 on 2 cores"\n'
        "[costs.larsen]\npropagate = { minimum = 1, median = 2, p95 = 3 }\npropagate_accumulate = 2\nupdate = 3\n",
        encoding="utf-8",
    )
    mine = Given(costs={"mine": read_costs(tmp_path / "mine.toml")})
    said = warnings(found_of("N=10&M=4&method=larsen&costs=mine", mine))
    assert said == (
        "measured on a busy machine: load 3 on 2 cores; measure again on an idle one",
        "costs are the least that was measured: statistic p95 plans with what 95 % take at most",
    )


def test_a_model_of_the_users_own_without_a_size_in_the_table_is_not_doubted() -> None:
    model = LinearModel(np.eye(1), np.eye(1), np.eye(1), np.eye(1))
    mine = Given(
        costs={"mine": dual_rate_costs(2, 1, 1)}, models={"drift": replace(load_model(model, None), name="drift")}
    )
    assert not any("states" in line for line in warnings(found_of("N=4&M=1&model=drift&output=0&costs=mine", mine)))


def test_what_figures_rest_on() -> None:
    said = grounds(found_of(f"{GPS}&processor=cortex-m4f"))
    assert said == (
        "costs: counted-9-3-3, in operations: dense counts, textbook form; measured over predicted 0.68 to 1.05 "
        "(KFCore, STM32F429) on cortex-m4f",
        "accuracy: one standard deviation of position, in the worst step of a cycle, exact for a linear model",
        "parts: the cheapest first where prices are known, else the one with the least to spare",
    )
    tasks = (Task(name, Fraction(1), Fraction(1, 100), priority=30) for name in ("control", "telemetry"))
    beside = Given(tasks=tuple(tasks))
    assert grounds(found_of("N=4&M=1&method=larsen", beside)) == (
        "costs: steffes2014, in standard steps",
        "beside it run control, telemetry",
    )
