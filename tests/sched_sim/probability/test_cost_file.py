"""Files of random costs: by kind of job, or the samples of one filter's parts."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.errors import InputError
from sched_sim.probability.cost_file import read_cost_distributions

BY_KIND = """
unit = "us"
[distribution.lr_update]
values = [56, 61]
probabilities = [0.999999, 1e-6]
[distribution.hr_restart]
values = [4, 5]
probabilities = [0.25]
[distribution.hr_propagate]
samples = [1, 3.5, 2]
worst = 9
[distribution.lr_propagate]
values = [1, 2]
exceedance = [1e-9, 0]
"""
SAMPLES = """
name = "mine"
unit = "second"
executions = true
[autocorrelation]
predict = 0.25
correct = {gps = -0.5}
[samples]
predict = [1e-6, 2e-6]
predict_accumulate = [3e-6]
[samples.correct]
gps = [5e-6]
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "costs.toml"
    path.write_text(text)
    return path


def test_by_kind_of_job(tmp_path: Path) -> None:
    found = read_cost_distributions(written(tmp_path, BY_KIND), "dual-rate", "ms")
    million = Fraction(1, 10**6)
    assert found["lr_update"].values == [Fraction(56, 1000), Fraction(61, 1000)]
    assert found["lr_update"].probabilities == [1 - million, million]
    assert found["hr_restart"].probabilities == [Fraction(1, 4), Fraction(3, 4)]
    assert found["hr_propagate"].is_sample
    assert found["hr_propagate"].values == [Fraction(1, 1000), Fraction(35, 10_000), Fraction(2, 1000)]
    assert found["hr_propagate"].worst == Fraction(9, 1000)
    assert found["lr_propagate"].probabilities == [1 - million / 1000, million / 1000]


def test_samples_of_parts_are_those_of_the_jobs_that_they_are(tmp_path: Path) -> None:
    found = read_cost_distributions(written(tmp_path, SAMPLES), "recalculate", "us")
    assert {kind: [*map(float, cost.values)] for kind, cost in found.items()} == {
        "propagate": [1, 2],
        "update": [5],
        "replay": [1, 2],
    }
    assert {kind: cost.autocorrelation for kind, cost in found.items()} == {
        "propagate": 0.25,
        "update": -0.5,
        "replay": 0.25,
    }


@pytest.mark.parametrize(
    ("text", "method", "said"),
    [
        (
            BY_KIND,
            "larsen",
            "[distribution.lr_update]: larsen has no such kind of job: did you mean update? choose from propagate, ",
        ),
        (BY_KIND.replace("lr_update", "lr_updat"), "dual-rate", "did you mean lr_update?"),
        (BY_KIND.replace('"us"', '"operation"'), "dual-rate", "is in operation, and costs are in us here"),
        (
            BY_KIND.replace("0.999999", "0.9"),
            "dual-rate",
            ".lr_update]: the probabilities sum to 0.900001",
        ),
        (BY_KIND.replace("worst = 9", "worst = 3"), "dual-rate", "the worst case 3 is below 3.5, which was measured"),
        (BY_KIND.replace("samples = [1, 3.5, 2]", ""), "dual-rate", "give samples = [...], or values = [...] with"),
        (BY_KIND.replace("worst", "wurst"), "dual-rate", "wurst"),
        ("[[task]]\nname = 'a'\n", "dual-rate", "has no [distribution.KIND] and no [samples]: write unit = ..."),
        (SAMPLES, "clone", "samples of a composed filter's parts, of which clone has none"),
        (SAMPLES + "imu = [1e-6]", "recalculate", "has parts of 2 sensors, gps, imu, and a design has one"),
        (SAMPLES, "dual-rate", "of which none is a kind of job of dual-rate"),
        (SAMPLES.replace("executions = true", 'backend = "compiled"'), "larsen", "is the loop that timed it"),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, text: str, method: str, said: str) -> None:
    with pytest.raises(InputError, match=r"costs\.toml") as error:
        read_cost_distributions(written(tmp_path, text), method, "us")
    assert said in str(error.value)
