"""A progress bar on standard error, where that is a terminal; nothing otherwise.

It is drawn when there is progress, not by a thread of its own, which would disturb what is being timed.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from sched_sim.text import visible

Progress = Callable[[int, int | None, str], None]
"""To be called with (done, total, what is being done)."""


@contextmanager
def progress_bar(title: str) -> Iterator[Progress]:
    """A function to be called with (done, total, what is being done); total: None where nobody knows it."""
    if not sys.stderr.isatty():
        yield lambda _done, _total, _what: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True, auto_refresh=False) as bar:
        task = bar.add_task(title, total=None)  # by default it is 100

        def show(done: int, total: int | None, what: str) -> None:
            bar.update(task, completed=done, total=total, description=visible(f"{title}: {what}"), refresh=True)

        yield show


@contextmanager
def simulations(method: str) -> Iterator[Callable[[int], None]]:
    """A function to be called with how many simulations the search for the least speed of `method` has run."""
    with progress_bar("Simulating") as show:
        yield lambda runs: show(runs, None, method)
