"""Worker processes that die: nothing is lost, and the guilty point is named."""

import errno
import operator
import os
import signal
from concurrent.futures.process import _ExecutorManagerThread
from contextlib import suppress
from functools import partial
from multiprocessing import active_children, synchronize
from threading import Thread

import pytest

from studies.sweep.dispatch import WorkerDeathError
from studies.sweep.workers import processes

SIZE = 5

PATIENCE_S = 300
"""Longer than any machine needs, however busy."""

HALF_SENT = """
import os
from multiprocessing.connection import Connection

def send_half(self, data):
    os.write(self.fileno(), bytes(data)[: len(data) // 2])
    os._exit(1)

Connection._send = send_half
"""


def ends(work):
    """Whether `work` ever ends; workers that it leaves are killed."""
    thread = Thread(target=work, daemon=True)
    thread.start()
    thread.join(PATIENCE_S)
    for worker in active_children():
        with suppress(ProcessLookupError):
            os.kill(worker.pid, signal.SIGKILL)
    return not thread.is_alive()


def spans(count):
    return iter([range(start, start + SIZE) for start in range(0, count * SIZE, SIZE)])


def test_every_span_is_computed():
    found = processes(2)(operator.call, spans(8), lambda span: partial(list, span), lambda: False)
    assert sorted(point for part in found for point in part) == list(range(8 * SIZE))


def test_a_point_that_kills_its_worker_each_time_is_named():
    bad = 7

    def task(span):
        return partial(os._exit, 1) if bad in span else partial(list, span)

    with pytest.raises(WorkerDeathError) as error:
        list(processes(2)(operator.call, spans(3), task, lambda: False))
    assert error.value.point == bad


def test_a_worker_that_dies_loses_no_span(tmp_path):
    """The first to run the span of point 7 dies; the file it leaves tells the second to go on."""
    mark = tmp_path / "died"

    def task(span):
        if 7 in span and not mark.exists():
            mark.touch()
            return partial(os._exit, 1)
        return partial(list, span)

    found = processes(2)(operator.call, spans(8), task, lambda: False)
    assert sorted(point for part in found for point in part) == list(range(8 * SIZE))


def test_a_worker_that_dies_as_it_sends_its_result_loses_no_span(tmp_path):
    """The other one lives, and holds the queue of results open."""
    mark = tmp_path / "died"
    found = []

    def task(span):
        if 7 in span and not mark.exists():
            mark.touch()
            return partial(exec, HALF_SENT)
        return partial(list, span)

    assert ends(lambda: found.extend(processes(2)(operator.call, spans(8), task, lambda: False)))
    assert sorted(point for part in found for point in part) == list(range(8 * SIZE))


def test_workers_end_though_the_word_to_stop_does_not_reach_them(monkeypatch):
    """As when one is killed, at the end of the work, while it has the queue of tasks locked."""
    monkeypatch.setattr(_ExecutorManagerThread, "shutdown_workers", lambda _: None)
    found = []
    assert ends(
        lambda: found.extend(processes(2)(operator.call, spans(2), lambda span: partial(list, span), lambda: False))
    )
    assert len(found) == 2


def test_an_error_in_the_work_is_raised():
    with pytest.raises(ZeroDivisionError):
        list(processes(2)(operator.call, spans(2), lambda _: partial(operator.truediv, 1, 0), lambda: False))


def test_once_stopped_no_more_is_begun():
    found = list(processes(2)(operator.call, spans(3), lambda span: partial(list, span), lambda: True))
    assert found == []


def test_where_no_worker_can_be_started_the_work_is_done_here(monkeypatch):
    def read_only(*_, **__):
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr(synchronize.SemLock, "__init__", read_only)  # as with a read-only /dev/shm
    found = processes(2)(operator.call, spans(3), lambda span: partial(lambda: (os.getpid(), *span)), lambda: False)
    assert list(found) == [(os.getpid(), *span) for span in spans(3)]
