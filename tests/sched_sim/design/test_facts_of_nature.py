"""N, M, rates and delays are facts of the sensors: messages name a choice that takes them."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.design.time_limits import check_times
from sched_sim.design.times import Steps, Times
from sched_sim.errors import InputError
from tests.command_line import Run, is_refused

ADVICE = re.compile(r"(larger|smaller|longer|shorter|lower|higher|fewer) (N\b|M\b|-N\b|-M\b|delay|rate|period|every)")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (
            "minimum -N 25 -M 200 --method larsen",
            ["[costs.larsen] gain, correct, compensate", "--method recalculate or"],
        ),
        ("simulate -N 25 -M 200 --speed 1 --method larsen", ["use --costs counted-9-3-3 or a table that"]),
        ("minimum -N 10 -L 12 --method multirate --costs counted-9-3-3", ["L=12", "give L from 1 to N=10"]),
        ("sweep -N 25 -M 4 --method multirate --costs counted-9-3-3", ["without -M for the multirate"]),
        ("minimum -N 4 -M 4 -L 4 --method dual-rate", ["L=4 must be > M=4", "give L from 5 on"]),
        ("minimum -N 4 -M 4 -L 3", ["give L from 5 on"]),
        ("minimum -N 25 -M 200 -L 210 --method dual-rate --tasks control.toml", ["periods (control 7.12346) down"]),
        (
            "minimum -N 25 -M 200 -L 210 --method dual-rate --policy edf --tasks any.toml",
            ["several corrections are on", "an offset"],
        ),
        (
            "minimum --hr-hz 400 --measurement-hz 5 --land-within-ms 210 --method multirate --costs counted-9-3-3",
            ["--land-within-ms 210 is later", "--measurement-hz 5 within 200 ms", "give 200 or less"],
        ),
        (
            "simulate --hr-hz 400 --measurement-hz 30 --delay-ms 20 --land-within-ms 24",
            ["--land-within-ms 24 is before", "24.167 ms after the measurement is taken; give 24.167 or more"],
        ),
        (
            "minimum --hr-hz 400 --measurement-hz 5 --delay-ms 20 --method multirate --costs counted-9-3-3",
            ["--delay-ms 20: multirate has no delay", "leave --delay-ms out"],
        ),
        (
            "minimum -N 10 -M 4 --method multirate --costs counted-9-3-3",
            ["-M 4", "--method recalculate, larsen, clone, carried-gain or"],
        ),
        ("minimum -N 300000 -M 4 --context-switch 0.01", ["leave out --context-switch", "simulate --speed"]),
        ("minimum -N 10 -M 4 --tasks control.toml", ["periods (control 7.12346) down", "simulate --speed"]),
        ("simulate --scenario larsen.toml", ['choose late = "recalculate"']),
        ("simulate --scenario short.toml", ["least delay 200", "give more steps"]),
    ],
)
def test_no_message_asks_for_other_facts(sched_sim: Run, tmp_path: Path, line: str, said: list[str]) -> None:
    (tmp_path / "control.toml").write_text(
        '[[task]]\nname = "control"\nperiod = 7.123457\noffset = 0\ncost = 0.1\npriority = 5\n'
    )
    (tmp_path / "any.toml").write_text('[[task]]\nname = "a"\nperiod = 5\noffset = "any"\ncost = 0.1\npriority = 5\n')
    (tmp_path / "larsen.toml").write_text(scenario('late = "larsen"\n'))
    (tmp_path / "short.toml").write_text(scenario().replace("steps = 4000", "steps = 100"))
    result = sched_sim(line)
    is_refused(result, said)
    assert not ADVICE.search(result.err)


@pytest.mark.parametrize(
    "line",
    [
        "minimum -N 25 -M 200",
        pytest.param("minimum -N 25 -M 60 -L 90 --processor cortex-m7 --hr-hz 100", marks=pytest.mark.exhaust),
        "simulate -N 25 -M 200 --speed 1",
        "gantt -N 5 -M 12",
        "processors -N 25 -M 60 --hr-hz 100 --processor leon3",
        pytest.param("sweep -N 25 -M 60 --method dual-rate", marks=pytest.mark.exhaust),
        "sweep -N 5,15 -M 20 --costs counted-9-3-3",
        "minimum -N 4 -M 4 --method dual-rate",
        pytest.param("minimum -N 4 -M 4 --method dual-rate --feedback same-step", marks=pytest.mark.exhaust),
        "minimum -N 10 -M 4 -L 12",
        "minimum --hr-hz 400 --measurement-hz 30 --delay-ms 33.3",
        "simulate --hr-hz 400 --measurement-hz 5 --delay-ms 250 --method larsen --costs counted-9-3-3",
        "gantt --hr-hz 400 --measurement-hz 30 -M 14",
        pytest.param("gantt --hr-hz 400 -N 13 --delay-ms 33.3", marks=pytest.mark.exhaust),
        "minimum --hr-hz 400 --measurement-hz 5 --delay-ms 100 --land-within-ms 210",
        pytest.param(
            "minimum --hr-hz 400 --measurement-hz 5 --delay-ms 100 --land-within-ms 200", marks=pytest.mark.exhaust
        ),
        "simulate --hr-hz 400 --measurement-hz 30 --delay-ms 20 --land-within-ms 24.167",
    ],
)
def test_what_the_messages_say_can_be_can_be(sched_sim: Run, line: str) -> None:
    assert sched_sim(line).code == 0


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        (
            Steps(80, 120, None),
            [
                "choose method recalculate, larsen, clone, carried-gain or dual-rate",
                "delay_ms 300 is longer than the 200 ms",
            ],
        ),
        (Steps(80, 80, None), ["at most 197.5 ms", "choose method recalculate or larsen"]),
    ],
)
def test_times_of_a_method_with_one_measurement_at_a_time(steps: Steps, said: list[str]) -> None:
    """That it can be late at all is a matter of methods to come."""
    times = Times.of(5, Fraction(5, 2) * (steps.M or 0))
    with pytest.raises(InputError) as found:
        check_times(times, steps, Fraction(400), after=1)
    for part in said:
        assert part in str(found.value)


def test_what_the_message_says_to_write_runs(sched_sim: Run, tmp_path: Path) -> None:
    """Every fix goes back 200 steps: 0.55 + 200 x 0.45 = 90.55 within 25 steps, beside 25 x 0.45."""
    (tmp_path / "gps.toml").write_text(scenario())
    found = json.loads(sched_sim("simulate --scenario gps.toml --format json").out)
    assert found["misses"] == 0
    assert found["sensors"]["gps"]["achieved_l"].keys() <= {str(L) for L in range(200, 225)}
    assert found["demand"] == [pytest.approx((0.45 + (0.55 + 200 * 0.45) / 25) / 8, rel=0.1)]


def scenario(more: str = "") -> str:
    sensor = '[[sensor]]\nname = "gps"\nevery = 25\ndelay = 200\ncost = 0.55\n'
    return f'name = "gps"\nsteps = 4000\nspeed = 8\n{more}[predictor]\ncost = 0.45\n{sensor}'


def test_no_message_in_the_sources_does() -> None:
    root = Path(__file__).parents[3]
    sources = [*(root / "sched_sim").rglob("*.py"), *(root / "studies" / "sweep").glob("*.py")]
    found = [
        f"{path.name}: {line.strip()}"
        for path in sources
        for line in path.read_text(encoding="utf-8").splitlines()
        if re.search(rf'"[^"]*\bgive [^"]*{ADVICE.pattern}', line)
    ]
    assert found == []
