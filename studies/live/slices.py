"""What ran as a schedule, as the simulated one is: in ticks of 1 ns, for charts and traces."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from sched_sim.schedule.outcome import Response, Schedule, Slice
from studies.live.design import Design
from studies.live.jobs import Job

LABELS = {
    "hr_restart": "HRP",
    "hr_propagate": "HRP",
    "hr_update": "HRU",
    "lr_propagate": "LRP",
    "lr_update": "LRU",
}
Spans = Sequence[tuple[int, int]]


def schedule_of(jobs: Iterable[Job], design: Design, *, swapped: bool = False) -> Schedule:
    """The schedule of all steps. swapped: LR preempted HR."""
    kept = list(jobs)
    above = sorted((job.start, job.end) for job in kept if job.high != swapped)
    released = {job.step: job.end for job in kept if job.high}  # LR propagate by the end of the HR job of k
    last = {(_kind(job), job.step): job for job in kept}
    slices: list[Slice] = []
    for job in kept:
        preempted_by = above if job.high == swapped else ()
        final = last[_kind(job), job.step] is job
        slices += _slices(job, preempted_by, final, *_times(job, design, released), design.period_ns)
    slices.sort(key=lambda piece: (piece.end, piece.start))
    busy = sum(piece.end - piece.start for piece in slices)
    horizon = design.steps * design.period_ns
    return Schedule(design.period_ns, horizon, 1, busy, responses_of(slices), None, 0, Counter(), tuple(slices))


def responses_of(slices: Sequence[Slice]) -> dict[str, Response]:
    """Figures of each kind of job, of those that have finished."""
    return {kind: _response(kind, slices) for kind in dict.fromkeys(piece.kind for piece in slices)}


def _kind(job: Job) -> str:
    """As the simulation calls it."""
    return "hr" if job.high else job.kind


def _times(job: Job, design: Design, released: dict[int, int]) -> tuple[int, int]:
    """Release and deadline."""
    period, k = design.period_ns, job.step
    arrival, last = (k + design.M) * period, (k + design.N) * period
    if job.high:
        return k * period, (k + 1) * period
    if job.kind == "lr_propagate":
        return min(released.get(k, k * period), job.start), arrival if design.M else last
    return arrival, last


def _slices(job: Job, above: Spans, final: bool, release: int, deadline: int, period: int) -> Iterator[Slice]:
    """Between what preempted it."""
    runs = list(_left(job, above))
    parts = ((LABELS[job.kind], sum(end - start for start, end in runs)),)
    done = 0
    for number, (start, end) in enumerate(runs, start=1):
        finished = final and number == len(runs)
        yield Slice(0, start, end, _kind(job), job.step, done, 0, parts, finished, release, deadline, period)
        done += end - start


def _left(job: Job, above: Spans) -> Iterator[tuple[int, int]]:
    """Of the time from its start to its end, what the others leave."""
    at = job.start
    for start, end in above[max(bisect_left(above, (at, at)) - 1, 0) :]:
        if start >= job.end:
            break
        if end > at:
            if start > at:
                yield at, start
            at = end
    if at < job.end:
        yield at, job.end


def _response(kind: str, slices: Iterable[Slice]) -> Response:
    done = [piece for piece in slices if piece.kind == kind and piece.finished]
    times = [piece.end - piece.release for piece in done]
    late = [piece.end - piece.deadline for piece in done]
    runs = sum(piece.kind == kind for piece in slices)
    misses = sum(lateness > 0 for lateness in late)
    return Response(len(done), len(done), max(times, default=0), sum(times), misses, max([0, *late]), runs - len(done))
