"""Worker processes that die: nothing is lost, and the guilty point is named."""

import errno
import operator
import os
from functools import partial
from multiprocessing import synchronize

import pytest

from studies.workers import WorkerDeathError, compute

SIZE = 5


def spans(count):
    return iter([range(start, start + SIZE) for start in range(0, count * SIZE, SIZE)])


def test_every_span_is_computed():
    found = compute(operator.call, spans(8), lambda span: partial(list, span), 2, lambda: False)
    assert sorted(point for part in found for point in part) == list(range(8 * SIZE))


def test_a_point_that_kills_its_worker_each_time_is_named():
    bad = 7

    def task(span):
        return partial(os._exit, 1) if bad in span else partial(list, span)

    with pytest.raises(WorkerDeathError) as error:
        list(compute(operator.call, spans(3), task, 2, lambda: False))
    assert error.value.point == bad


def test_a_worker_that_dies_loses_no_span(tmp_path):
    """The first to run the span of point 7 dies; the file it leaves tells the second to go on."""
    mark = tmp_path / "died"

    def task(span):
        if 7 in span and not mark.exists():
            mark.touch()
            return partial(os._exit, 1)
        return partial(list, span)

    found = compute(operator.call, spans(8), task, 2, lambda: False)
    assert sorted(point for part in found for point in part) == list(range(8 * SIZE))


def test_an_error_in_the_work_is_raised():
    with pytest.raises(ZeroDivisionError):
        list(compute(operator.call, spans(2), lambda _: partial(operator.truediv, 1, 0), 2, lambda: False))


def test_once_stopped_no_more_is_begun():
    found = list(compute(operator.call, spans(3), lambda span: partial(list, span), 2, lambda: True))
    assert found == []


def test_where_no_worker_can_be_started_the_work_is_done_here(monkeypatch):
    def read_only(*_, **__):
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr(synchronize.SemLock, "__init__", read_only)  # as with a read-only /dev/shm
    found = compute(operator.call, spans(3), lambda span: partial(lambda: (os.getpid(), *span)), 2, lambda: False)
    assert list(found) == [(os.getpid(), *span) for span in spans(3)]
