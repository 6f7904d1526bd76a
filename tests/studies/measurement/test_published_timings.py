"""What others measured is near what counts predict where it is the same work, and the page shows what the code says."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from filters.backends.counted import Operations
from sched_sim.processors.part import at_clock, seconds_for
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.measurement.published_timings import calibration, markdown, published_timings
from tests.docs.test_examples import ROOT

BOUNDS = {
    "predict": (0.5, 2.0),
    "update, short": (0.7, 1.4),
    "U-D predict": (0.7, 1.4),
    "U-D update": (0.7, 1.4),
}
"""Of measured over predicted, KFCore on the STM32F429."""


@pytest.mark.parametrize("job", BOUNDS)
def test_plain_loops_on_a_cortex_m4f_take_about_what_is_predicted(job: str) -> None:
    (timing,) = (each for each in published_timings() if (each.source, each.job) == ("KFCore", job))
    least, most = BOUNDS[job]
    assert least <= timing.ratios[0] <= timing.ratios[1] <= most


def test_zeros_left_out_take_about_what_is_predicted_of_zeros_left_out() -> None:
    """Of 13,275 operations 1,197 are left."""
    dense, sparse = (each for each in published_timings() if each.source == "eskf-rs")
    assert (dense.job, sparse.job) == ("predict", "predict, sparse")
    assert sparse.operations.total == 1197
    assert dense.ratios[0] < 0.1
    assert 0.7 <= sparse.ratios[0] <= 1.4


def test_the_u_d_filter_as_a_whole_takes_about_what_is_predicted() -> None:
    both = [timing for timing in published_timings() if timing.job.startswith("U-D")]
    assert [float(timing.least_us) for timing in both] == [593, 103]
    assert 0.7 <= sum(timing.least_us for timing in both) / sum(timing.predicted_us for timing in both) <= 1.4


def test_the_page_shows_what_the_code_says() -> None:
    page = (ROOT / "docs/explanation/published.md").read_text(encoding="utf-8")
    assert [line for line in page.splitlines() if line.startswith("|")] == list(markdown())


def test_every_timing_has_a_source_and_an_order() -> None:
    for timing in published_timings():
        assert timing.url.startswith("https://github.com/")
        assert 0 < timing.least_us <= timing.most_us
        assert timing.part in load_part(timing.part).name


def test_a_prediction_is_the_counts_at_the_clock_of_the_board() -> None:
    """16 x 16 x 16: 4096 multiplies, 3840 adds, and 2 instructions around each; 4, 4 and 1 cycle."""
    (timing,) = (each for each in published_timings() if each.job == "matrix product")
    assert timing.operations == Operations(multiply=4096, add=3840)
    assert timing.predicted_us == Fraction(7936 * (4 + 2), 240)
    assert timing.ratios == (Fraction(59690, 7936 * 6),) * 2


def test_the_noises_of_a_prediction_cost_their_product() -> None:
    """G q, n r multiplies; (G q) G', n r n multiplies and n (r - 1) n adds."""
    with_noises = next(each for each in published_timings() if each.noises)
    counted = with_noises.operations
    n, r = with_noises.states, with_noises.noises
    dense = 2 * n**3 + n**2
    assert counted.multiply == dense + n * r + n * r * n
    assert counted.add == 2 * n * n * (n - 1) + n * n + n * (n - 1) + n * (r - 1) * n


def test_only_plain_loops_calibrate() -> None:
    assert calibration("cortex-m7") is None
    measured = calibration("cortex-m4f")
    assert measured is not None
    np.testing.assert_allclose([float(end) for end in measured], [0.679, 1.052], atol=5e-4)


@pytest.mark.parametrize("name", shipped_parts())
def test_the_calibrations_that_ship_are_of_these_timings(name: str) -> None:
    shipped, measured = load_part(name).calibration, calibration(name)
    assert (shipped is None) == (measured is None)
    if shipped is not None and measured is not None:
        assert [shipped.least, shipped.most] == [Fraction(f"{float(end):.2f}") for end in measured]
        assert shipped.source


@pytest.mark.parametrize("name", shipped_parts())
def test_so_are_those_of_sparse_code(name: str) -> None:
    shipped = load_part(name).sparse_calibration
    ratios = [timing.ratios for timing in published_timings() if timing.part == name and "both" in timing.written]
    assert ([] if shipped is None else [shipped.least, shipped.most]) == [
        Fraction(f"{float(end):.2f}") for ends in ratios for end in ends
    ]


def test_the_same_part_at_another_clock_takes_as_many_cycles() -> None:
    part = load_part("cortex-m4f")
    faster = at_clock(part, Fraction(180_000_000))
    assert faster.title == "cortex-m4f at 180 MHz"
    counts = {"multiply": 3, "divide": 2}
    assert seconds_for(counts, faster, "job") * 180 == seconds_for(counts, part, "job") * 168
