"""Costs in instructions at `minimum`, `processors` and others: a clock, cycles, memory, and that they are no cycles."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from reports.charts.panels import method_panel
from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from tests.command_line import Run, is_refused

TABLE = """
name = "m4f"
unit = "instruction"
update_form = "textbook"
target = "cortex-m4f"
precision = "single"
compiler = "gcc 12"

[memory.standard]
HR = { code = 1704, ram = 2784, stack = 120 }

[memory.dual-rate]
HR = { code = 644, ram = 3336, stack = 120 }
LR = { code = 1484, ram = 3384, stack = 144 }
model = { code = 7200, ram = 0, stack = 0 }

[costs.standard]
propagate = 13232
update = 13747

[costs.dual-rate]
hr_restart = 819
hr_propagate = 18912
hr_update = 597
lr_propagate = 12448
lr_update = 13675
"""
NOTE = "instructions, not cycles, on an emulated cortex-m4f, single precision, gcc 12"
DESIGN = "-N 80 -M 40 --hr-hz 400 --costs m4f.toml --method dual-rate"


@pytest.fixture(autouse=True)
def table(tmp_path: Path) -> None:
    (tmp_path / "m4f.toml").write_text(TABLE)


@pytest.mark.parametrize(
    "line",
    [
        f"minimum {DESIGN}",
        f"minimum {DESIGN} --processor cortex-m4f",
        f"minimum {DESIGN} --clock-mhz 84 --cycles-per-instruction 1:2",
        f"processors {DESIGN}",
        f"simulate {DESIGN} --processor cortex-m4f",
        "sweep -N 80 -M 40 --costs m4f.toml",
        "gantt -N 80 -M 40 --costs m4f.toml --method dual-rate -o fig.svg",
        "accuracy --model ins-gps --hr-hz 400 --measurement-hz 5 --delay-ms 110 --costs m4f.toml --method dual-rate "
        "--processor cortex-m4f",
    ],
)
def test_every_command_says_that_they_are_no_cycles(sched_sim: Run, line: str) -> None:
    found = sched_sim(line)
    assert found.code == 0, found.err
    assert (found.out + found.err).count(NOTE) == 1


def test_a_clock_and_cycles_do_what_a_part_that_states_them_does(sched_sim: Run) -> None:
    (on_part,) = json.loads(sched_sim(f"minimum {DESIGN} --processor cortex-m4f --format json").out)
    flags = "--clock-mhz 168 --cycles-per-instruction 1:2.65"
    (by_flags,) = json.loads(sched_sim(f"minimum {DESIGN} {flags} --format json").out)
    assert on_part == by_flags
    (listed,) = json.loads(sched_sim(f"processors {DESIGN} --format json").out)
    assert listed.pop("reason") is None
    assert listed == {key: value for key, value in on_part.items() if key != "cost_unit"}


def test_verdicts_are_by_the_most_cycles_and_say_the_least(sched_sim: Run) -> None:
    line = f"minimum {DESIGN} --clock-mhz 10 --cycles-per-instruction 1:2"
    (row,) = json.loads(sched_sim(f"{line} --format json").out)
    assert row["needed_share_least"] < 1 < row["needed_share_most"]
    assert not row["fits"]
    assert (row["instructions_of"], row["cycles_per_instruction"]) == ("cortex-m4f", "1 to 2")
    assert row["needed_share_most"] == row["needed_share"] == 2 * row["needed_share_least"]
    assert "at 1 to 2 cycles an instruction, of the speed of cortex-m4f: dual-rate 78.1 to 157 %" in sched_sim(line).out


@pytest.mark.parametrize(("kb", "fits"), [("128", True), ("6.9", True), ("6.8", False)])
def test_arrays_and_stacks_of_all_tasks_fit_a_ram_or_not(sched_sim: Run, kb: str, fits: bool) -> None:
    needed = 3336 + 120 + 3384 + 144
    for command in (f"minimum {DESIGN} --processor cortex-m4f", f"processors {DESIGN}"):
        (row,) = json.loads(sched_sim(f"{command} --ram-kb {kb} --format json").out)
        assert row["ram_and_stack_bytes"] == needed
        assert row["fits_ram"] == fits == (needed <= float(kb) * 1024)
    assert "RAM, KB   in RAM" in sched_sim(f"minimum {DESIGN} --ram-kb {kb}").out


@pytest.mark.parametrize(
    ("speed", "kb", "words"),
    [
        ("168", "128", ("yes", "yes", "yes")),
        ("168", "4", ("no", "yes", "no")),
        ("10", "128", ("no", "no", "yes")),
        ("10", "4", ("no", "no", "no")),
    ],
)
def test_fits_is_in_time_and_in_ram(sched_sim: Run, speed: str, kb: str, words: tuple[str, ...]) -> None:
    line = f"minimum {DESIGN} --clock-mhz {speed} --cycles-per-instruction 1:2 --ram-kb {kb}"
    (row,) = json.loads(sched_sim(f"{line} --format json").out)
    keys = ("fits", "fits_time", "fits_ram")
    assert tuple(row[key] for key in keys) == tuple(word == "yes" for word in words)
    _title, heading, _rule, below, *_ = filter(str.strip, sched_sim(line).out.splitlines())
    in_words = dict(zip(*(re.split(r" {2,}", cells.strip()) for cells in (heading, below)), strict=True))
    assert tuple(in_words[name] for name in ("fits", "in time", "in RAM")) == words


def test_what_lacks_ram_is_behind_what_fits(sched_sim: Run) -> None:
    line = "processors -N 80 -M 40 --hr-hz 400 --costs m4f.toml --method dual-rate --method standard --ram-kb 4"
    shown = [words for words in sched_sim(line).out.splitlines() if "cortex-m4f  " in words]
    assert ["standard" in words for words in shown] == [True, False]
    assert [" yes " in words.partition("dense")[2][:12] for words in shown] == [True, False]


def test_a_table_without_memory_is_refused_once(sched_sim: Run) -> None:
    for command in ("minimum -N 10 -M 4", "processors -N 10 -M 4 --hr-hz 400"):
        refused = sched_sim(f"{command} --costs counted-9-3-3 --ram-kb 10")
        is_refused(refused, ["--ram-kb 10", "counted-9-3-3", "measure --backend emulated"])
        assert refused.err.count("does not say what memory") == 1


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("minimum -N 10 -M 4 --ram-kb 4", ["--ram-kb 4", "steffes2014", "measure --backend emulated"]),
        (f"minimum {DESIGN} --ram-kb much", ["--ram-kb", "much"]),
        ("minimum -N 10 -M 4 --clock-mhz 84", ["--clock-mhz", "measure --backend emulated"]),
        ("minimum -N 10 -M 4 --costs counted-9-3-3 --cycles-per-instruction 1", ["--cycles-per-instruction"]),
        (f"minimum {DESIGN} --clock-mhz 84", ["--cycles-per-instruction is missing"]),
        (f"minimum {DESIGN} --cycles-per-instruction 1:2", ["--clock-mhz, or --processor, is missing"]),
        (f"minimum {DESIGN} --clock-mhz 0 --cycles-per-instruction 1", ["--clock-mhz"]),
        (f"minimum {DESIGN} --clock-mhz 84 --cycles-per-instruction 2:1", ["2:1", "less than the least"]),
        (f"minimum {DESIGN} --clock-mhz 84 --cycles-per-instruction 1:x", ["--cycles-per-instruction is 'x'"]),
        (f"minimum {DESIGN} --clock-mhz 84 --processor leon3 --cycles-per-instruction 1", ["exclude each other"]),
        (f"minimum {DESIGN} --processor leon3", ["'leon3' does not state", "[cycles_per_instruction]"]),
        (f"processors {DESIGN} --processor cortex-m7", ["'cortex-m7' does not state", "--cycles-per-instruction"]),
        (f"processors {DESIGN} --cycles-per-instruction 1:2", ["name the parts", "--processor"]),
        ("processors -N 10 -M 4 --hr-hz 400 --processor leon3 --cycles-per-instruction 1:2", ["counted-9-3-3"]),
    ],
)
def test_wrong_flags_are_refused(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(line), said)


def test_the_list_has_the_cycles_and_where_they_are_from(sched_sim: Run) -> None:
    rows = {row["processor"]: row for row in json.loads(sched_sim("processors --format json").out)}
    assert [rows["cortex-m4f"][f"cycles_per_instruction_{end}"] for end in ("least", "most")] == [1, 2.65]
    assert "one instruction a cycle" in rows["cortex-m4f"]["cycles_per_instruction_source"]
    assert rows["leon3"]["cycles_per_instruction_least"] is None


def test_cycles_that_are_given_stand_for_those_of_a_part(sched_sim: Run) -> None:
    line = f"processors {DESIGN} --processor cortex-m4f --format json"
    (stated,), (given,) = (json.loads(sched_sim(line + more).out) for more in ("", " --cycles-per-instruction 4"))
    assert given["needed_share"] == pytest.approx(4 / 2.65 * stated["needed_share"])


def test_a_picture_says_what_its_times_are_of(tmp_path: Path) -> None:
    counted = load_costs(tmp_path / "m4f.toml")
    timing = Timing(80, 40, 60)
    assert method_panel(counted, "dual-rate", timing, 30_000).notes[0] == "speed 30000 instructions"
    on_it = on_part(replace(counted, provenance={**counted.provenance, "structure": "sparse"}), load_part("cortex-m4f"))
    notes = method_panel(on_it, "dual-rate", timing, Fraction(1, 400)).notes
    assert {"sparse", "by instructions of cortex-m4f"} <= set(notes)


CHOICE = "design --within 10 --model ins-gps --costs m4f.toml --method dual-rate"


def test_design_takes_the_parts_that_processors_does(sched_sim: Run) -> None:
    (design,) = json.loads(sched_sim(f"{CHOICE} --format json").out)["designs"]
    (on,) = design["parts"]
    sampled = f"-N {design['N']} -M {design['M']} -L {design['L']} --feedback {design['feedback']}"
    line = f"processors {sampled} --hr-hz 400 --costs m4f.toml --method dual-rate --format json"
    (listed,) = json.loads(sched_sim(line).out)
    for key in ("processor", "fits", "needed_share", "load", "achieved_l", "correction_ms"):
        assert on[key] == listed[key], key
    shown = sched_sim(CHOICE).out
    assert "on cortex-m4f: times by the most of 1 to 2.65 cycles for each instruction" in shown
    assert "no parts" not in shown
    is_refused(sched_sim(f"{CHOICE} --processor leon3"), ["'leon3' does not state", "[cycles_per_instruction]"])


def test_without_a_part_for_the_core_design_says_why(sched_sim: Run) -> None:
    Path("m4f.toml").write_text(TABLE.replace('"cortex-m4f"', '"cortex-m4-soft"'))
    shown = sched_sim(CHOICE).out
    assert "no parts: none that ships states the cycles of instructions of cortex-m4-soft" in shown
    assert "no counted operations" not in shown
