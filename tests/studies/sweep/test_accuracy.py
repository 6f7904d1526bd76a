"""The accuracy of a sweep's designs is that of the step in which each lands."""

from __future__ import annotations

import pytest

from filters.accuracy import px4_predictor, shipped_model, with_low_rate_noise
from sched_sim import InputError
from studies import run_sweep

CAMERA = shipped_model("camera").model(200.0)


def test_each_row_has_that_of_its_landing() -> None:
    rows = run_sweep(
        N=[10, 20],
        M=6,
        method=["standard", "larsen", "dual-rate"],
        costs="counted-9-3-3",
        low_rate_noise=["exact", "euler"],
        speed=[3000, 6000, 9000],
        model="camera",
        output="position",
    ).table.to_pylist()
    landed = [row for row in rows if row["achieved_l"] is not None]
    assert 0 < len(landed) < len(rows)
    for row in rows:
        if row["achieved_l"] is None:
            assert (row["worst_std"], row["rms_std"]) == (None, None)
            continue
        noise = row["low_rate_noise"] if row["method"] == "dual-rate" else "exact"
        accuracy = with_low_rate_noise(CAMERA, [0], row["N"], row["achieved_l"], noise)
        assert row["worst_std"] == pytest.approx(accuracy.worst, rel=1e-9)
        assert row["rms_std"] == pytest.approx(accuracy.rms, rel=1e-9)


def test_beside_a_simulation_too() -> None:
    (row,) = run_sweep(N=10, M=6, L=8, method="dual-rate", simulate=True, model="camera").table.to_pylist()
    assert row["achieved_l_max"] == row["achieved_l"]
    assert row["worst_std"] == pytest.approx(with_low_rate_noise(CAMERA, [0], 10, row["achieved_l"], "exact").worst)


def test_of_px4s_output_predictor_too() -> None:
    rows = run_sweep(
        N=[10, 20], M=6, L=[6, 8], method="px4-predictor", costs="counted-9-3-3", model="camera"
    ).table.to_pylist()
    assert len(rows) == 4
    for row in rows:
        accuracy = px4_predictor(CAMERA, [0], row["N"], row["achieved_l"], 1 / (200 * 0.25))
        assert (row["worst_std"], row["rms_std"]) == pytest.approx((accuracy.worst, accuracy.rms), rel=1e-9)


def test_a_method_that_has_no_such_figure_has_none() -> None:
    (row,) = run_sweep(N=10, L=10, method="multirate", costs="counted-9-3-3", model="camera").table.to_pylist()
    assert row["worst_std"] is None


@pytest.mark.parametrize(
    ("axes", "said"),
    [
        ({"output": "0"}, "output 0 without model"),
        ({"model": "nix"}, "model 'nix' is unknown"),
        ({"model": 3}, "model '?3'?: give text"),
        ({"model": "camera", "output": "0:9"}, "output 0:9"),
        ({"model": "camera", "processor": "leon3"}, "model camera and processor leon3 without hr_hz: the rows have"),
        (
            {"model": "camera", "processor": "leon3", "hr_hz": [100, 200]},
            "model camera with several hr_hz: it is another at each rate",
        ),
    ],
)
def test_what_cannot_be_is_refused(axes: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        run_sweep(N=10, M=4, **axes)
