"""The clock by which executions are timed, as it is on this machine."""

from __future__ import annotations

import ctypes
import resource
import time

import numpy as np
import pytest

from filters.backends.timed import now
from sched_sim.errors import InputError
from studies.measurement.busy import clocks
from studies.measurement.clock import described, monotonic, switches
from studies.measurement.executions import Executions
from studies.measurement.samples import _others


def test_it_is_pythons_monotonic_clock() -> None:
    before, read, after = time.monotonic_ns(), now(monotonic()), time.monotonic_ns()
    assert before <= read <= after


def test_what_it_adds_is_described() -> None:
    about = described(monotonic())
    assert about["name"] == "CLOCK_MONOTONIC"
    assert about["resolution_ns"] >= 1
    assert 0 <= about["least_ns"] <= about["median_ns"] <= about["p99_ns"]


@pytest.mark.parametrize("resolution", [1, 10, 41])
def test_the_resolution_is_what_lies_between_its_readings(resolution: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Rounded to whole ns, as a counter of 100 MHz that is scaled by other than ten."""
    exact = np.random.default_rng(0).integers(2, 30, 500) * (resolution + 0.03)
    monkeypatch.setattr("studies.measurement.clock._spans", lambda *_: exact.astype(np.int64))
    assert described(monotonic())["resolution_ns"] == resolution


@pytest.mark.skipif(not hasattr(resource, "RUSAGE_THREAD"), reason="the system does not tell of one thread")
def test_giving_up_the_processor_is_a_switch() -> None:
    before = switches()
    time.sleep(1e-3)
    assert switches() > before


def test_where_the_system_does_not_tell_nothing_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(resource, "RUSAGE_THREAD", raising=False)
    found = Executions({}, clocks(), blocks=92, again=0, disturbed=0)
    assert switches() is None
    assert _others(found) == "and what else the operating system ran, which it does not tell"


def test_a_system_without_the_clock_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ctypes, "CDLL", lambda _name: object())
    with pytest.raises(InputError, match=r"no clock_gettime.*--backend counted"):
        monotonic()
