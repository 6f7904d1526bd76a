"""Many samples as text: exact, in order, and equal ones one object."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.sample_file import read_sampled_costs, write_sampled_costs
from sched_sim.costs.sample_text import LONG, of_each, samples_in, samples_value
from sched_sim.errors import InputError

HEAD = 'name = "c"\nunit = "ns"\n{}[samples]\npredict = {}\n'


def costs_file(folder: Path, value: str, about: str = "") -> Path:
    path = folder / "costs.toml"
    path.write_text(HEAD.format(about, value))
    return path


@given(st.lists(st.integers(1, 400), min_size=LONG + 1, max_size=4 * LONG))
def test_what_is_written_as_text_is_read_back(times: list[int]) -> None:
    text = tomllib.loads(f"predict = {samples_value([*map(Fraction, times)])}")["predict"]
    samples = samples_in(text)
    assert samples == (*times,)
    assert len({id(sample) for sample in samples}) == len({*times})


def test_numbers_of_a_text_are_exact_decimals() -> None:
    assert samples_in("1.21e-6 3\n 77/100") == (Fraction(121, 10**8), 3, Fraction(77, 100))


def test_few_samples_are_a_list() -> None:
    assert samples_value([Fraction(3), Fraction(1, 2)]) == "[3, 0.5]"
    assert samples_value([Fraction(3)] * LONG).startswith("[")


def test_a_function_is_computed_once_for_each_object() -> None:
    seen: list[Fraction] = []

    def double(sample: Fraction) -> Fraction:
        seen.append(sample)
        return 2 * sample

    samples = samples_in("3 1 3 3 1")
    assert of_each(double, samples) == (6, 2, 6, 6, 2)
    assert seen == [3, 1]


def test_a_file_with_a_text_is_read_and_written_again(tmp_path: Path) -> None:
    words: Sequence[str] = ["230", "231", "12000"] * LONG
    path = costs_file(tmp_path, f"'''\n{' '.join(words)}\n'''", "executions = true\n[autocorrelation]\npredict = 0.5\n")
    costs = read_sampled_costs(path)
    assert costs.samples["predict"] == (*map(int, words),)
    assert (costs.provenance["executions"], costs.provenance["autocorrelation"]) == (True, {"predict": Fraction(1, 2)})
    write_sampled_costs(costs, path)
    assert read_sampled_costs(path) == costs


@pytest.mark.parametrize(("about", "harness"), [("", True), ("executions = true\n", False)])
def test_samples_that_are_executions_have_no_harness(tmp_path: Path, about: str, harness: bool) -> None:
    path = costs_file(tmp_path, "[230, 231]", f'backend = "compiled"\n{about}')
    assert read_sampled_costs(path).harness == harness


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ('"230 fast 3"', r"samples\.predict: number 2 of the text: .*fast"),
        ('"230 231 -3"', r"samples\.predict: number 3 of the text: .*greater than 0"),
        ('"230 1e99"', r"samples\.predict: number 2 of the text: .*1e99"),
        ('" "', r"samples\.predict: .*list"),
    ],
)
def test_a_wrong_number_of_a_text_is_named(tmp_path: Path, value: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read_sampled_costs(costs_file(tmp_path, value))
