"""The commands with M > N, where others are measured before one arrives, for each method that corrects at arrival.

N = 3, M = 7, counted at 9 states and 3 measurements: two others are on their way at each k.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused
from tests.svg import texts_of

DESIGN = "-N 3 -M 7 --costs counted-9-3-3"
LEAST = {
    "recalculate": 3042 + 3279 + 7 * 3042,  # propagate, update at k, replay; in the step of m
    "larsen": 3042 + 2 * 1377 + 3171,  # propagate, two products, gain; in that of k
    "clone": 3042 + 2 * 459 + 765 + 2 * 360,  # propagate, carry two, start, couple with two
    "carried-gain": 3042 + 2 * 459 + 3222 + 2 * 153,  # propagate, carry two, update, couple with two
}
each_method = pytest.mark.parametrize("method", LEAST)


@each_method
def test_minimum_says_what_the_longest_job_takes(sched_sim: Run, method: str) -> None:
    (row,) = json.loads(sched_sim(f"minimum {DESIGN} --method {method} --format json").out)
    assert (row["min_speed_exact"], row["binding"]) == (str(LEAST[method]), "hr")
    assert (row["L"], row["achieved_l_at_min_speed"]) == (7, 7)


@each_method
def test_simulate_misses_nothing_at_that_speed_and_something_just_below(sched_sim: Run, method: str) -> None:
    at, below = (
        json.loads(sched_sim(f"simulate {DESIGN} --method {method} --speed {speed} --format json").out)
        for speed in (LEAST[method], LEAST[method] - 1)
    )
    assert (at["misses"], at["achieved_l"]) == (0, [7, 7, 7])
    assert below["misses"] > 0


@each_method
def test_gantt_draws_it_at_that_speed(sched_sim: Run, tmp_path: Path, method: str) -> None:
    assert sched_sim(f"gantt {DESIGN} --method {method} -o g.svg").code == 0
    texts = " ".join(texts_of(tmp_path / "g.svg"))
    for words in (f"speed {LEAST[method]}", "k+7", "no deadline missed"):
        assert words in texts


@each_method
def test_processors_says_what_a_part_does_with_it(sched_sim: Run, method: str) -> None:
    line = f"processors {DESIGN} --hr-hz 100 --processor leon3 --method {method} --format json"
    (row,) = json.loads(sched_sim(line).out)
    assert (row["fits"], row["achieved_l"]) == (True, 7)


@pytest.mark.parametrize(
    "line",
    [
        "minimum -N 10 -M 14",
        "simulate -N 10 -M 14",
        "gantt -N 10 -M 14 -o g.svg",
        "sweep -N 10 -M 14",
        "design --within 0.5 --model ins-gps -N 80 -M 200",
    ],
)
def test_a_table_without_what_clone_needs_for_it_is_said_to_lack_it(sched_sim: Run, tmp_path: Path, line: str) -> None:
    entries = "[costs.clone]\npropagate = 10\nstart = 3\ncarry = 2\nupdate = 3\n"
    (tmp_path / "mine.toml").write_text(f'name = "mine"\nunit = "us"\n{entries}')
    alone = sched_sim("minimum -N 10 -M 4 --method clone --costs mine.toml --format json")
    assert json.loads(alone.out)[0]["min_speed"] == 13
    words = ["where M is more than N", "no [costs.clone] couple, compensate", "--costs counted-9-3-3"]
    is_refused(sched_sim(f"{line} --method clone --costs mine.toml"), words)


CARRIED = """name = "mine"
unit = "us"
[costs.clone]
propagate = 100
start = 20
carry = 1
update = 40
compensate = 1
[costs.carried-gain]
propagate = 100
update = 20
carry = 1
land = 40
compensate = 1
"""


def test_one_on_its_way_at_a_time_does_not_take_what_several_do(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(CARRIED)
    rows = json.loads(sched_sim("minimum -N 10 -M 8 --costs mine.toml --format json").out)
    assert [(row["method"], row["min_speed"]) for row in rows] == [("clone", 140), ("carried-gain", 140)]


def test_what_is_missing_is_named_and_what_the_table_lacks_is_not_proposed(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(CARRIED)
    refused = sched_sim("minimum -N 10 -M 14 --method clone --costs mine.toml")
    is_refused(refused, ["no [costs.clone] couple:", "--costs counted-9-3-3"])
    assert "choose --method" not in refused.err
    (tmp_path / "more.toml").write_text(f"{CARRIED}[costs.recalculate]\npropagate = 1\nupdate = 1\nreplay = 1\n")
    is_refused(sched_sim("minimum -N 10 -M 14 --method clone --costs more.toml"), ["or choose --method recalculate\n"])
    nothing_left = sched_sim("minimum -N 10 -M 14 --costs mine.toml")
    is_refused(
        nothing_left, ["clone: where M is more than N", "no [costs.clone] couple", "no [costs.carried-gain] couple"]
    )


@pytest.mark.parametrize(("method", "first"), [("clone", 31), ("dual-rate", 32)])
def test_a_landing_before_arrival_is_refused_with_the_first_that_the_method_can_have(
    sched_sim: Run, method: str, first: int
) -> None:
    line = f"minimum -N 10 -M 31 --costs counted-9-3-3 --method {method}"
    is_refused(sched_sim(f"{line} -L 30"), ["L=30", "M=31", f"give L from {first} on"])
    assert sched_sim(f"{line} -L {first}").code == 0


@pytest.mark.exhaust
@pytest.mark.parametrize(("method", "load"), [("larsen", "5.92 %"), ("recalculate", "11.5 %")])
def test_what_is_shown_of_the_start_has_the_load_of_later_beside_it(sched_sim: Run, method: str, load: str) -> None:
    design = f"-N 25 -M 200 --hr-hz 100 --costs counted-9-3-3 --processor cortex-m4f --method {method}"
    assert load in sched_sim(f"minimum {design}").out
    for line in (f"simulate {design}", f"gantt {design} -o g.svg"):
        assert f"no measurement is there before step 200; once the filter has been running, the load is {load}" in (
            sched_sim(line).err.replace("\n", " ")
        )


@pytest.mark.parametrize(
    ("hz", "method", "words"),
    [
        ("30", "larsen", "larsen: least speed with the intervals of 13 and 14 as they come"),
        ("29.97", "dual-rate", "dual-rate: least speed is an upper bound, for each interval counts as 13"),
    ],
)
def test_where_a_rate_does_not_divide_it_says_what_the_least_speed_is(
    sched_sim: Run, hz: str, method: str, words: str
) -> None:
    line = f"minimum --hr-hz 400 --measurement-hz {hz} --delay-ms 67.5 --costs counted-9-3-3 --method {method}"
    assert words in sched_sim(line).out
    assert "as they come" not in sched_sim(line.replace("67.5", "20")).out


@pytest.mark.exhaust
def test_the_highest_rate_is_that_of_the_verdicts(sched_sim: Run) -> None:
    """2 s are 8 intervals of 250 ms: each measurement lands in the step of another."""
    line = "minimum --measurement-hz 4 --delay-ms 2000 --costs counted-9-3-3 --processor cortex-m4f --method larsen"
    rows = [
        json.loads(sched_sim(f"{line} --hr-hz {hz} --format json").out)[0]
        for hz in ("100", "1288.2", "1288.5", "1392.5")
    ]
    assert [row["fits"] for row in rows] == [True, True, False, False]
    assert {row["highest_hr_hz"] for row in rows} == {1288.2}
