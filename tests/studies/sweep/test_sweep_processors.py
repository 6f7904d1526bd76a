"""Sweeps over processors and HR rates, and beside the user's other tasks: what rows say, and whose they are."""

import csv
import json
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from sched_sim.schedule.task_file import read_tasks
from studies.sweep.export import export
from studies.sweep.run import run
from studies.sweep.settings import settings
from studies.sweep.workers import processes
from tests.command_line import is_refused

PART = """
name = "mine"
title = "my part"
precision = "double"
clock_mhz = 20
logic_per_arithmetic = 1
[cycles]
multiply = 2
add = 1
divide = 20
logic = 1
"""
TASKS = """
unit = "s"
[[task]]
name = "control"
period = 2
offset = 0
cost = 2e-4
priority = 5
[[task]]
name = "telemetry"
period = 5
offset = 1
cost = 1e-4
priority = 20
"""
EQUALS = """
[[task]]
name = "control"
period = 10
offset = 0
cost = 5
priority = 30
[[task]]
name = "telemetry"
period = 10
offset = 5
cost = 5
priority = 30
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(PART)
    (tmp_path / "tasks.toml").write_text(TASKS)
    (tmp_path / "equals.toml").write_text(EQUALS)
    return tmp_path


def rows_of(workers=1, **flags):
    """All rows of a sweep, as text by name of column."""
    sweep = settings(flags).sweep()
    with sweep.open(flags.pop("results", None) or sweep_file(sweep)) as store:
        run(sweep, store, processes(workers), lambda _: None)
        export(store, sweep_file(sweep, ".csv"))
    with sweep_file(sweep, ".csv").open() as file:
        return list(csv.DictReader(file))


def sweep_file(sweep, suffix=".sqlite"):

    return Path(f"{sweep.digest[:8]}{suffix}")


RATES = "50,400,1000"
PARTS = ["mine.toml", "cortex-m4f"]


@pytest.mark.parametrize("tasks", [None, "tasks.toml"])
def test_a_design_meets_its_deadlines_where_the_simulation_at_the_parts_own_speed_does(tasks):
    """The simulation knows nothing of the sweep; 40 cycles are 400 HR periods, 40 hyperperiods of the tasks."""
    rows = rows_of(N="10", M="4", L="8", method="larsen,dual-rate", processor=PARTS, hr_hz=RATES, tasks=tasks)
    assert {(row["processor"], float(row["hr_hz"])) for row in rows} == {
        (part, rate) for part in ("mine", "cortex-m4f") for rate in (50.0, 400.0, 1000.0)
    }
    others = read_tasks(Path(tasks), unit_s=1) if tasks else ()
    for row in rows:
        part = load_part("mine.toml" if row["processor"] == "mine" else row["processor"])
        costs = select(on_part(load_costs("counted-9-3-3"), part), row["method"], Options())
        timing = Timing(*(int(row[name]) for name in "NML"))
        schedule = simulate(costs, timing, 1 / Fraction(row["hr_hz"]), 40, Options(), others)
        assert (row["feasible"] == "true") == (schedule.misses == 0)
        if not schedule.misses:
            assert max(schedule.achieved) == int(row["achieved_l"])
        assert float(row["speed"]) == pytest.approx(1 / float(row["hr_hz"]))
    assert {row["feasible"] for row in rows} == {"true", "false"}


def test_without_rates_each_design_is_at_its_highest():
    (row,) = rows_of(N="10", M="4", method="larsen", processor="mine.toml")
    work = 2 * 2295 + 2124 + 4419 + 2 * 2781 + 2484 + 20 * 3 + 5268  # cycles, logic one for each
    assert row["min_speed_exact"] == str(Fraction(work, 20 * 10**6))
    assert float(row["hr_hz"]) == pytest.approx(20e6 / work)


def test_without_a_processor_there_is_no_rate():
    (row,) = rows_of(N="10", M="4", method="larsen")
    assert (row["processor"], row["hr_hz"]) == ("", "")


def test_costs_timed_in_seconds_take_rates_too(folder):
    entries = "[costs.larsen]\npropagate = 4e-4\npropagate_accumulate = 5e-4\nupdate = 5e-4\n"
    (folder / "timed.toml").write_text(f'name = "timed"\nunit = "second"\n{entries}')
    rows = rows_of(N="10", M="4", method="larsen", costs="timed.toml", hr_hz="999,1000,1001")
    assert {float(row["hr_hz"]): row["feasible"] for row in rows} == {1001.0: "false", 1000.0: "true", 999.0: "true"}


def test_tasks_of_equal_priority_are_never_below_the_load():
    """1 for the tasks, and the filter's own work of ten steps: (10 x 0.45 + 0.55) / 10, and so on."""
    rows = rows_of(N="10", M="4", L="8", method="standard,larsen", tasks="equals.toml")
    found = {row["method"]: float(row["min_speed"]) for row in rows}
    loads = {"standard": 1 + (10 * 0.45 + 0.55) / 10, "larsen": 1 + (7 * 0.45 + 3 * 0.66 + 0.81) / 10}
    assert found == {method: pytest.approx(share, rel=1e-5) for method, share in loads.items()}
    assert all(row["feasible"] == "true" for row in rows)


def test_tasks_reach_the_simulation_of_each_point_and_the_workers():
    flags = {"N": "10", "M": "2,4", "L": "8", "method": "dual-rate", "tasks": "equals.toml", "simulate": True}
    rows = rows_of(workers=2, **flags)
    assert [row["misses"] for row in rows] == ["0", "0"]
    assert all(float(row["utilization"]) > 0.9 for row in rows)
    costs, others = select(load_costs("steffes2014"), "dual-rate", Options()), read_tasks(Path("equals.toml"))
    for row in rows:
        schedule = simulate(costs, Timing(10, int(row["M"]), 8), Fraction(row["min_speed_exact"]), 3, Options(), others)
        assert float(row["utilization"]) == float(schedule.utilization)


# ------------------------------------------------------------------------------------------ whose results they are

ASKED = {"N": "10", "M": "4", "method": "larsen", "processor": "mine.toml", "hr_hz": "400", "tasks": "tasks.toml"}


def digest(**flags):
    return settings(ASKED | flags).sweep().digest


@pytest.mark.parametrize(
    ("file", "was", "becomes"),
    [
        ("mine.toml", "multiply = 2", "multiply = 3"),
        ("mine.toml", "clock_mhz = 20", "clock_mhz = 21"),
        ("mine.toml", "logic_per_arithmetic = 1", "logic_per_arithmetic = 2"),
        ("mine.toml", 'name = "mine"', 'name = "other"'),
        ("tasks.toml", "cost = 2e-4", "cost = 3e-4"),
        ("tasks.toml", "period = 2", "period = 4"),
        ("tasks.toml", "offset = 1", "offset = 2"),
        ("tasks.toml", "priority = 5", "priority = 6"),
    ],
)
def test_other_figures_of_the_part_and_other_tasks_are_another_sweep(folder, file, was, becomes):
    before = digest()
    asked = settings(ASKED).sweep()
    with asked.open(folder / "r.sqlite"):
        pass
    (folder / file).write_text((folder / file).read_text().replace(was, becomes))
    assert digest() != before
    with pytest.raises(InputError, match="belongs to another sweep"):
        settings(ASKED).sweep().open(folder / "r.sqlite")


def test_what_changes_no_row_is_the_same_sweep(folder):
    before = digest()
    (folder / "mine.toml").write_text(PART.replace("my part", "the part on my desk") + "# a comment\n")
    (folder / "tasks.toml").rename(folder / "others.toml")
    assert digest(tasks="others.toml") == before


@pytest.mark.parametrize("flag", [{"hr_hz": "401"}, {"hr_hz": None}, {"tasks": None}, {"processor": "leon3"}])
def test_other_parts_rates_and_no_tasks_are_another_sweep(flag):
    assert digest(**flag) != digest()


def test_a_sweep_goes_on_where_it_ended(folder):
    asked = settings(ASKED | {"M": "1:6", "hr_hz": "100,400"}).sweep()
    with asked.open(folder / "r.sqlite") as store:
        run(asked, store, processes(1), lambda _: None)
        whole = store.query("SELECT * FROM results ORDER BY point")
        with store._connection:
            store._connection.execute("DELETE FROM rows WHERE point % 3 = 1")
    with asked.open(folder / "r.sqlite") as store:
        outcome = run(asked, store, processes(1), lambda _: None)
        assert (outcome.before, outcome.computed) == (8, 4)
        assert store.query("SELECT * FROM results ORDER BY point") == whole


def test_a_grid_file_says_the_same_and_its_files_lie_beside_it(folder):
    (folder / "grids").mkdir()
    for name in ("mine.toml", "tasks.toml"):
        (folder / name).rename(folder / "grids" / name)
    (folder / "grids" / "grid.toml").write_text(
        'N = 10\nM = 4\nmethod = "larsen"\nprocessor = ["mine.toml", "leon3"]\nhr_hz = ["100:400:100", 50]\n'
        'tasks = "tasks.toml"\n'
    )
    flags = {"processor": ["grids/mine.toml", "leon3"], "hr_hz": "50,100:400:100", "tasks": "grids/tasks.toml"}
    assert settings({}, folder / "grids" / "grid.toml").sweep().digest == digest(**flags)
    assert settings({"hr_hz": "400"}, folder / "grids" / "grid.toml").sweep().grid.speeds == (Fraction(1, 400),)


# ------------------------------------------------------------------------------------------------- on the command line


def test_the_tables_name_processor_rate_and_covariance_update(sched_sim):
    line = "sweep -N 10 -M 4 --method larsen --processor leon3 --processor cortex-m4f --hr-hz 400"
    document = json.loads(sched_sim(f"{line} --format json").out)
    assert document["update_form"] == {
        "counted-9-3-3 on leon3": "textbook",
        "counted-9-3-3 on cortex-m4f": "textbook",
    }
    for row in document["best"]:
        limit = f"minimum -N 10 -M 4 --method larsen --processor {row['processor']} --hr-hz 400 --format json"
        (found,) = json.loads(sched_sim(limit).out)
        assert row["highest_hr_hz"] == pytest.approx(400 / found["needed_share"])  # at the same N and M
    table = sched_sim(line).out
    assert "covariance update: textbook (Eq. 11)" in table
    assert " 2476 " in table  # 2476.1, rounded down
    beside = sched_sim(f"{line} --tasks tasks.toml").out
    assert "the tasks of --tasks take the same seconds on every processor" in beside


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("--processor leon3 --speed 1", ["--speed", "--processor", "exclude each other", "--hr-hz"]),
        ("--hr-hz 400 --speed 1", ["--speed", "--hr-hz", "exclude each other"]),
        ("--hr-hz 400", ["--hr-hz", "steffes2014", "seconds", 'unit = "second"', "--processor"]),
        ("--processor leon3 --hr-hz 0", ["--hr-hz", "'0'", "greater than 0"]),
        ("--processor leon3 --hr-hz fast", ["--hr-hz", "'fast'", "finite number"]),
        ("--processor leon4", ["--processor 'leon4'", "leon3", "path of a TOML file"]),
        ("--processor leon3 --processor leon3.toml", ["--processor 'leon3.toml'", "not found"]),
        ("--processor mine.toml --processor twin.toml", ["counted-9-3-3 on mine", "`name` of its own"]),
        ("--processor leon3 --costs steffes2014", ["steffes2014", "no operation counts", "counted-9-3-3"]),
        ("--processor patent --method multirate-square-root", ["patent", "no time for sqrt"]),
        ("--tasks none.toml", ["--tasks", "none.toml", "path of a TOML file"]),
        ("--tasks two.toml", ["task 'control'", "cpu 2", "--cpus 2"]),
        ("--tasks odd.toml", ["control 7.12346", "common grid with N=10"]),
        ("--tasks equals.toml --costs steffes2014 --costs counted-9-3-3", ["standard step and operation", "--costs"]),
        ("numbers.toml", ["grid file", "processor", "7", "name of a shipped processor"]),
        ("list.toml", ["grid file", "tasks", "path of a TOML file"]),
        ("--tasks equals.toml --results equals.toml", ["--results equals.toml", "--tasks equals.toml reads"]),
        ("--processor mine.toml --results mine.toml", ["--results mine.toml", "--processor mine.toml reads"]),
    ],
)
def test_wrong_input_is_refused_before_anything_is_written(sched_sim, folder, line, said):
    (folder / "two.toml").write_text(EQUALS.replace("priority = 30", "priority = 30\ncpu = 2", 1))
    (folder / "odd.toml").write_text(TASKS.removeprefix('\nunit = "s"').replace("period = 2", "period = 7.123457"))
    (folder / "twin.toml").write_text(PART)
    (folder / "numbers.toml").write_text("processor = 7\n")
    (folder / "list.toml").write_text('tasks = ["tasks.toml"]\n')
    before = {path: path.read_bytes() for path in folder.iterdir()}
    is_refused(sched_sim(f"sweep {line} -N 10 -M 4"), said)
    assert {path: path.read_bytes() for path in folder.iterdir()} == before
