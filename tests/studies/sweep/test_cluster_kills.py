"""A sweep on a real Dask cluster whose processes are killed again and again."""

import operator
import os
import random
import signal
import threading
from contextlib import suppress
from functools import partial

import pytest

from sched_sim.errors import InputError
from studies.sweep import cluster as team
from studies.sweep import run as sweeping
from studies.sweep.dispatch import WorkerDeathError
from studies.sweep.run import run
from studies.sweep.scheduler import cluster
from studies.sweep.settings import settings
from studies.sweep.workers import processes
from tests.exhaust import share_of
from tests.studies.sweep.dask_processes import dask_processes
from tests.studies.sweep.exported import exported, local_rows

pytest.importorskip("distributed", reason="the extra cluster is not installed")

pytestmark = pytest.mark.exhaust

SWEEP = settings({"N": "10:40:10", "M": "1:4", "simulate": True, "cycles": 10}).sweep()
FAILURES = "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES"


@pytest.fixture(autouse=True)
def small_portions(monkeypatch):
    monkeypatch.setattr(sweeping, "SIMULATED_STEPS", 5_000)


@pytest.fixture(scope="module")
def local(tmp_path_factory):
    """The rows of a sweep without a cluster, as CSV."""
    return local_rows(SWEEP, tmp_path_factory.mktemp("local"), processes(2))


class Killer(threading.Thread):
    """Kills workers at any time, until so many were killed, or it is told to stop."""

    def __init__(self, nannies, number, draw):
        super().__init__(daemon=True)
        self.nannies = nannies
        self.number = number
        self.draw = draw
        self.killed = 0
        self.end = threading.Event()

    def run(self):
        import psutil

        while self.killed < self.number and not self.end.wait(self.draw.uniform(0, 1)):
            nanny = psutil.Process(self.draw.choice(self.nannies).pid)
            workers = [child for child in nanny.children() if "spawn_main" in " ".join(child.cmdline())]
            with suppress(psutil.NoSuchProcess):
                for worker in workers:
                    worker.kill()
                    self.killed += 1


@pytest.mark.parametrize("failures", ["0", "3"], ids=["dask-gives-up-at-once", "dask-tries-again"])
@pytest.mark.parametrize("part", range(5))
def test_fifty_killed_workers_lose_no_row(tmp_path, local, part, failures, record_property):
    """All in all; those of a part in as many sweeps as it takes."""
    number = share_of(5)
    with dask_processes(tmp_path, **{FAILURES: failures}) as dask:
        killer = Killer([dask.worker(nanny=True) for _ in range(2)], number, random.Random(part))
        with cluster(dask.address, SWEEP) as compute:
            killer.start()
            while killer.killed < number:
                folder = tmp_path / f"after-{killer.killed}"
                folder.mkdir(exist_ok=True)
                with SWEEP.open(folder / "r.sqlite") as store:
                    assert run(SWEEP, store, compute, lambda _: None).stopped is None
                    assert exported(store, folder) == local
                (folder / "r.sqlite").unlink()
            killer.join()
    record_property("kills", killer.killed)


@pytest.mark.parametrize("part", range(5))
def test_killed_schedulers_lose_no_row(tmp_path, local, part, record_property):
    """The same sweep goes on with the next one."""
    draw, kills = random.Random(part), 0
    with SWEEP.open(tmp_path / "r.sqlite") as store:
        for attempt in range(share_of(3)):
            folder = tmp_path / str(attempt)
            folder.mkdir()
            with dask_processes(folder) as dask:
                dask.worker()
                threading.Timer(draw.uniform(0, 2), dask.scheduler.kill).start()
                with suppress(InputError), cluster(dask.address, SWEEP) as compute:
                    run(SWEEP, store, compute, lambda _: None)
                kills += dask.scheduler.poll() == -signal.SIGKILL
        run(SWEEP, store, processes(0), lambda _: None)
        assert exported(store, tmp_path) == local
    record_property("kills", kills)


def test_without_workers_for_long_it_ends_and_keeps_what_is_done(tmp_path, monkeypatch):
    monkeypatch.setattr(team, "WORKERLESS_S", 2)
    with dask_processes(tmp_path) as dask, SWEEP.open(tmp_path / "r.sqlite") as store:
        worker = dask.worker()
        with cluster(dask.address, SWEEP) as compute, pytest.raises(InputError, match="has had no worker for 2 s"):
            run(SWEEP, store, compute, lambda done: worker.kill() if done else None)
        assert 0 < store.count() < SWEEP.grid.size


def test_a_point_that_kills_its_worker_each_time_is_named(tmp_path):
    bad = 3

    def task(span):
        return partial(os._exit, 1) if bad in span else partial(list, span)

    with dask_processes(tmp_path) as dask:
        for _ in range(2):
            dask.worker(nanny=True)
        with cluster(dask.address, SWEEP) as compute, pytest.raises(WorkerDeathError) as error:
            list(compute(operator.call, iter([range(2), range(2, 4)]), task, lambda: False))
    assert error.value.point == bad
