"""N, M, rates and delays are facts of the sensors: messages name a choice that takes them."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused

SCENARIO = ["simulate --scenario", "`every = 25`", "`delay = 200`"]
WAITS = "these methods wait for one measurement at a time"
OTHER_METHOD = ["choose --method recalculate or larsen"]
ADVICE = re.compile(r"(larger|smaller|longer|shorter|lower|higher|fewer) (N\b|M\b|-N\b|-M\b|delay|rate|period|every)")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("minimum -N 25 -M 200", SCENARIO),
        ("minimum -N 25 -M 200 -L 210 --method dual-rate --tasks control.toml", SCENARIO),
        ("minimum -N 25 -M 200 --processor cortex-m7 --hr-hz 100", SCENARIO),
        ("simulate -N 25 -M 200 --speed 1", SCENARIO),
        ("gantt -N 25 -M 200", SCENARIO),
        ("processors -N 25 -M 200 --hr-hz 100", SCENARIO),
        ("sweep -N 25 -M 200", SCENARIO),
        ("sweep -N 5:25:5 -M 200:300:50", SCENARIO),
        ("sweep -N 25 -M 4 --method multirate --costs counted-9-3-3", ["without -M for the multirate"]),
        ("minimum -N 4 -M 4 --method dual-rate", OTHER_METHOD),
        ("minimum -N 4 -M 4 --method dual-rate --feedback same-step", OTHER_METHOD),
        ("processors -N 4 -M 4 --hr-hz 100", OTHER_METHOD),
        ("minimum -N 4 -M 4 -L 3", ["give L of N=4"]),
        ("minimum -N 10 -M 4 -L 12", ["L=12", "give L from 5 to N=10"]),
        (
            "minimum --hr-hz 400 --measurement-hz 30 --delay-ms 33.3",
            [
                "--delay-ms 33.3 and --measurement-hz 30 are at --hr-hz 400 M = 14 steps, rounded up, of N = 13,",
                WAITS,
                "at most 32.5 ms there; choose --hr-hz 390 or 420",
                "`hz = 30` and `delay_ms = 33.3`",
            ],
        ),
        (
            "simulate --hr-hz 400 --measurement-hz 5 --delay-ms 250 --method larsen",
            ["--delay-ms 250 is longer than the 200 ms", "(--measurement-hz 5)", WAITS, "at most 200 ms"],
        ),
        ("gantt --hr-hz 400 --measurement-hz 30 -M 14", ["-M 14 (35 ms)", "`hz = 30` and `delay = 14`"]),
        (
            "gantt --hr-hz 400 -N 13 --delay-ms 33.3",
            ["than the 32.5 ms", "(-N 13)", "`every = 13` and `delay_ms = 33.3`"],
        ),
        (
            "processors --hr-hz 400 --measurement-hz 30 --delay-ms 32",
            [*OTHER_METHOD, "at most 30 ms", "choose --hr-hz 750, at which 32 ms can be"],
        ),
        (
            "minimum --hr-hz 400 --measurement-hz 5 --delay-ms 100 --land-within-ms 210",
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
        ("minimum -N 10 -M 4 --method multirate --costs counted-9-3-3", ["-M 4", "--method recalculate, larsen or"]),
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
    (tmp_path / "larsen.toml").write_text(scenario('late = "larsen"\n'))
    (tmp_path / "short.toml").write_text(scenario().replace("steps = 4000", "steps = 100"))
    result = sched_sim(line)
    is_refused(result, said)
    assert not ADVICE.search(result.err)


@pytest.mark.parametrize(
    "line",
    [
        "minimum --hr-hz 390 --measurement-hz 30 --delay-ms 33.3",
        "minimum --hr-hz 420 --measurement-hz 30 --delay-ms 33.3",
        "minimum --hr-hz 400 --measurement-hz 30 --delay-ms 32.5",
        "simulate --hr-hz 750 --measurement-hz 30 --delay-ms 32",
        "minimum --hr-hz 400 --measurement-hz 5 --delay-ms 100 --land-within-ms 200",
        "simulate --hr-hz 400 --measurement-hz 30 --delay-ms 20 --land-within-ms 24.167",
    ],
)
def test_what_the_messages_say_can_be_can_be(sched_sim: Run, line: str) -> None:
    assert sched_sim(line).code == 0


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
