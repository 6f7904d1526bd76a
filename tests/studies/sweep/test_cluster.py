"""A sweep on a real Dask cluster: the rows of a local one, whatever is killed."""

import os
import signal

import pytest

from sched_sim.errors import InputError
from studies.sweep import run as sweeping
from studies.sweep.export import export
from studies.sweep.run import run
from studies.sweep.scheduler import cluster
from studies.sweep.settings import settings
from studies.sweep.workers import processes
from tests.studies.sweep.dask_processes import dask_processes

pytest.importorskip("distributed", reason="the extra cluster is not installed")

SWEEP = settings({"N": "4:5", "M": "1:2", "speed": "0.8,1.2", "simulate": True, "cycles": 20}).sweep()


@pytest.fixture(autouse=True)
def small_portions(monkeypatch):
    monkeypatch.setattr(sweeping, "SIMULATED_STEPS", 200)


def exported(store, folder):
    export(store, folder / "r.csv")
    return (folder / "r.csv").read_bytes()


@pytest.fixture(scope="module")
def local(tmp_path_factory):
    """The rows of a sweep without a cluster, as CSV."""
    folder = tmp_path_factory.mktemp("local")
    with SWEEP.open(folder / "r.sqlite") as store:
        run(SWEEP, store, processes(0), lambda _: None)
        return exported(store, folder)


@pytest.fixture(scope="module")
def dask(tmp_path_factory):
    """A scheduler that takes what is on a killed worker for its cause, which Dask does after four of them."""
    with dask_processes(tmp_path_factory.mktemp("dask"), DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES="0") as dask:
        yield dask


def once(action):
    """For `on_progress`: does it as soon as there are rows."""
    todo = [action]

    def on_progress(done):
        if done and todo:
            todo.pop()()

    return on_progress


def test_a_worker_that_is_killed_loses_no_row(dask, tmp_path, local):
    dask.worker()
    guilty = dask.worker()
    with cluster(dask.address, SWEEP) as compute, SWEEP.open(tmp_path / "r.sqlite") as store:
        outcome = run(SWEEP, store, compute, once(guilty.kill))
        assert outcome == (0, SWEEP.grid.size, None)
        assert exported(store, tmp_path) == local
    assert guilty.wait() == -signal.SIGKILL


def test_ctrl_c_keeps_what_is_done_and_the_same_sweep_goes_on(dask, tmp_path, local):
    dask.worker()
    with cluster(dask.address, SWEEP) as compute, SWEEP.open(tmp_path / "r.sqlite") as store:
        outcome = run(SWEEP, store, compute, once(lambda: os.kill(os.getpid(), signal.SIGINT)))
        assert outcome.stopped == signal.SIGINT
        assert 0 < store.count() == outcome.computed < SWEEP.grid.size
        run(SWEEP, store, compute, lambda _: None)
        assert exported(store, tmp_path) == local


def test_a_lost_scheduler_loses_no_row_and_the_same_sweep_goes_on(tmp_path, local):
    with dask_processes(tmp_path) as dask, SWEEP.open(tmp_path / "r.sqlite") as store:
        dask.worker()
        told = []
        kill = once(dask.scheduler.kill)
        with (
            cluster(dask.address, SWEEP) as compute,
            pytest.raises(InputError, match=r"is gone: start it again; .* the same command goes on"),
        ):
            run(SWEEP, store, compute, lambda done: (told.append(done), kill(done)))
        assert 0 < told[-1] == store.count() < SWEEP.grid.size
        run(SWEEP, store, processes(0), lambda _: None)
        assert exported(store, tmp_path) == local


def test_a_worker_without_this_project_is_refused(dask):
    stranger = dask.worker(stranger=True)
    with pytest.raises(InputError, match=r"worker tcp://127\.0\.0\.1:\d+ cannot run .*install the same"):
        cluster(dask.address, SWEEP).__enter__()
    stranger.kill()
