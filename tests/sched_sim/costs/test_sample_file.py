"""Measured execution times as a file: exact, read back as written, and wrong ones refused by entry."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.costs.sample_file import SampledCosts, read_sampled_costs, write_sampled_costs
from sched_sim.errors import InputError

BY_HAND = """\
name = "rocket"
unit = "second"
machine = "desk"

[samples]
predict = [1.21e-6, 1.20e-6]

[samples.correct]
gps = [3e-6]
"star tracker" = [9e-6]
"""


def test_samples_are_exact_decimals_by_part(tmp_path: Path) -> None:
    (tmp_path / "costs.toml").write_text(BY_HAND)
    costs = read_sampled_costs(tmp_path / "costs.toml")
    assert costs.samples == {
        "predict": (Fraction(121, 10**8), Fraction(120, 10**8)),
        "correct.gps": (Fraction(3, 10**6),),
        "correct.star tracker": (Fraction(9, 10**6),),
    }
    assert (costs.unit, costs.provenance) == ("second", {"machine": "desk"})


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    path = tmp_path / "costs.toml"
    parts = (
        "predict",
        "predict_accumulate",
        "correct.a b",
        "correct_accumulate.a b",
        "correct_late.a b",
        "carry_product",
        "land.a b",
    )
    costs = SampledCosts(
        name="mine",
        unit="second",
        samples={part: (Fraction(number, 1000), Fraction(3)) for number, part in enumerate(parts, 1)},
        operations={"predict": {"multiply": 3, "add": 4}, "correct.a b": {"divide": 1}},
        provenance={"machine": "desk", "versions": {"numba": "0.68"}},
        path=str(path),
    )
    write_sampled_costs(costs, path)
    assert read_sampled_costs(path) == costs


def test_counts_alone_are_one_sample_of_their_arithmetic(tmp_path: Path) -> None:
    path = tmp_path / "counted.toml"
    path.write_text(
        'name = "c"\nunit = "operation"\n[operations]\npredict = { multiply = 3, add = 4, logic = 9 }\n'
        "[operations.correct]\ngps = { divide = 1 }\n"
    )
    costs = read_sampled_costs(path)
    assert costs.samples == {"predict": (7,), "correct.gps": (1,)}
    assert costs.operations["predict"] == {"multiply": 3, "add": 4, "logic": 9}


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("predict = [1.21e-6, -1]", r"samples\.predict\.1: .*greater than 0"),
        ("predict = []", r"samples\.predict: .*at least one"),
        ("predict = 3", r"samples\.predict: .*list"),
        ("predict = { a = 1 }", r"samples\.predict: must be a list: write `predict = \[...\]`$"),
        ("predikt = [1]", r"samples\.predikt: .*not permitted"),
        ('predict = ["fast"]', r"samples\.predict\.0: .*fast"),
    ],
)
def test_a_wrong_entry_is_named(tmp_path: Path, wrong: str, said: str) -> None:
    (tmp_path / "costs.toml").write_text(BY_HAND.replace("predict = [1.21e-6, 1.20e-6]", wrong))
    with pytest.raises(InputError, match=said):
        read_sampled_costs(tmp_path / "costs.toml")


def test_a_file_without_samples_says_what_to_give(tmp_path: Path) -> None:
    (tmp_path / "costs.toml").write_text('name = "none"\nunit = "second"\n')
    with pytest.raises(InputError, match=r"no \[samples\] \(unit 'second'\): give `predict = "):
        read_sampled_costs(tmp_path / "costs.toml")


def test_a_part_that_no_filter_has_is_refused() -> None:
    with pytest.raises(InputError, match=r"'correct' is no part of a filter: choose from predict, .*correct\.SENSOR"):
        SampledCosts("mine", "second", {"correct": (Fraction(1),)})
    with pytest.raises(InputError, match="samples of predict must be one or more numbers greater than 0"):
        SampledCosts("mine", "second", {"predict": ()})
