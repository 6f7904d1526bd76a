"""What a sweep found, in a few rows: how the methods compare, and the best of them for each N and M."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from studies.store import Store
from studies.store_layout import BLOCK_COLUMNS

BEST = ("costs", "N", "M", "method", "L", "min_speed", "min_speed_exact", "binding")


def by_method(store: Store) -> list[dict[str, Any]]:
    """For each cost table and method: points, how many of them meet every deadline, and the least and greatest of
    their least speeds."""
    names = ("costs", "method", "points", "feasible", "lowest_min_speed", "highest_min_speed")
    rows = store.query(
        "SELECT costs, method, COUNT(*), SUM(feasible), MIN(min_speed), MAX(min_speed) "
        "FROM results GROUP BY costs, method ORDER BY MIN(point)"
    )
    return [dict(zip(names, row, strict=True)) for row in rows]


def best(store: Store) -> list[dict[str, Any]]:
    """For each cost table, N and M: the design that the slowest processor will do for, of equals the one with the
    smallest L; with those of its options that the sweep varies.

    `standard` has no delay to bear, and takes part only if it is alone.
    """
    names = (*BEST, *_varied(store))
    rows = store.query(
        f"SELECT {', '.join(names)} FROM (SELECT *, ROW_NUMBER() OVER "
        "(PARTITION BY costs, N, M ORDER BY min_speed, L, point) AS place FROM results "
        "WHERE method != 'standard' OR NOT EXISTS (SELECT 1 FROM blocks WHERE method != 'standard')) "
        "WHERE place = 1 ORDER BY point"
    )
    found = [dict(zip(names, row, strict=True)) for row in rows]
    return sorted(found, key=lambda row: (row["costs"], row["N"], row["M"]))


def _varied(store: Store) -> Sequence[str]:
    """The options with more than one value in this sweep."""
    options = [column.name for column in BLOCK_COLUMNS[2:]]
    counts = store.query(f"SELECT {', '.join(f'COUNT(DISTINCT {name})' for name in options)} FROM blocks")[0]
    return [name for name, count in zip(options, counts, strict=True) if count > 1]
