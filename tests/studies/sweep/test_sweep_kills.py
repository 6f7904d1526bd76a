"""The command `sched-sim sweep`, killed for real: no finished row is lost, and no process is left."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import pytest

from tests.deaths import call_alone, traceable
from tests.exhaust import share_of
from tests.studies.sweep.random_kills import PATIENCE_S

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks at processes in /proc"),
]

# Some 2 s of work for one core, in 20 portions.
GRID = ["-N", "10:40:10", "-M", "1:4", "--simulate", "--cycles", "60", "--workers", "2"]
ROOT = Path(__file__).resolve().parents[3]


def command(folder, *more):
    return [sys.executable, "-m", "sched_sim", "sweep", *GRID, "--results", str(folder / "r.sqlite"), *more]


ENVIRONMENT = os.environ | {"PYTHONPATH": str(ROOT)}


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    """The exported CSV."""
    folder = tmp_path_factory.mktemp("whole")
    subprocess.run(command(folder, "--export", str(folder / "r.csv")), env=ENVIRONMENT, check=True, capture_output=True)
    return (folder / "r.csv").read_bytes()


@contextmanager
def begun(folder):
    """The sweep, in a session of its own; whatever a failed test left of it is killed."""
    pipe = subprocess.PIPE
    line = command(folder, "--export", str(folder / "r.csv"))
    with subprocess.Popen(
        line, env=ENVIRONMENT, stdout=pipe, stderr=pipe, text=True, start_new_session=True
    ) as process:
        try:
            yield process
        finally:
            for pid, _ in processes_of(process.pid):
                with suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)


def processes_of(session):
    """(pid, command line) of those that live; a zombie does not."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            state, _parent, _group, of = (entry / "stat").read_text().rsplit(")", 1)[1].split()[:4]
            if int(of) == session and state != "Z":
                found.append((int(entry.name), (entry / "cmdline").read_text()))
        except (FileNotFoundError, ProcessLookupError):  # it has just ended
            continue
    return found


def workers_of(session):
    return [pid for pid, line in processes_of(session) if "spawn_main" in line]


def rows_in(folder):
    path = folder / "r.sqlite"
    if not path.exists():
        return 0
    with closing(sqlite3.connect(f"{path.as_uri()}?mode=ro", uri=True)) as connection:
        return connection.execute("SELECT COUNT(*) FROM rows").fetchone()[0]


def wait_for(condition):
    """What the condition came to, once it is true."""
    end = time.monotonic() + PATIENCE_S
    while not (found := condition()):
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)
    return found


def assert_resumed_equals(folder, uninterrupted):
    done = subprocess.run(
        command(folder, "--export", str(folder / "r.csv")), env=ENVIRONMENT, check=True, capture_output=True, text=True
    )
    assert "were there before" in done.stdout
    assert (folder / "r.csv").read_bytes() == uninterrupted
    assert sorted(os.listdir(folder)) == ["r.csv", "r.sqlite"]


@pytest.mark.exhaust
def test_kill_9_of_the_parent(tmp_path, uninterrupted):
    with begun(tmp_path) as process:
        acknowledged = wait_for(lambda: rows_in(tmp_path))
        process.kill()
        process.communicate(timeout=PATIENCE_S)
        wait_for(lambda: not processes_of(process.pid))
    kept = rows_in(tmp_path)
    assert acknowledged <= kept < uninterrupted.count(b"\n") - 1
    assert not (tmp_path / "r.csv").exists()
    assert_resumed_equals(tmp_path, uninterrupted)


@pytest.mark.exhaust
def test_kill_9_of_a_worker(tmp_path, uninterrupted):
    with begun(tmp_path) as process:
        wait_for(lambda: rows_in(tmp_path))
        os.kill(workers_of(process.pid)[0], signal.SIGKILL)
        _out, errors = process.communicate(timeout=PATIENCE_S)
        assert (process.returncode, errors) == (0, "")
        wait_for(lambda: not processes_of(process.pid))
    assert (tmp_path / "r.csv").read_bytes() == uninterrupted


@pytest.mark.parametrize(
    ("number", "to_all"),
    [
        pytest.param(signal.SIGINT, True, id="ctrl-c", marks=pytest.mark.exhaust),
        pytest.param(signal.SIGINT, False, id="sigint", marks=pytest.mark.exhaust),
        pytest.param(signal.SIGTERM, False, id="sigterm", marks=pytest.mark.exhaust),
    ],
)
def test_signals(tmp_path, uninterrupted, number, to_all):
    """Ctrl-C goes to every process of the terminal."""
    with begun(tmp_path) as process:
        acknowledged = wait_for(lambda: rows_in(tmp_path))
        (os.killpg if to_all else os.kill)(process.pid, number)
        out, errors = process.communicate(timeout=PATIENCE_S)
        assert process.returncode == 128 + number
        wait_for(lambda: not processes_of(process.pid))
    kept = rows_in(tmp_path)
    size = uninterrupted.count(b"\n") - 1
    assert acknowledged <= kept < size
    assert out == ""
    assert errors == (
        f"Stopped by {number.name}: {kept} of {size} points are kept in {tmp_path / 'r.sqlite'}; "
        f"the same command again goes on from there.\n"
    )
    assert_resumed_equals(tmp_path, uninterrupted)


def test_ctrl_c_while_the_workers_start(tmp_path):
    with begun(tmp_path) as process:
        wait_for(lambda: workers_of(process.pid))
        os.killpg(process.pid, signal.SIGINT)
        _out, errors = process.communicate(timeout=PATIENCE_S)
        assert process.returncode == 130
        assert errors.startswith("Stopped by SIGINT: ")
        assert errors.count("\n") == 1
        wait_for(lambda: not processes_of(process.pid))


def kill_many(part, number):
    done = call_alone("tests.studies.sweep.random_kills", "kill_many", 10_000 * part, number)
    assert done.returncode == 0, done.stderr


@pytest.mark.exhaust
@pytest.mark.skipif(not traceable(), reason="no process can be traced here")
def test_random_kills_lose_nothing():
    kill_many(0, 12)


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(1, 26))
def test_a_thousand_random_kills_lose_nothing(part, record_property):
    """Of the parent, of a worker, at a system call."""
    number = share_of(40)
    kill_many(part, number)
    record_property("kills", number)
