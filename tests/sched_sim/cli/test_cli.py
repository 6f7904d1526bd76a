"""What holds for every command: help, version, and output for scripts."""

from __future__ import annotations

import re

import pytest

from tests.command_line import Run, is_refused

DESIGN = "-N 10 -M 4 -L 8 --costs steffes2014"


def test_json_and_csv_carry_no_colour_even_where_it_is_forced(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    for command in (f"minimum {DESIGN}", "simulate -N 10 -M 4"):
        for form in ("json", "csv"):
            assert "\x1b" not in sched_sim(f"{command} --format {form}").out


def test_help_and_version(sched_sim: Run) -> None:
    assert all(
        name in sched_sim("--help").out for name in ("minimum", "simulate", "gantt", "sweep", "measure", "report")
    )
    assert sched_sim("--version").out.startswith("sched-sim ")


@pytest.mark.parametrize(
    ("other", "excluded"),
    [
        ("--system nowhere:system", "--states --inputs --measurements"),
        ("--filter nowhere:filter", "--states --inputs --measurements --system --method --update"),
        ("--robust position", "--states --inputs --measurements --system --method --update"),
    ],
)
def test_the_help_of_measure_says_which_options_exclude_each_other(sched_sim: Run, other: str, excluded: str) -> None:
    values = {"--system": "nowhere:system", "--method": "larsen", "--update": "short"}
    said = " ".join(sched_sim("measure --help").out.replace("│", " ").split())
    for option in excluded.split():
        is_refused(sched_sim(f"measure {other} {option} {values.get(option, 2)}"), [f"leave out {option}"])
        (not_with,) = re.findall(rf" {option} (?:COUNT|<[^>]*>) .*?Not with ([^.]*)\.", said)
        assert other.split()[0] in not_with


def test_the_help_of_sweep_gives_values_that_it_takes(sched_sim: Run) -> None:
    said = " ".join(sched_sim("sweep --help").out.replace("│", " ").split())
    for option in ("--lr-propagate-by", "--feedback", "--gain", "--low-rate-noise", "--cpus"):
        (values,) = re.findall(rf"{option} VALUES ([^.]*)\.", said)
        for value in re.findall(r"[\w,-]*[\w-]", values.replace("(default)", "").replace("several: ", "")):
            if value not in ("Deadline", "of", "LR", "propagate", "or", "processors"):
                result = sched_sim(
                    f"sweep -N 10 -M 2 --costs counted-9-3-3 {option} {value} --speed 10000 --format json"
                )
                assert result.code == 0, result.err
