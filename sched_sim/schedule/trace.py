"""Every slice of a schedule as it ends, in a file that says the unit of its times: ms where the HR rate is known, else
HR periods.

CSV: a row for each piece of a slice, the unit in the names of its columns. JSON (Chrome Trace Event): one complete
event for each piece, each CPU a process, each job kind a thread. The format has no unit but of time: without a rate a
period is drawn 1 ms long, and the names of the processes and `otherData` say so.
"""

from __future__ import annotations

import csv
from codecs import StreamWriter, getwriter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

from sched_sim.errors import InputError, option
from sched_sim.files.writable import check_writable, writing
from sched_sim.schedule.outcome import Slice
from sched_sim.text import csv_cell, json_text
from sched_sim.ticks import Number, positive

Write = Callable[[Slice], None]

UNFINISHED = "unfinished"
"""Instead of a piece: how a job stands at the end of the simulated time, whether it has run before or not."""

TOGETHER = "together"
"""Instead of a piece: a job that is done as another one is, with no work of its own."""


class TimeUnit(NamedTuple):
    """name: as keys end; per_period: how many are an HR period; said: what a viewer of JSON must know, if anything;
    hr_hz: None if it is not known."""

    name: str
    per_period: float
    said: str
    hr_hz: float | None

    def keys(self, *names: str) -> list[str]:
        return [f"{name}_{self.name}" for name in names]

    def of(self, ticks: int, piece: Slice) -> float:
        return ticks * self.per_period / piece.period


def time_unit(rate: Fraction | None) -> TimeUnit:
    """rate: of the HR loop in Hz, if it is known."""
    if rate is None:
        return TimeUnit("periods", 1.0, "1 ms = 1 HR period", None)
    return TimeUnit("ms", float(1000 / rate), "", float(rate))


@contextmanager
def open_trace(path: str | Path, hr_hz: Number | None = None, names: Sequence[str] = ()) -> Iterator[Write]:
    """A function that writes one slice to `path`, in the format of its suffix; the file is there once all is written.

    hr_hz: rate of the HR loop in Hz, with which times are in ms, else in HR periods; names: of the processors in a
    Chrome trace, else CPU 1, 2, ... A job that is unfinished at the end, or done together with another, has a row of no
    length, or an instant event. Raises InputError for another suffix and for a path that cannot be written.
    """
    path = Path(path)
    check_trace(path)
    unit = time_unit(None if hr_hz is None else positive(hr_hz, "hr_hz"))
    with writing(path, option("trace")) as file, WRITERS[path.suffix](getwriter("utf-8")(file), unit, names) as write:
        yield write


def check_trace(path: Path) -> None:
    """Raises InputError as `open_trace` does: to be called before the work whose trace it is."""
    if path.suffix not in WRITERS:
        raise InputError(f"{option('trace')} {str(path)!r}: the name must end in {' or '.join(sorted(WRITERS))}")
    check_writable(path, option("trace"))


@contextmanager
def _csv(file: StreamWriter, unit: TimeUnit, _names: Sequence[str]) -> Iterator[Write]:
    writer = csv.writer(file, lineterminator="\n")
    times = unit.keys("start", "end", "release", "deadline")
    writer.writerow(("cpu", "kind", "piece", "step", *times, "finished", "missed"))

    def write(piece: Slice) -> None:
        for label, start, end in piece.pieces() or [(_standing(piece), piece.start, piece.end)]:
            instants = (unit.of(ticks, piece) for ticks in (start, end, piece.release, piece.deadline))
            finished = int(piece.finished and end == piece.end)
            about = (piece.cpu + 1, csv_cell(piece.kind), csv_cell(label), piece.step)
            writer.writerow((*about, *instants, finished, int(piece.missed)))

    yield write


@contextmanager
def _chrome(file: StreamWriter, unit: TimeUnit, names: Sequence[str]) -> Iterator[Write]:
    threads: dict[tuple[int, str], int] = {}
    separator = "\n"
    drawn_us = 1000.0 if unit.hr_hz is None else 1e6 / unit.hr_hz

    def event(**fields: object) -> None:
        nonlocal separator
        file.write(separator + json_text(fields))
        separator = ",\n"

    def thread(cpu: int, kind: str) -> int:
        if (cpu, kind) not in threads:
            threads[cpu, kind] = tid = len(threads) + 1
            name = names[cpu - 1] if names else f"CPU {cpu}"
            said = f"{name}, {unit.said}" if unit.said else name
            event(name="process_name", ph="M", pid=cpu, args={"name": said})
            event(name="thread_name", ph="M", pid=cpu, tid=tid, args={"name": kind})
        return threads[cpu, kind]

    def write(piece: Slice) -> None:
        cpu, us = piece.cpu + 1, drawn_us / piece.period
        tid = thread(cpu, piece.kind)
        instants = (unit.of(ticks, piece) for ticks in (piece.release, piece.deadline))
        about = {"step": piece.step, **dict(zip(unit.keys("release", "deadline"), instants, strict=True))}
        place = {"pid": cpu, "tid": tid, "args": about}
        for label, start, end in piece.pieces():
            event(name=label, cat=piece.kind, ph="X", ts=start * us, dur=(end - start) * us, **place)
        if piece.start == piece.end or (piece.finished and piece.missed):
            event(name="missed" if piece.missed else _standing(piece), ph="i", s="t", ts=piece.end * us, **place)

    other = {"time_unit": unit.said or unit.name, "hr_hz": unit.hr_hz}
    file.write(f'{{"displayTimeUnit": "ms", "otherData": {json_text(other)}, "traceEvents": [')
    yield write
    file.write("\n]}\n")


def _standing(piece: Slice) -> str:
    """What a slice of no length says."""
    return TOGETHER if piece.finished else UNFINISHED


WRITERS = {".csv": _csv, ".json": _chrome}
