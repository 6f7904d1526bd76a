"""Linear systems in the report: their tables, the first row of each its heading, and what is said of them."""

from __future__ import annotations

from typing import Any

from reports.erkf.results import Results
from reports.erkf.tables import Rows
from reports.pages.machine import marked
from reports.pages.numbers import significant
from studies.robust.linear import KALMAN
from studies.robust.precise import DIGITS

MARKED = "\N{NO-BREAK SPACE}†"
FINITE, LIMIT = "robust, μ = 1", "robust, μ = ∞"


def linear_said(results: Results) -> dict[str, Any]:
    """Stability and convergence, of two systems and of random ones."""
    found = {(record["system"], record["filter"]): record for record in results.records("linear")}
    samples = results.records("linear-sample")
    robust = [record for (_, name), record in found.items() if name != KALMAN]
    tried, kept = (sum(int(record[name]) for record in samples) for name in ("systems", "kept"))
    systems = min(int(record["systems"]) for record in samples)
    stopped = [record for record in samples if int(record["stopped"])]
    return {
        "radius": max(float(record["radius"]) for record in robust),
        "steps": max(int(record["steps"]) for record in robust),
        "tried": f"{tried:,}",
        "kept": "all" if kept == tried else f"{kept:,}",
        "at_most": f"{100 * (1 - 0.05 ** (1 / systems)):.1f}",
        "digits": DIGITS,
        "stopped": " and ".join(f"{record['stopped']}{MARKED} of {int(record['systems']):,}" for record in stopped),
        "kalman": found["growing", KALMAN]["error_200"],
        "finite": f"{float(found['growing', FINITE]['error_200']):,.0f}",
        "limit": f"{float(found['growing', LIMIT]['error_200']):,.0f}",
        "decaying": {
            of: found["decaying", name] for of, name in (("kalman", KALMAN), ("finite", FINITE), ("limit", LIMIT))
        },
    }


def linear_rows(results: Results) -> Rows:
    """Of each filter on a linear system what makes it stable, and its error where the model is right, and wrong."""
    errors = {"error_50": "error, step 50", "error_200": "error, step 200", "wrong": "F wrong"}
    rows: Rows = [["System", "Filter", "radius of F", "radius of the filter", "steps to one P", *errors.values()]]
    for record in results.records("linear"):
        head = [record[name] for name in ("system", "filter", "of_system", "radius", "steps")]
        rows.append([*head, *(_size(float(record[name])) for name in errors)])
    return rows


def _size(error: float) -> str:
    return significant(error) if error < 1e6 else f"{error:.0e}"


def sample_rows(results: Results) -> Rows:
    named = {"systems": "tried", "kept": "stable and convergent", "steps": "steps to one P, at most"}
    stopped = marked("stopped by rounding")
    rows: Rows = [["Random systems", *named.values(), "largest radius", stopped]]
    for record in results.records("linear-sample"):
        numbers = [f"{int(record[name]):,}" for name in named]
        rows.append([record["name"], *numbers, record["radius"], f"{int(record['stopped']):,}"])
    return rows
