"""The command lines and the lines of Python of a design give its figures: both are run, and compared with the view."""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from fractions import Fraction
from io import StringIO
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim import CostTable, Task, load_part, read_costs
from sched_sim.cli import main
from studies.explorer.answer import DesignFound
from studies.explorer.commands import Commands, commands
from studies.explorer.given import Given
from studies.selection.model import load_model
from tests.studies.explorer.questions import found_of

GPS = "hr_hz=400&measurement_hz=5&delay_ms=110"


@contextmanager
def in_a_folder() -> Iterator[Path]:
    before = Path.cwd()
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield Path(folder)
        finally:
            os.chdir(before)


def run(line: str) -> Any:
    """What a command line says, in JSON; the text of its error where it is refused."""
    out, said, words = StringIO(), StringIO(), shlex.split(line)
    about = [] if words[1] == "measure" else ["--format", "json"]
    with patch.object(sys, "argv", [*words, *about]), redirect_stdout(out), redirect_stderr(said):
        code = exit_code()
    assert code in (0, 2), said.getvalue()
    if code:
        return said.getvalue()
    return json.loads(out.getvalue()) if about else None


def exit_code() -> int:
    try:
        main()
    except SystemExit as stop:
        return int(stop.code or 0)
    return 0


def check(found: DesignFound) -> None:
    """Runs all that is said of a design."""
    said, plan, asked = commands(found.asked, found.plan), found.plan, found.asked
    std = None if found.figures is None else found.figures.at(plan.landed)
    kept = found.kept.get(plan.method)
    for line in said.shell.split("\n"):
        command, got = shlex.split(line)[1], run(line)
        if command == "minimum":
            (row,) = got
            assert Fraction(row["min_speed_exact"]) == plan.least.speed * (unit_s(found) if "fits" in row else 1)
            assert (row["binding"], row["L"]) == (plan.least.binding, plan.timing.L)
            assert asked.part is None or row["fits"] == plan.fits
        elif command == "simulate":
            assert Fraction(got["speed_exact"]) == plan.speed
            assert got["misses"] == found.timeline.misses
        elif command == "accuracy":
            (row,) = got
            assert row["worst_std" if asked.design.metric == "worst" else "rms_std"] == pytest.approx(std)
        elif command == "design":
            assert kept is not None
            designs = {} if isinstance(got, str) else {of["method"]: of for of in got["designs"]}
            assert (plan.method in designs) == (kept.least is not None)
            for of in designs.values():
                if of["L"] > plan.timing.N == kept.L:  # the explorer looks no further than the next measurement
                    continue
                assert (of["L"], of["std"]) == (kept.L, pytest.approx(kept.std))
                does = [on["processor"] for on in of["parts"] if on["fits"]]
                first = asked.design.processor if asked.design.processor in does else next(iter(does), None)
                assert first == (None if kept.cheapest is None else kept.cheapest.name)
    check_python(found, said.python)


def check_python(found: DesignFound, text: str) -> None:
    names: dict[str, Any] = {}
    with redirect_stdout(StringIO()) as out:
        exec(text, names)
    assert repr(found.plan.least) in out.getvalue()
    assert names["schedule"].misses == found.timeline.misses
    if "compare_accuracy(" in (last := text.split("\n")[-1]):
        (row,) = eval(last.removeprefix("print(")[:-1], names).rows
        assert found.figures is not None
        figure = row.accuracy.worst if found.asked.design.metric == "worst" else row.accuracy.rms
        assert figure == pytest.approx(found.figures.at(found.plan.landed))


def unit_s(found: DesignFound) -> Fraction:
    pace = found.asked.machine_pace
    assert pace is not None
    assert found.asked.rate is not None
    return 1 / (pace * found.asked.rate)


@st.composite
def queries(draw: st.DrawFn) -> str:
    """Of short cycles; in steps or at rates, with a part or a speed, a model and what is asked of it."""
    N = draw(st.integers(3, 12))
    M = draw(st.integers(0, N - 1))
    method = draw(st.sampled_from(["dual-rate", "larsen", "clone", "recalculate", "px4-predictor", "standard"]))
    said = {"method": method, "cycles": draw(st.sampled_from([1, 2]))}
    rated = draw(st.booleans())
    if rated:
        rate = draw(st.sampled_from([100, 400, Fraction(1001, 3)]))
        said["hr_hz"] = rate
        said |= {"measurement_hz": rate / Fraction(N)} if draw(st.booleans()) else {"N": N}
        said |= {"delay_ms": 1000 * M / Fraction(rate)} if draw(st.booleans()) else {"M": M}
    else:
        said |= {"N": N, "M": M}
    if draw(st.booleans()):
        said["L"] = draw(st.integers(M + 1, N))
    said["costs"] = "counted-9-3-3"
    if rated and draw(st.booleans()):
        said["processor"] = draw(st.sampled_from(["leon3", "rp2040", "cortex-m7"]))
    elif draw(st.booleans()):
        said["speed"] = draw(st.sampled_from([3000, Fraction(20_001, 3), 200_000]))
    if method == "dual-rate":
        said["gain"] = draw(st.sampled_from(["at-update", "precomputed"]))
        said["lr_propagate_by"] = draw(st.sampled_from(["m", "l"]))
        said["low_rate_noise"] = draw(st.sampled_from(["exact", "sum", "euler"]))
        said["cpus"] = draw(st.sampled_from([1, 2]))
    if draw(st.booleans()) and (rated or method != "px4-predictor"):
        said["model"] = "ins-gps"
        said["metric"] = draw(st.sampled_from(["worst", "rms"]))
        said |= {"within": draw(st.sampled_from(["0.3", "0.36", "0.4"]))} if draw(st.booleans()) else {}
        said |= {"output": "velocity"} if draw(st.booleans()) else {}
    return "&".join(f"{name}={value}" for name, value in said.items())


@settings(max_examples=15)
@given(queries())
def test_both_give_the_figures_of_the_design(query: str) -> None:
    with in_a_folder():
        check(found_of(query))


@pytest.mark.exhaust
@settings(max_examples=400)
@given(queries())
def test_both_give_the_figures_of_many_designs(query: str) -> None:
    with in_a_folder():
        check(found_of(query))


@pytest.mark.parametrize(
    "query",
    [
        "N=10&M=4&L=8",
        GPS,
        f"{GPS}&model=ins-gps&within=0.38",
        f"{GPS}&processor=leon3&model=ins-gps&within=0.4&method=clone",
        "model=camera&within=0.2&method=larsen",
        "hr_hz=400&measurement_hz=30&delay_ms=33.3&method=dual-rate&costs=steffes2014",
        "N=10&M=4&method=larsen&context_switch=1/7&policy=edf",
    ],
)
def test_of_designs_as_people_have_them(query: str) -> None:
    with in_a_folder():
        check(found_of(query))


def test_in_words() -> None:
    of = found_of(f"{GPS}&model=ins-gps&within=0.38&processor=leon3&gain=precomputed")
    assert commands(of.asked, of.plan) == Commands(
        "sched-sim minimum --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method dual-rate --costs counted-9-3-3 "
        "--processor leon3 --gain precomputed\n"
        "sched-sim simulate --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method dual-rate --costs counted-9-3-3 "
        "--processor leon3 --gain precomputed --cycles 1\n"
        "sched-sim accuracy --model ins-gps --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method dual-rate -L 45\n"
        "sched-sim design --within 0.38 --model ins-gps --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method "
        "dual-rate "
        "--every 1 --costs counted-9-3-3 --low-rate-noise exact --gain precomputed --lr-propagate-by m "
        "--feedback next-step",
        "from sched_sim import Options, Timing, least_speed, load_costs, load_part, on_part, select, simulate\n"
        "from studies import compare_accuracy\n"
        "options = Options(gain='precomputed')\n"
        "costs, timing = select(on_part(load_costs('counted-9-3-3'), load_part('leon3')), 'dual-rate', options), "
        "Timing(80, 44, 80)\n"
        "schedule = simulate(costs, timing, '0.0025', 1, options=options)\n"
        "print(least_speed(costs, timing, options=options), schedule.achieved, schedule.misses)\n"
        "print(compare_accuracy('ins-gps', hr_hz=400, measurement_hz=5, delay_ms=110, L=45, methods=['dual-rate'], "
        "options=options))",
    )
    steffes = found_of("N=10&M=4&L=8")
    assert commands(steffes.asked, steffes.plan).python == (
        "from sched_sim import Timing, least_speed, load_costs, select, simulate\n"
        "costs, timing = select(load_costs('steffes2014'), 'dual-rate'), Timing(10, 4, 8)\n"
        "schedule = simulate(costs, timing, '0.77', 1)\n"
        "print(least_speed(costs, timing), schedule.achieved, schedule.misses)"
    )


NASTY = 'it\'s a "table"; $(rm -rf x) & `y` \\ *.toml'


def own_files(folder: Path) -> Given:
    """Files with a name that every shell would take apart, given as a user gives them."""
    costs, part, tasks = (folder / f"{kind} {NASTY}" for kind in ("costs", "part", "tasks"))
    costs.write_text(
        'name = "mine"\nunit = "operation"\n[operations.larsen]\npropagate = { multiply = 9 }\n'
        "propagate_accumulate = { multiply = 20 }\nupdate = { multiply = 30 }\n",
        encoding="utf-8",
    )
    part.write_text(
        'name = "part"\ntitle = "mine"\nprecision = "single"\nclock_mhz = 1\nlogic_per_arithmetic = 0\n'
        "[cycles]\nmultiply = 5\nadd = 5\n",
        encoding="utf-8",
    )
    tasks.write_text('[[task]]\nname = "control"\nperiod = 1\ncost_us = 3\npriority = 5\n', encoding="utf-8")
    relative = [path.relative_to(folder) for path in (costs, part, tasks)]
    table, loaded = read_costs(relative[0]), load_part(str(relative[1]))
    return Given({table.name: table}, {loaded.name: loaded}, tasks=relative[2])


def test_files_of_the_users_own_are_named_as_they_were_given() -> None:
    with in_a_folder() as folder:
        own = own_files(folder)
        found = found_of("N=10&M=4&hr_hz=400&method=larsen&costs=mine&processor=part", own)
        said = commands(found.asked, found.plan)
        words = shlex.split(said.shell.split("\n")[0])
        for option, kind in (("--costs", "costs"), ("--processor", "part"), ("--tasks", "tasks")):
            assert words[words.index(option) + 1] == f"{kind} {NASTY}"
        check(found)


@pytest.mark.parametrize("shell", [shell for shell in ("sh", "bash", "dash", "zsh", "ksh", "fish") if which(shell)])
def test_a_shell_reads_the_words_as_they_are(shell: str) -> None:
    with in_a_folder() as folder:
        own = own_files(folder)
        found = found_of("N=10&M=4&hr_hz=400&method=larsen&costs=mine&processor=part", own)
        line = commands(found.asked, found.plan).shell.split("\n")[0]
        words = subprocess.run([shell, "-c", f"printf '%s\\n' {line}"], capture_output=True, text=True, check=True)
        assert words.stdout.splitlines() == shlex.split(line)


def test_what_was_made_in_python_has_no_command() -> None:
    table = CostTable("mine", "us", {"larsen": {"propagate": 1, "propagate_accumulate": 2, "update": 3}})  # type: ignore[dict-item]
    tasks = (Task("control", Fraction(1), Fraction(1, 100), priority=5),)
    drift = load_model("camera", None)
    for own, query in (
        (Given(costs={"mine": table}), "costs=mine"),
        (Given(tasks=tasks), ""),
        (Given(models={"drift": drift}), "model=drift"),
    ):
        found = found_of(f"N=10&M=4&method=larsen&{query}".rstrip("&"), own)
        assert commands(found.asked, found.plan) == Commands()
