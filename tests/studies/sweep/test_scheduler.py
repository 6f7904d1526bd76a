"""What is said of a scheduler that is not as a sweep needs it: one message, exit code 2, and no file is made."""

import os
import socket
import struct
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec

import pytest

from sched_sim.errors import InputError
from studies.sweep import scheduler
from studies.sweep.settings import settings
from studies.sweep.versions import refusal, versions

SWEEP = settings({"N": "4", "M": "1", "simulate": True}).sweep()

needs_dask = pytest.mark.skipif(find_spec("distributed") is None, reason="the extra cluster is not installed")


def refused(sched_sim, *more):
    result = sched_sim(f"sweep -N 4 -M 1 --simulate {' '.join(more)}")
    assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)
    assert os.listdir() == []
    return result.err


@pytest.mark.parametrize(
    "address", ["here", "127.0.0.1", "tcp://here", "here:0", "here:65536", "http://here:80", "inproc://here:1", "a b:1"]
)
def test_an_address_that_is_none(sched_sim, address):
    said = refused(sched_sim, "--dask", repr(address))
    assert said.startswith(f"Error: --dask {address!r} is no address of a scheduler: give tcp://HOST:PORT")


@pytest.mark.parametrize("address", ["here:1", "tcp://here.there:8786", "tls://10.0.0.1:8786", "tcp://[::1]:8786"])
def test_addresses(monkeypatch, sched_sim, address):
    monkeypatch.setattr(scheduler, "find_spec", lambda _: None)
    assert refused(sched_sim, "--dask", address) == (
        'Error: --dask needs the package distributed: pip install "sched-sim[cluster]"\n'
    )


def test_workers_of_both_kinds(sched_sim):
    assert "leave one out" in refused(sched_sim, "--dask 127.0.0.1:1 --workers 2")


@needs_dask
def test_no_scheduler_answers(monkeypatch, sched_sim):
    """Neither where nothing listens, nor where what does says nothing."""
    monkeypatch.setattr(scheduler, "ANSWER_S", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        busy = silent.getsockname()[1]
        assert f"--dask tcp://127.0.0.1:{busy}: no scheduler answers" in refused(sched_sim, f"--dask 127.0.0.1:{busy}")
    assert f"--dask tcp://127.0.0.1:{busy}: no scheduler answers" in refused(sched_sim, f"--dask 127.0.0.1:{busy}")


@needs_dask
@pytest.mark.parametrize("greeting", [b"SSH-2.0-OpenSSH_9.6\r\n", bytes(64), struct.pack("<3Q", 8, 0, 0)])
def test_what_listens_is_not_of_dask(sched_sim, greeting):
    """Dask takes it for lengths: of more than memory holds, of nothing, of a message without parts."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(60)  # a sweep that asks nobody fails the test, and does not hold it
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        with ThreadPoolExecutor(1) as pool:
            met = pool.submit(lambda: server.accept()[0])
            met.add_done_callback(lambda there: there.result().sendall(greeting))
            said = refused(sched_sim, f"--dask {address}")
            met.result().close()
    assert said.startswith(f"Error: --dask {address}: what listens there is not of Dask: give the address")


@needs_dask
def test_no_keys_for_tls(sched_sim):
    assert "--dask tls://127.0.0.1:1: there are no keys for TLS" in refused(sched_sim, "--dask tls://127.0.0.1:1")


@needs_dask
@pytest.mark.parametrize("there", [None, "no key"])
def test_keys_that_cannot_be_read(sched_sim, tmp_path, there):
    import dask

    file = tmp_path.parent / f"{tmp_path.name}.pem"
    if there:
        file.write_text(there)
    tls = "distributed.comm.tls"
    with dask.config.set({f"{tls}.ca-file": str(file), f"{tls}.client.cert": str(file)}):
        assert "the keys for TLS cannot be read" in refused(sched_sim, "--dask tls://127.0.0.1:1")


@needs_dask
def test_a_configuration_that_is_none(tmp_path):
    (tmp_path / "dask.yaml").write_text("distributed: [")
    line = [sys.executable, "-m", "sched_sim", "sweep", "-N", "4", "--dask", "127.0.0.1:1"]
    run = subprocess.run(line, env={**os.environ, "DASK_CONFIG": str(tmp_path)}, capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)
    assert run.stderr.startswith("Error: --dask tcp://127.0.0.1:1: A dask config file at ")


def test_versions_that_differ_are_named():
    here = versions()
    assert refusal(here, here) == ""
    assert refusal({**here, "numpy": "1"}, here).startswith(
        f"differs: numpy is 1 there and {here['numpy']} here: install"
    )
    assert refusal({}, here).startswith(f"differs: Python is unknown there and {here['Python']} here; numpy is unknown")
    assert refusal(ImportError("no studies"), here).startswith("cannot run this sched-sim (no studies): install")


class Told:
    """A client whose scheduler is as this process is, with a worker that gives that answer."""

    def __init__(self, answer):
        self.answer = answer

    def wait_for_workers(self, _number, _timeout):
        pass

    def run_on_scheduler(self, function, *asked):
        return function(*asked)

    def run(self, _function, *_asked, **_on_error):
        return {"tcp://here:1": self.answer}


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (({**versions(), "numpy": "1"}, ""), "DASK: worker tcp://here:1 differs: numpy is 1 there"),
        (Exception("ModuleNotFoundError"), "DASK: worker tcp://here:1 cannot run this sched-sim"),
        ((versions(), "0" * 64), "DASK: worker tcp://here:1 makes another grid of the same sweep"),
    ],
)
def test_a_worker_that_is_not_as_this_process_is(answer, said):
    with pytest.raises(InputError, match=f"^{said}"):
        scheduler._compare(Told(answer), SWEEP, "DASK")


@pytest.mark.parametrize("answer", [(versions(), SWEEP.digest), OSError("it has just gone")])
def test_a_worker_that_is_or_that_is_gone(answer):
    scheduler._compare(Told(answer), SWEEP, "DASK")


def test_help_does_not_wait_for_dask():
    code = (
        "import sys; from sched_sim.cli import main; sys.argv = ['sched-sim', 'sweep', '--help']\n"
        "try: main()\n"
        "finally: print({'distributed', 'dask'} & set(sys.modules), file=sys.stderr)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "--dask" in run.stdout
    assert run.stderr == "set()\n"
