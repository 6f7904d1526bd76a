"""What a sweep found, in a few rows: how the methods compare, and the best of them for each N and M."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sched_sim.costs.methods import CAVEATS
from studies.sweep.store import Store
from studies.sweep.store_layout import BLOCK_COLUMNS

BEST = ("costs", "N", "M", "method", "L", "min_speed", "min_speed_exact", "binding")

APART = ("standard", *CAVEATS)
"""Methods that have no delay to bear, or whose estimate is not the one that the measurements allow."""


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
    smallest L; with those of its options that the sweep varies. Where costs are in seconds, `highest_hr_hz` is the HR
    rate up to which its processor will do.

    Those `APART` take part only if there are no others.
    """
    apart = f"({', '.join(map(repr, APART))})"
    names = (*BEST, *_told(store))
    rows = store.query(
        f"SELECT {', '.join(names)} FROM (SELECT *, ROW_NUMBER() OVER "
        "(PARTITION BY costs, N, M ORDER BY min_speed, L, point) AS place, "
        "CASE WHEN hr_hz IS NOT NULL THEN 1 / min_speed END AS highest_hr_hz FROM results "
        f"WHERE method NOT IN {apart} OR NOT EXISTS (SELECT 1 FROM blocks WHERE method NOT IN {apart})) "
        "WHERE place = 1 ORDER BY point"
    )
    designs = [dict(zip(names, row, strict=True)) for row in rows]
    return sorted(designs, key=lambda row: (row["costs"], row["N"], row["M"]))


def _told(store: Store) -> Sequence[str]:
    """What else there is to tell: processors and rates if there are any, and options of more than one value."""
    options = [column.name for column in BLOCK_COLUMNS if column.name not in ("costs", "processor", "method")]
    seen = ["MAX(processor IS NOT NULL)", "(SELECT hr_hz IS NOT NULL FROM rows LIMIT 1)"]
    counts = [f"COUNT(DISTINCT {name}) > 1" for name in options]
    (told,) = store.query(f"SELECT {', '.join([*seen, *counts])} FROM blocks")
    return [name for name, wanted in zip(["processor", "highest_hr_hz", *options], told, strict=True) if wanted]
