"""Running a sweep, stopping it, and going on."""

import os
import random
import signal
from contextlib import contextmanager

import pytest

from sched_sim.errors import InputError
from studies.sweep import run as sweeping
from studies.sweep.dispatch import WorkerDeathError
from studies.sweep.export import export
from studies.sweep.rows import rows_of
from studies.sweep.run import run
from studies.sweep.settings import settings
from studies.sweep.stopping import stop_signals
from studies.sweep.workers import processes

ANALYSED = {"N": "10:60:10", "M": "1:4", "speed": "0.6:1.6:0.1"}
SIMULATED = {"N": "4:6", "M": "1:2", "simulate": True, "context_switch": "0,0.01"}


@contextmanager
def opened(flags, path):
    sweep = settings(flags).sweep()
    with sweep.open(path) as store:
        yield sweep, store


def exported(store, path):
    export(store, path)
    return path.read_bytes()


def no_progress(_done):
    pass


@pytest.mark.parametrize("flags", [ANALYSED, SIMULATED], ids=["analysed", "simulated"])
def test_a_resumed_sweep_equals_an_uninterrupted_one(tmp_path, flags):
    chance = random.Random(1)
    with opened(flags, tmp_path / "whole.sqlite") as (sweep, store):
        size = sweep.grid.size
        assert run(sweep, store, processes(2), no_progress) == (0, size, None)
        whole = [exported(store, tmp_path / f"whole.{kind}") for kind in ("csv", "parquet")]
    with opened(flags, tmp_path / "parts.sqlite") as (sweep, store):
        for span in chance.sample(list(sweep.grid.spans(range(size), lambda _: 17)), 5):
            store.add(rows_of(sweep.grid.chunk(span.start, span.stop), sweep.cycles))
        done = store.count()
    with opened(flags, tmp_path / "parts.sqlite") as (sweep, store):
        assert run(sweep, store, processes(1), no_progress) == (done, size - done, None)
        assert [exported(store, tmp_path / f"parts.{kind}") for kind in ("csv", "parquet")] == whole
    with opened(flags, tmp_path / "parts.sqlite") as (sweep, store):
        assert run(sweep, store, processes(1), no_progress) == (size, 0, None)


@pytest.mark.parametrize(
    ("cycles", "asked", "chosen"),
    [
        (9, {}, "simpy"),
        (900_000, {}, "auto"),
        (9, {"engine": "compiled"}, "compiled"),
        (9, {"engine": "auto"}, "simpy"),
    ],
)
def test_machine_code_is_for_much_to_simulate_unless_it_is_asked_for(cycles, asked, chosen):
    assert settings({**SIMULATED, "cycles": cycles, **asked}).sweep().chosen_engine == chosen


def test_the_engine_is_no_part_of_what_the_rows_depend_on(tmp_path):
    for engine in ("compiled", "simpy"):
        with opened({"N": 4, "simulate": True, "engine": engine}, tmp_path / "rows.sqlite") as (sweep, store):
            before = 0 if engine == "compiled" else sweep.grid.size
            assert run(sweep, store, processes(0), no_progress) == (before, sweep.grid.size - before, None)
    with pytest.raises(InputError, match="engine"):
        settings({**SIMULATED, "engine": "fast"})


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("flags", [ANALYSED, SIMULATED], ids=["analysed", "simulated"])
def test_a_signal_ends_it_with_what_is_done_kept(tmp_path, monkeypatch, flags, number):
    monkeypatch.setattr(sweeping, "ANALYSED", 100)
    monkeypatch.setattr(sweeping, "LARGEST_TASK", 2)
    told = []

    def stop_soon(done):
        told.append(done)
        if len(told) == 3:
            os.kill(os.getpid(), number)

    with opened(flags, tmp_path / "r.sqlite") as (sweep, store):
        outcome = run(sweep, store, processes(1), stop_soon)
        assert outcome.stopped == number
        assert 0 < outcome.computed < sweep.grid.size
        assert store.count() == outcome.computed == told[-1]
        assert run(sweep, store, processes(1), no_progress) == (
            outcome.computed,
            sweep.grid.size - outcome.computed,
            None,
        )


def test_signals_are_as_before_afterwards():
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    with stop_signals() as stopped:
        assert stopped() is None
        os.kill(os.getpid(), signal.SIGTERM)
        os.kill(os.getpid(), signal.SIGINT)
        assert stopped() == signal.SIGTERM
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == before


def test_an_ignored_signal_stays_ignored():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with stop_signals() as stopped:
            os.kill(os.getpid(), signal.SIGINT)
            assert stopped() is None
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_point_whose_process_dies_is_named(tmp_path):
    def die(*_args):
        raise WorkerDeathError(30)
        yield

    with opened(SIMULATED, tmp_path / "r.sqlite") as (sweep, store):
        row = rows_of(sweep.grid.chunk(30, 31), None)[0]
        where = rf"point 30 \(costs steffes2014, method larsen, N={row[2]}, M={row[3]}, L={row[4]}\)"
        with pytest.raises(InputError, match=where):
            run(sweep, store, die, no_progress)
