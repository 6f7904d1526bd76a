"""What a schedule says of its slices, its jobs and its time."""

from __future__ import annotations

from fractions import Fraction

import pytest

from sched_sim.schedule.outcome import Response, Schedule, Slice


def slice_of(start: int, end: int, *, begin: int = 0, overhead: int = 0, finished: bool = True) -> Slice:
    """Of a job of 4 ticks of HRP, 3 of HRU and none of a third part, due at 20."""
    parts = ("HRP", 4), ("HRU", 3), ("NONE", 0)
    return Slice(0, start, end, "hr", 0, begin, overhead, parts, finished, release=0, deadline=20, period=20)


@pytest.mark.parametrize(
    ("end", "finished", "missed"),
    [(19, False, False), (20, True, False), (20, False, True), (21, True, True), (21, False, True)],
)
def test_a_deadline_is_missed_by_what_finishes_after_it_or_is_unfinished_at_it(
    end: int, finished: bool, missed: bool
) -> None:
    assert slice_of(15, end, finished=finished).missed == missed


@pytest.mark.parametrize(
    ("piece", "pieces"),
    [
        (slice_of(10, 17), [("HRP", 10, 14), ("HRU", 14, 17)]),
        (slice_of(10, 19, overhead=2), [("switch", 10, 12), ("HRP", 12, 16), ("HRU", 16, 19)]),
        (slice_of(10, 12, finished=False), [("HRP", 10, 12)]),
        (slice_of(10, 14, finished=False), [("HRP", 10, 14)]),
        (slice_of(10, 15, begin=2), [("HRP", 10, 12), ("HRU", 12, 15)]),
        (slice_of(10, 14, begin=4, overhead=1), [("switch", 10, 11), ("HRU", 11, 14)]),
        (slice_of(10, 12, begin=5), [("HRU", 10, 12)]),
        (slice_of(10, 11, overhead=1, finished=False), [("switch", 10, 11)]),
        (slice_of(10, 10, begin=3, finished=False), []),
    ],
)
def test_pieces_are_what_was_done_of_each_part_in_the_slice(piece: Slice, pieces: list[tuple[str, int, int]]) -> None:
    assert piece.pieces() == pieces


def response(finished: int, total: int, misses: int = 0, preemptions: int = 0) -> Response:
    return Response(5, finished, 9, total, misses, 0, preemptions)


def test_the_mean_is_of_finished_jobs_and_zero_without_any() -> None:
    assert response(4, 10).mean == Fraction(5, 2)
    assert response(0, 0).mean == 0


def test_misses_and_preemptions_are_those_of_all_kinds_and_utilization_that_of_all_processors() -> None:
    responses = {"hr": response(1, 1, misses=2, preemptions=3), "lr_update": response(1, 1, misses=5, preemptions=7)}
    schedule = Schedule(period=10, horizon=50, cpus=2, busy=30, responses=responses, first_miss=None, instants=9)
    assert (schedule.misses, schedule.preemptions, schedule.utilization) == (7, 10, Fraction(3, 10))
