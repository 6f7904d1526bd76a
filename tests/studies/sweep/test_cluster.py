"""A sweep on a real Dask cluster: the rows of a local one, whatever is killed."""

import os
import shutil
import signal
import subprocess
import sys
from functools import partial

import pytest

from sched_sim.errors import InputError
from studies.sweep import run as sweeping
from studies.sweep.run import run
from studies.sweep.scheduler import cluster
from studies.sweep.settings import settings
from studies.sweep.workers import processes
from tests.studies.sweep.dask_processes import ROOT, dask_processes
from tests.studies.sweep.exported import exported, local_rows

pytest.importorskip("distributed", reason="the extra cluster is not installed")

SWEEP = settings({"N": "4:5", "M": "1:2", "speed": "0.8,1.2", "simulate": True, "cycles": 20}).sweep()


@pytest.fixture(autouse=True)
def small_portions(monkeypatch):
    monkeypatch.setattr(sweeping, "SIMULATED_STEPS", 200)


@pytest.fixture(scope="module")
def local(tmp_path_factory):
    """The rows of a sweep without a cluster, as CSV."""
    return local_rows(SWEEP, tmp_path_factory.mktemp("local"), processes(0))


@pytest.fixture(scope="module")
def dask(tmp_path_factory):
    """With a worker. The scheduler takes what is on a killed one for its cause, which by default is after four."""
    with dask_processes(tmp_path_factory.mktemp("dask"), DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES="0") as dask:
        dask.worker()
        yield dask


def once(action):
    """For `on_progress`: does it as soon as there are rows."""
    todo = [action]

    def on_progress(done):
        if done and todo:
            todo.pop()()

    return on_progress


def killed_once(mark, work, chunk):
    """In a worker: the first to come to the middle of the grid is killed."""
    if SWEEP.grid.size // 2 in chunk.points and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return work(chunk)


def test_a_worker_that_is_killed_loses_no_row(dask, tmp_path, local):
    dask.worker()
    mark = tmp_path / "killed"
    with cluster(dask.address, SWEEP) as compute, SWEEP.open(tmp_path / "r.sqlite") as store:

        def deadly(work, *others):
            return compute(partial(killed_once, mark, work), *others)

        assert run(SWEEP, store, deadly, lambda _: None) == (0, SWEEP.grid.size, None)
        assert exported(store, tmp_path) == local
    assert mark.exists()


def test_ctrl_c_keeps_what_is_done_and_the_same_sweep_goes_on(dask, tmp_path, local):
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
    stranger = dask.worker(before="import sys; sys.modules['studies'] = None")
    refused = r"worker tcp://127\.0\.0\.1:\d+ cannot run .*install the same"
    with pytest.raises(InputError, match=refused), cluster(dask.address, SWEEP):
        pass
    stranger.terminate()  # and it signs off
    stranger.wait()


def test_a_worker_is_no_scheduler(dask):
    import distributed

    with distributed.Client(dask.address, set_as_default=False) as client:
        worker = next(iter(client.nthreads()))
    with pytest.raises(InputError, match="that is a worker: give the address of its scheduler"), cluster(worker, SWEEP):
        pass


def test_the_command_prints_what_it_does_without_a_cluster(dask, sched_sim):
    line = "sweep -N 4 -M 1:2 --simulate --format json --results"
    by_dask = sched_sim(f"{line} dask.sqlite --dask {dask.address}")
    here = sched_sim(f"{line} here.sqlite")
    assert (by_dask.code, by_dask.err) == (0, "")
    assert by_dask.out.replace("dask.sqlite", "here.sqlite") == here.out


def test_nothing_listens_here(dask):
    import psutil

    def listening():
        return {at.laddr for at in psutil.Process().net_connections() if at.status == psutil.CONN_LISTEN}

    before = listening()
    with cluster(dask.address, SWEEP):
        assert listening() <= before


@pytest.mark.exhaust
def test_a_worker_that_comes_later_is_compared_too(tmp_path):
    other = "from studies.sweep import versions\nversions.versions = lambda: {'numpy': '1'}"
    with dask_processes(tmp_path) as dask, SWEEP.open(tmp_path / "r.sqlite") as store:
        dask.worker()
        with cluster(dask.address, SWEEP) as compute, pytest.raises(InputError, match=r"worker tcp:.*numpy is 1 there"):
            run(SWEEP, store, compute, once(lambda: dask.worker(before=other)))


TLS = """\
distributed:
  comm:
    default-scheme: tls
    require-encryption: true
    tls:
      ca-file: FOLDER/cluster.pem
      scheduler: {cert: FOLDER/cluster.pem, key: FOLDER/key.pem}
      worker: {cert: FOLDER/cluster.pem, key: FOLDER/key.pem}
      client: {cert: FOLDER/cluster.pem, key: FOLDER/key.pem}
"""
MAKE_KEY = "openssl req -x509 -newkey rsa:2048 -nodes -days 365 -subj /CN=cluster -keyout key.pem -out cluster.pem"


@pytest.mark.exhaust
@pytest.mark.skipif(shutil.which("openssl") is None, reason="there is no openssl to make a key with")
def test_tls_as_the_how_to_has_it(tmp_path):
    """Who has the key gets in, who has not is told."""
    page = (ROOT / "docs/howto/cluster.md").read_text(encoding="utf-8")
    assert MAKE_KEY in page
    assert TLS in page
    subprocess.run(MAKE_KEY.split(), cwd=tmp_path, check=True, capture_output=True)
    (tmp_path / "tls.yaml").write_text(TLS.replace("FOLDER", str(tmp_path)))
    with dask_processes(tmp_path, DASK_CONFIG=str(tmp_path)) as dask:
        dask.worker()
        assert dask.address.startswith("tls://127.0.0.1:")

        def swept(address, **settings):
            line = f"-m sched_sim sweep -N 4 -M 1 --simulate --dask {address} --format csv".split()
            environment = os.environ | {"PYTHONPATH": str(ROOT), **settings}
            return subprocess.run(
                [sys.executable, *line], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
            )

        assert "no scheduler answers" in swept(dask.address.replace("tls", "tcp")).stderr
        assert "there are no keys for TLS" in swept(dask.address).stderr
        assert swept(dask.address, DASK_CONFIG=str(tmp_path)).returncode == 0
