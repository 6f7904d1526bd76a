"""The processor question on the command line: MHz, load, yes or no; and what wrong input gets."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table_file import costs_text, load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part, shipped_parts
from tests.command_line import Run, is_refused

MY_PART = """\
name = "mine"
title = "my own part"
precision = "double"
clock_mhz = 100
logic_per_arithmetic = 0

[cycles]
multiply = { cycles = 2, source = "its data sheet" }
add = { cycles = 1, source = "its data sheet" }
divide = { cycles = 10, source = "its data sheet" }
"""


def test_the_patents_three_numbers_in_one_command(sched_sim: Run) -> None:
    """Covariance every 5 s, four measurements a second: 166,870 us / 5 s + 7,626 us / 1 s, printed 4.1 %."""
    line = "minimum -N 5 --costs patent-multirate --processor patent --hr-hz 1 --format json"
    (row,) = json.loads(sched_sim(line).out)
    assert row["method"] == "multirate"
    assert row["load"] == 0.041
    assert row["fits"] is True
    assert row["needed_mhz"] is None


def test_minimum_on_a_processor_is_the_least_speed_times_the_rate_times_the_clock(sched_sim: Run) -> None:
    part = load_part("cortex-m7")
    costs = select(on_part(load_costs("counted-9-3-3"), part), "dual-rate", Options())
    least = least_speed(costs, Timing(40, 20, 40)).speed
    line = "minimum -N 40 -M 20 --processor cortex-m7 --hr-hz 400 --method dual-rate --format json"
    (row,) = json.loads(sched_sim(line).out)
    assert row["needed_mhz"] == pytest.approx(float(least * 400 * part.clock_hz / 10**6), rel=1e-12)
    assert row["slack"] == pytest.approx(1 - row["needed_share"])


@pytest.mark.parametrize("hr_hz", ["50", "2000", "200000"])
@pytest.mark.parametrize("method", ["recalculate", "dual-rate"])
def test_yes_or_no_is_what_the_simulation_at_the_parts_own_speed_says(sched_sim: Run, hr_hz: str, method: str) -> None:
    line = f"minimum -N 40 -M 20 --processor cortex-m7 --hr-hz {hr_hz} --method {method} --format json"
    (row,) = json.loads(sched_sim(line).out)
    costs = select(on_part(load_costs("counted-9-3-3"), load_part("cortex-m7")), method, Options())
    schedule = simulate(costs, Timing(40, 20, 40), 1 / Fraction(hr_hz), cycles=4)
    assert row["fits"] == (schedule.misses == 0)
    assert not row["fits"] or schedule.achieved == {row["achieved_l"]: 4}


def test_processors_lists_what_is_shipped(sched_sim: Run) -> None:
    rows = json.loads(sched_sim("processors --format json").out)
    assert [row["processor"] for row in rows] == shipped_parts()
    assert {"patent", "cortex-m4f", "cortex-m7", "cortex-a53", "desktop"} <= set(shipped_parts())
    table = sched_sim("processors").out
    assert all(name in table for name in shipped_parts())


def test_processors_says_which_can_run_a_method_and_with_what_slack(sched_sim: Run) -> None:
    rows = json.loads(sched_sim("processors -N 40 -M 20 --hr-hz 400 --format json").out)
    verdicts = {row["processor"]: row["fits"] for row in rows}
    assert verdicts["patent"] is False
    assert verdicts["desktop"] is True
    for row in rows:
        assert row["fits"] == (row["slack"] >= 0)


def test_a_processor_without_a_time_for_an_operation_is_listed_with_the_reason(sched_sim: Run) -> None:
    line = "processors -N 5 --hr-hz 1 --method multirate-square-root"
    rows = {row["processor"]: row for row in json.loads(sched_sim(f"{line} --format json").out)}
    assert rows["patent"]["fits"] is None
    assert "sqrt" in rows["patent"]["reason"]
    assert rows["desktop"]["fits"] is True
    assert "sqrt" in sched_sim(line).out


def test_a_processor_of_ones_own_by_path(sched_sim: Run, tmp_path: Path) -> None:
    """Standard: 3294 multiplies, 3024 adds, 3 divides a step at 100 MHz."""
    (tmp_path / "mine.toml").write_text(MY_PART)
    (row,) = json.loads(sched_sim("minimum -N 10 -M 4 --processor mine.toml --method standard --format json").out)
    assert row["min_speed_exact"] == str(Fraction(2 * 3294 + 3024 + 10 * 3, 100 * 10**6))


def test_simulate_and_gantt_run_at_the_parts_own_speed(sched_sim: Run, tmp_path: Path) -> None:
    design = "-N 10 -M 4 --processor cortex-m7 --hr-hz 400"
    found = json.loads(sched_sim(f"simulate {design} --format json").out)
    (row,) = json.loads(sched_sim(f"minimum {design} --method dual-rate --format json").out)
    assert found["achieved_l"] == [row["achieved_l"]] * 3
    assert sched_sim(f"gantt {design} -o g.svg").code == 0
    assert "HR period 2.5 ms" in (tmp_path / "g.svg").read_text()


def test_the_printed_limits_hold(sched_sim: Run) -> None:
    """A rate is rounded down, a clock up: at the printed rate the part still does."""
    times = "--measurement-hz 5 --delay-ms 100 --land-within-ms 150"
    line = f"minimum {times} --processor cortex-m4f --method dual-rate"
    assert " 5239 " in sched_sim(f"{line} --hr-hz 400").out
    assert json.loads(sched_sim(f"{line} --hr-hz 5239 --format json").out)[0]["fits"] is True
    assert json.loads(sched_sim(f"{line} --hr-hz 5240 --format json").out)[0]["fits"] is False
    assert "101 %" in sched_sim(f"{line} --hr-hz 5240").out


def test_a_note_keeps_what_stands_in_brackets(sched_sim: Run, tmp_path: Path) -> None:
    text = costs_text(replace(load_costs("counted-9-3-3"), name="mine", provenance={"update_form": "of [ours]"}))
    (tmp_path / "mine.toml").write_text(text)
    line = "processors -N 10 -M 4 --hr-hz 100 --costs mine.toml --processor leon3"
    assert "covariance update: of [ours]" in sched_sim(line).out


def test_the_load_with_context_switches_is_the_simulated_one(sched_sim: Run) -> None:
    line = "-N 40 -M 20 --hr-hz 400 --processor cortex-m7 --method dual-rate --context-switch 0.00001 --format json"
    (row,) = json.loads(sched_sim(f"minimum {line}").out)
    assert row["load"] == pytest.approx(json.loads(sched_sim(f"simulate {line}").out)["utilization"], rel=0.05)


def test_without_a_method_named_those_that_are_possible_are_shown(sched_sim: Run) -> None:
    """IMU 400 Hz, GPS 10 Hz, 100 ms late: M = N, and the dual-rate filter lands by 2N; 150 ms late, and a table has no
    costs of Larsen's method for several on their way."""
    result = sched_sim("minimum -N 40 -M 40 --processor cortex-m7 --hr-hz 400 --format json")
    found = {row["method"]: row["L"] for row in json.loads(result.out)}
    assert [*found] == [method for method in DELAYED_METHODS if method != "delayed-horizon"]
    assert (found["larsen"], found["dual-rate"]) == (40, 80)
    assert "no delayed-horizon" in result.err
    result = sched_sim("minimum -N 40 -M 60 --hr-hz 400 --format json")
    assert [row["method"] for row in json.loads(result.out)] == ["standard", "recalculate", "dual-rate"]
    assert "no larsen" in result.err


def test_processors_csv_has_a_column_for_each_figure(sched_sim: Run) -> None:
    rows = list(csv.DictReader(io.StringIO(sched_sim("processors --format csv").out)))
    assert all(float(row["seconds_multiply"]) > 0 and row["sources_multiply"] for row in rows)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("minimum -N 10 -M 4 --processor z80", ["processor", "z80", "cortex-m7"]),
        ("minimum -N 10 -M 4 --processor none.toml", ["none.toml", "cortex-m7"]),
        ("minimum -N 10 -M 4 --processor no-add.toml", ["no-add.toml", "add", "[cycles]"]),
        ("minimum -N 10 -M 4 --processor stopped.toml", ["stopped.toml", "multiply", "0"]),
        ("minimum -N 10 -M 4 --processor no-clock.toml", ["no-clock.toml", "clock_mhz"]),
        ("minimum -N 10 -M 4 --processor patent --costs steffes2014", ["steffes2014", "operation counts", "counted"]),
        ("minimum -N 5 --processor patent --method multirate-square-root", ["patent", "sqrt"]),
        ("minimum -N 0 --method multirate", ["N=0", "at least 1"]),
        ("minimum -N 5 -L 0 --method multirate --costs patent-multirate", ["L=0", "at least 1"]),
        ("minimum -N 5 --processor patent", ["-M", "missing"]),
        ("minimum -N 5 -M 9 --method multirate --costs patent-multirate", ["-M 9", "no delay"]),
        ("simulate -N 10 -M 4 --processor cortex-m7 --hr-hz 400 --speed 1", ["--speed", "exclude", "--hr-hz"]),
        ("minimum -N 10 -M 4 --costs larsen.toml --processor patent --method dual-rate", ["[operations.dual-rate]"]),
        ("minimum -N 10 -M 4 --processor leon3 --costs empty.toml", ["[operations.larsen] has no entry", "propagate"]),
        ("gantt -N 10 -M 4 -o g.svg --processor leon3 --costs empty.toml", ["[operations.larsen] has no entry"]),
        ("minimum -N 10 -M 4 --tasks urgent.toml", ["priority: must be a whole number", "cpu", "which is text"]),
        ("processors -M 20", ["-N", "missing"]),
        ("processors -N 10 -M 4", ["--hr-hz", "missing"]),
        ("processors --hr-hz 400", ["-N", "missing"]),
        ("processors -N 10 -M 4 --hr-hz 0", ["--hr-hz", "greater than 0"]),
        ("processors --processor z80", ["z80", "cortex-m7"]),
    ],
)
def test_wrong_input_ends_with_code_2_and_one_message(
    sched_sim: Run, tmp_path: Path, line: str, said: list[str]
) -> None:
    (tmp_path / "no-add.toml").write_text(MY_PART.replace("add =", "# add ="))
    (tmp_path / "stopped.toml").write_text(MY_PART.replace("cycles = 2", "cycles = 0"))
    (tmp_path / "no-clock.toml").write_text(MY_PART.replace("clock_mhz = 100\n", ""))
    (tmp_path / "larsen.toml").write_text(
        'name = "l"\nunit = "operation"\n[operations.larsen]\npropagate = { add = 1 }\n'
    )
    (tmp_path / "empty.toml").write_text('name = "e"\nunit = "operation"\n[operations.larsen]\n')
    (tmp_path / "urgent.toml").write_text('[[task]]\nname = "t"\nperiod = 2\ncost = 0.1\npriority = true\ncpu = "1"\n')
    is_refused(sched_sim(line), said)


def test_beside_tasks_whose_seconds_are_given_no_clock_is_named(sched_sim: Run, tmp_path: Path) -> None:
    """A higher clock would make the filter faster, and not them."""
    (tmp_path / "tasks.toml").write_text('[[task]]\nname = "control"\nperiod_ms = 4\ncost_us = 250\npriority = 5\n')
    line = "minimum --hr-hz 400 --measurement-hz 5 --delay-ms 110 --processor cortex-m4f --tasks tasks.toml"
    assert "MHz  " not in sched_sim(line).out
    assert all(row["needed_mhz"] is None for row in json.loads(sched_sim(f"{line} --format json").out))


def test_the_highest_rate_says_where_it_has_the_offset_that_is_given(sched_sim: Run, tmp_path: Path) -> None:
    task = '[[task]]\nname = "control"\nperiod_ms = 5\ncost_ms = 0.6\npriority = 5\n'
    said = "highest HR Hz: with the offset of control at rates at which its period is whole HR periods; at others"
    for command in ("minimum", "processors"):
        line = f"{command} --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method larsen --processor cortex-m7"
        for more, given in (("", False), ("offset_ms = 2.5\n", True)):
            (tmp_path / "tasks.toml").write_text(task + more)
            assert (said in sched_sim(f"{line} --tasks tasks.toml").out) is given
        assert "the offset of" not in sched_sim(line).out
