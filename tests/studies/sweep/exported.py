"""The rows of a sweep as the bytes of a CSV file."""

from __future__ import annotations

from pathlib import Path

from studies.sweep.dispatch import Compute
from studies.sweep.export import export
from studies.sweep.run import Sweep, run
from studies.sweep.store import Store


def exported(store: Store, folder: Path) -> bytes:
    export(store, folder / "r.csv")
    return (folder / "r.csv").read_bytes()


def local_rows(sweep: Sweep, folder: Path, compute: Compute) -> bytes:
    """Without a cluster."""
    with sweep.open(folder / "r.sqlite") as store:
        run(sweep, store, compute, lambda _: None)
        return exported(store, folder)
