"""Which covariance update the costs are of stands below every table and in JSON, where the cost table says it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused

COSTS = """
name = "mine"
unit = "operation"
{form}
[operations.larsen]
propagate = {{ multiply = 10, add = 10 }}
propagate_accumulate = {{ multiply = 15, add = 15 }}
update = {{ multiply = 20, add = 20 }}
"""
LINES = [
    "minimum -N 10 -M 4 --method larsen --costs mine.toml",
    "minimum -N 10 -M 4 --method larsen --costs mine.toml --processor cortex-m7 --hr-hz 400",
    "simulate -N 10 -M 4 --method larsen --costs mine.toml",
    "processors -N 10 -M 4 --hr-hz 400 --method larsen --costs mine.toml",
]


def write(folder: Path, form: str) -> None:
    (folder / "mine.toml").write_text(COSTS.format(form=form))


@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize(
    ("form", "said"),
    [
        ("textbook", "covariance update: textbook (Eq. 11); `sched-sim measure --update short` counts a cheaper one"),
        ("joseph", "covariance update: joseph, which bears any gain"),
        ("short", "covariance update: short, P - K (P H')', the cheapest"),
        ("my own", "covariance update: my own"),
    ],
)
def test_it_is_said(sched_sim: Run, tmp_path: Path, line: str, form: str, said: str) -> None:
    write(tmp_path, f'update_form = "{form}"')
    assert said in sched_sim(line).out
    document = json.loads(sched_sim(f"{line} --format json").out)
    rows = document if isinstance(document, list) else [document]
    assert {row["update_form"] for row in rows} == {form}


@pytest.mark.parametrize("line", LINES)
def test_nothing_is_said_where_the_table_does_not(sched_sim: Run, tmp_path: Path, line: str) -> None:
    write(tmp_path, "")
    assert "covariance update" not in sched_sim(line).out
    assert "update_form" not in sched_sim(f"{line} --format json").out


def test_methods_that_keep_factors_of_the_covariance_have_none(sched_sim: Run) -> None:
    line = "minimum -N 5 --costs counted-9-3-3 --method multirate-ud"
    assert "covariance update" not in sched_sim(line).out
    assert json.loads(sched_sim(f"{line} --format json").out)[0]["update_form"] is None


def test_measure_counts_what_the_line_below_the_table_names(sched_sim: Run) -> None:
    """At 15 states and 3 measurements, textbook is more than three times short; joseph more than either."""
    updates = {}
    for form in ("textbook", "short", "joseph"):
        line = f"measure --states 15 --method standard --backend counted --update {form} -o {form}.toml --format json"
        (row,) = (row for row in json.loads(sched_sim(line).out) if row["job"] == "update")
        assert row["update_form"] == form
        updates[form] = row["minimum"]
        found = json.loads(sched_sim(f"minimum -N 10 -M 0 --costs {form}.toml --format json").out)
        assert found[0]["update_form"] == form
    assert 3 * updates["short"] < updates["textbook"] < updates["joseph"]


def test_a_form_that_would_be_ignored_is_refused(sched_sim: Run) -> None:
    line = "measure --robust position --backend counted --update short --states 4"
    is_refused(sched_sim(line), ["--robust position", "leave out --states, --update"])


def test_a_size_that_would_be_ignored_is_refused(sched_sim: Run) -> None:
    line = "measure --system own_system:car --backend counted --states 4 --inputs 0"
    is_refused(sched_sim(line), ["--system 'own_system:car'", "leave out --states, --inputs"])


ON_PARTS = [
    ("minimum -N 10 -M 4 --processor cortex-m4f --hr-hz 400", "0.68 to 1.05 (KFCore, STM32F429) on cortex-m4f"),
    ("minimum -N 10 -M 4 --processor cortex-m7", "is not known"),
    ("simulate -N 10 -M 4 --processor leon3", "is not known"),
    ("processors -N 10 -M 4 --hr-hz 400 --processor leon3", "is not known"),
    ("processors -N 10 -M 4 --hr-hz 400", "0.68 to 1.05 (KFCore, STM32F429) on cortex-m4f, 0.85 to 1.25 (products"),
]


@pytest.mark.parametrize(("line", "measured"), ON_PARTS)
def test_on_a_part_the_ground_is_said(sched_sim: Run, line: str, measured: str) -> None:
    assert f"dense counts, textbook form; measured over predicted {measured}" in sched_sim(line).out


def test_counts_without_a_form_are_what_was_counted(sched_sim: Run) -> None:
    line = "minimum -N 5 --costs patent-multirate --processor patent --hr-hz 1"
    assert "operations as counted; measured over predicted is not known" in sched_sim(line).out


def test_without_a_part_there_is_no_ground(sched_sim: Run) -> None:
    assert "measured over predicted" not in sched_sim("minimum -N 10 -M 4 --costs counted-9-3-3").out
