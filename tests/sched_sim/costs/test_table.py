"""The cost table and its file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.costs.methods import DELAYED_METHODS, PAPER_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import TABLES, costs_text, load_costs, read_costs, shipped_tables
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CloneCosts,
    CloneInFlightCosts,
    DualRateCosts,
    LarsenCosts,
    LarsenInFlightCosts,
    StandardCosts,
)
from sched_sim.errors import InputError

BY_HAND = """
name = "mine"
unit = "ms"
[costs.larsen]
propagate = 0.21
propagate_accumulate = 0.3
update = { minimum = 0.4, median = 0.41, p95 = 0.55 }
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "mine.toml"
    path.write_text(BY_HAND)
    return path


def test_a_table_written_by_hand_is_read_as_exact_decimals(file: Path) -> None:
    costs = load_costs(file).costs["larsen"]
    assert costs["propagate"].p95 == Fraction(21, 100)
    assert (costs["update"].minimum, costs["update"].p95) == (Fraction(4, 10), Fraction(55, 100))


def test_the_chosen_statistic_is_what_is_scheduled(file: Path) -> None:
    costs = select(load_costs(file), "larsen", Options(), "p95")
    assert costs == LarsenCosts(Fraction(21, 100), Fraction(3, 10), Fraction(55, 100))


@pytest.mark.parametrize(
    ("name", "methods"),
    [("steffes2014", PAPER_METHODS), ("counted-9-3-3", DELAYED_METHODS), ("counted-9-3-3-short", DELAYED_METHODS)],
)
def test_shipped_tables_have_what_delayed_methods_need(name: str, methods: Sequence[str]) -> None:
    assert name in shipped_tables()
    for method in methods:
        select(load_costs(name), method, Options())


def test_the_counted_table_has_what_every_option_needs() -> None:
    split = select(load_costs("counted-9-3-3"), "dual-rate", Options(gain="precomputed", low_rate_noise="euler"))
    assert isinstance(split, DualRateCosts)
    whole = select(load_costs("counted-9-3-3"), "dual-rate", Options())
    assert isinstance(whole, DualRateCosts)
    assert split.lr_gain + split.lr_update == whole.lr_update


@pytest.mark.parametrize(
    ("method", "alone", "several"),
    [("larsen", LarsenCosts, LarsenInFlightCosts), ("clone", CloneCosts, CloneInFlightCosts)],
)
def test_what_several_in_flight_need_is_taken_where_a_table_has_it(
    monkeypatch: pytest.MonkeyPatch, method: str, alone: type, several: type
) -> None:
    """Where not, no message is made of it, for which all shipped tables would be read."""
    counted = load_costs("counted-9-3-3")
    assert type(select(counted, method)) is several
    without = {kind: cost for kind, cost in counted.costs[method].items() if kind != "compensate"}
    monkeypatch.setattr(CostTable, "_remedy", lambda *_: pytest.fail("a message was made"))
    assert type(select(CostTable("mine", "operation", {method: without}), method)) is alone


def test_a_table_survives_being_written_and_read(tmp_path: Path) -> None:
    for name in shipped_tables():
        table = load_costs(name)
        path = tmp_path / "copy.toml"
        path.write_text(costs_text(table))
        again = read_costs(path)
        assert replace(again, path=table.path) == table


def test_normalised_costs_have_the_standard_step_as_unit() -> None:
    entries = load_costs("counted-9-3-3").normalised().costs["standard"]
    assert entries["propagate"].minimum + entries["update"].minimum == 1


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("0.21", "-0.21", ["costs.larsen.propagate", "-0.21", "greater than 0"]),
        ("0.21", "0", ["costs.larsen.propagate", "is 0", "greater than 0"]),
        ("0.21", "nan", ["costs.larsen.propagate", "NaN"]),
        ("0.21", "inf", ["costs.larsen.propagate", "Infinity"]),
        ("0.21", '"fast"', ["costs.larsen.propagate", "fast", "number"]),
        ("0.21", "true", ["costs.larsen.propagate", "True"]),
        ("median = 0.41, ", "", ["costs.larsen.update.median: is missing: write `median = ...`"]),
        ("update =", "updat =", ["costs.larsen", "updat", "propagate_accumulate"]),
        ("costs.larsen", "costs.larson", ["larson", "larsen", "dual-rate"]),
        ('unit = "ms"', "", ['unit: is missing: write `unit = "..."`']),
        ("[costs.larsen]", "[costs.larsen", ["not valid TOML"]),
    ],
)
def test_what_is_wrong_in_a_file_is_named(file: Path, old: str, new: str, said: list[str]) -> None:
    file.write_text(BY_HAND.replace(old, new, 1))
    with pytest.raises(InputError) as error:
        load_costs(file)
    for words in [str(file), *said]:
        assert words in str(error.value)


def test_every_wrong_entry_is_named_at_once(file: Path) -> None:
    file.write_text(BY_HAND.replace("0.21", "-1").replace("0.3", "0"))
    with pytest.raises(InputError, match=r"costs\.larsen\.propagate:.*costs\.larsen\.propagate_accumulate:"):
        load_costs(file)


def test_a_missing_entry_is_named_with_its_remedy(file: Path) -> None:
    with pytest.raises(InputError, match=r"mine .*no entry \[costs\.dual-rate\] hr_propagate: add the line"):
        select(load_costs(file), "dual-rate", Options())
    with pytest.raises(InputError, match=r"no entry \[costs\.dual-rate\] lr_gain"):
        select(load_costs("steffes2014"), "dual-rate", Options(gain="precomputed"))


def test_an_unknown_table_lists_the_shipped_ones() -> None:
    with pytest.raises(
        InputError,
        match=r"'steffes' not found: did you mean steffes2014\? give one of counted-9-3-3, .*erkf-.*, steffes2014",
    ):
        load_costs("steffes")


def test_a_missing_entry_of_a_shipped_table_names_the_tables_that_have_it() -> None:
    with pytest.raises(InputError, match=r"lr_gain: use costs counted-9-3-3 or counted-9-3-3-short or a table that"):
        select(load_costs("steffes2014"), "dual-rate", Options(gain="precomputed"))
    with pytest.raises(InputError, match=r"use costs .*patent-multirate"):
        select(load_costs("steffes2014"), "multirate", Options())


COUNTS = """
name = "mine"
unit = "operation"
[operations.standard]
propagate = { multiply = 20, add = 10, logic = 70 }
update = { multiply = 7, divide = 1, sqrt = 2, function = 3 }
"""


def test_counts_without_costs_cost_their_arithmetic(file: Path) -> None:
    file.write_text(COUNTS)
    table = load_costs(file)
    assert table.operations["standard"]["propagate"] == {"multiply": 20, "add": 10, "logic": 70}
    assert select(table, "standard", Options()) == StandardCosts(Fraction(30), Fraction(13))
    assert "operations" not in table.provenance


def test_costs_that_a_file_gives_beside_its_counts_hold(file: Path) -> None:
    file.write_text(COUNTS.replace("operation", "ms", 1) + "[costs.standard]\npropagate = 0.5\n")
    table = load_costs(file)
    assert table.entry("standard", "propagate").median == Fraction(1, 2)
    assert table.operations["standard"]["update"]["divide"] == 1


def test_costs_in_operations_are_those_that_are_counted(file: Path) -> None:
    file.write_text(COUNTS + "[costs.standard]\npropagate = 30\nupdate = 13\n")
    assert load_costs(file).entry("standard", "propagate").median == 30
    file.write_text(COUNTS + "[costs.standard]\npropagate = 3700\nupdate = { minimum = 13, median = 13, p95 = 14 }\n")
    with pytest.raises(InputError) as error:
        load_costs(file)
    for words in [
        "[costs.standard] propagate is 3700 operations, and [operations.standard] propagate makes 30 without its logic",
        "[costs.standard] update is 14 operations, and [operations.standard] update makes 13",
        "leave one of them out",
    ]:
        assert words in str(error.value)


@pytest.mark.parametrize("name", ["counted-9-3-3", "counted-9-3-3-short"])
def test_the_shipped_counts_are_written_as_they_are_shipped(name: str) -> None:
    assert costs_text(load_costs(name)) == (TABLES / f"{name}.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("multiply = 20", "multiply = -20", ["operations.standard.propagate.multiply", "-20", "0 or more"]),
        ("multiply = 20", "multiply = 20.0", ["operations.standard.propagate.multiply", "20.0", "whole number"]),
        ("multiply = 20", "multiply = true", ["operations.standard.propagate.multiply", "True", "whole number"]),
        ("multiply = 20", "subtract = 20", ["subtract is no kind of operation", "multiply, add, divide, sqrt"]),
        ("multiply = 20, add = 10, ", "", ["operations.standard.propagate", "at least one of multiply, add"]),
        ("propagate =", "propagated =", ["[operations.standard] propagated is no job kind", "propagate, update"]),
        ("operations.standard", "operations.kalman", ["[operations.kalman] is no method", "standard, recalculate"]),
        ('unit = "operation"', 'unit = "ms"', ["'ms'", 'write unit = "operation"']),
        (COUNTS[COUNTS.index("[") :], "", ["no [costs] and no [operations]"]),
    ],
)
def test_what_is_wrong_with_counts_is_named(file: Path, old: str, new: str, said: list[str]) -> None:
    file.write_text(COUNTS.replace(old, new, 1))
    with pytest.raises(InputError) as error:
        load_costs(file)
    for words in [str(file), *said]:
        assert words in str(error.value)
