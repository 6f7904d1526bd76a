"""Every slice of a schedule, written as it ends: CSV, or Chrome Trace Event JSON (for Perfetto, chrome://tracing)."""

from __future__ import annotations

import csv
from codecs import StreamWriter, getwriter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from sched_sim.errors import InputError, option
from sched_sim.files.writable import check_writable, writing
from sched_sim.schedule.outcome import Slice
from sched_sim.text import csv_cell, json_text

Write = Callable[[Slice], None]

COLUMNS = ("cpu", "kind", "piece", "step", "start", "end", "release", "deadline", "finished", "missed")

UNFINISHED = "unfinished"
"""Instead of a piece: how a job stands at the end of the simulated time, whether it has run before or not."""

TOGETHER = "together"
"""Instead of a piece: a job that is done as another one is, with no work of its own."""


@contextmanager
def open_trace(path: str | Path, microseconds_per_period: float = 1000.0) -> Iterator[Write]:
    """A function that writes one slice to `path`, in the format of its suffix.

    CSV: a row for each piece of a slice, times in HR periods. JSON: one complete event for each piece, one HR period
    lasting `microseconds_per_period`; each CPU is a process, each job kind a thread. A job that is unfinished at
    the end, or done together with another, has a row of no length, or an instant event.
    The file is there once all is written. Raises InputError for another suffix and for a path that cannot be written.
    """
    path = Path(path)
    check_trace(path)
    with (
        writing(path, option("trace")) as file,
        WRITERS[path.suffix](getwriter("utf-8")(file), microseconds_per_period) as write,
    ):
        yield write


def check_trace(path: Path) -> None:
    """Raises InputError as `open_trace` does: to be called before the work whose trace it is."""
    if path.suffix not in WRITERS:
        raise InputError(f"{option('trace')} {str(path)!r}: the name must end in {' or '.join(sorted(WRITERS))}")
    check_writable(path, option("trace"))


@contextmanager
def _csv(file: StreamWriter, _scale: float) -> Iterator[Write]:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)

    def write(piece: Slice) -> None:
        period = piece.period
        for label, start, end in piece.pieces() or [(_standing(piece), piece.start, piece.end)]:
            writer.writerow(
                (
                    piece.cpu + 1,
                    csv_cell(piece.kind),
                    csv_cell(label),
                    piece.step,
                    start / period,
                    end / period,
                    piece.release / period,
                    piece.deadline / period,
                    int(piece.finished and end == piece.end),
                    int(piece.missed),
                )
            )

    yield write


@contextmanager
def _chrome(file: StreamWriter, scale: float) -> Iterator[Write]:
    threads: dict[tuple[int, str], int] = {}
    separator = "\n"

    def event(**fields: object) -> None:
        nonlocal separator
        file.write(separator + json_text(fields))
        separator = ",\n"

    def thread(cpu: int, kind: str) -> int:
        if (cpu, kind) not in threads:
            threads[cpu, kind] = tid = len(threads) + 1
            event(name="process_name", ph="M", pid=cpu, args={"name": f"CPU {cpu}"})
            event(name="thread_name", ph="M", pid=cpu, tid=tid, args={"name": kind})
        return threads[cpu, kind]

    def write(piece: Slice) -> None:
        cpu, period = piece.cpu + 1, piece.period
        tid = thread(cpu, piece.kind)
        about = {"step": piece.step, "release": piece.release / period, "deadline": piece.deadline / period}
        for label, start, end in piece.pieces():
            event(
                name=label,
                cat=piece.kind,
                ph="X",
                pid=cpu,
                tid=tid,
                ts=start * scale / period,
                dur=(end - start) * scale / period,
                args=about,
            )
        if piece.start == piece.end or (piece.finished and piece.missed):
            name = "missed" if piece.missed else _standing(piece)
            event(name=name, ph="i", s="t", pid=cpu, tid=tid, ts=piece.end * scale / period, args=about)

    file.write('{"displayTimeUnit": "ms", "traceEvents": [')
    yield write
    file.write("\n]}\n")


def _standing(piece: Slice) -> str:
    """What a slice of no length says."""
    return TOGETHER if piece.finished else UNFINISHED


WRITERS = {".csv": _csv, ".json": _chrome}
