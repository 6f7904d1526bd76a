"""What is to be said of methods whose estimate is not the one that the measurements allow."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from sched_sim.cli.output import lines
from sched_sim.costs.methods import CAVEATS


def caveat_note(methods: Iterable[str]) -> str:
    """For people, a line below a table for each such method; empty where there is nothing to say."""
    return lines(*(f"{method}: {CAVEATS[method]}" for method in methods if method in CAVEATS))


def with_caveats(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """For scripts: where one of the rows is of such a method, all have its `caveat`, None if it has none."""
    if not any(row["method"] in CAVEATS for row in rows):
        return list(rows)
    return [row | {"caveat": CAVEATS.get(row["method"])} for row in rows]
