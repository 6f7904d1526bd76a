"""`sched-sim measure` of a user's own model: how much of each job is spent in its functions, and why so much."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sched_sim.cli.output import lines
from sched_sim.costs.table import CostTable

LARGE = 0.25
"""A share of a job from which on it pays to look at the functions."""

MEANING = (
    "own, %: of the job's time, in the system's own f, F, Q, h, H and R; it was timed without them in the same rounds"
)


def own_share(table: CostTable, method: str, kind: str) -> dict[str, float]:
    """For scripts, where `table` says it: what share of the job's time is spent in the functions of the system."""
    shares = table.provenance.get("own_share")
    return {} if shares is None else {"own_share": shares[method][kind]}


def own_note(table: CostTable) -> str:
    """For people, lines below a table: what the share is of, and which functions make it large by asking for memory;
    empty where there is nothing to say."""
    shares = table.provenance.get("own_share")
    if shares is None:
        return ""
    large = any(share >= LARGE for kinds in shares.values() for share in kinds.values())
    return lines(MEANING, _allocating(table) if large else "")


def parts_note(provenance: Mapping[str, Any]) -> str:
    """For people, a line below the parts of a composed filter, if functions of the user's in them make new arrays."""
    new = [f"{number} in {part}" for part, number in provenance.get("allocations", {}).items() if number]
    if not new:
        return ""
    return (
        f"your functions make new arrays, {', '.join(new)} each time, which slows all of it down: write into out "
        "number by number"
    )


def _allocating(table: CostTable) -> str:
    new = {name: one for name, one in table.provenance["own_functions"].items() if one["allocations"]}
    if not new:
        return ""
    named = ", ".join(f"{name} ({1e9 * one['seconds']:.0f} ns alone)" for name, one in new.items())
    return (
        f"{named}: a new array in each call, which slows all of the job down: keep it in `parameters` and\n"
        "return it, or fill memory in their field scratch, of F and Q two in turn; see docs/howto/own-model.md"
    )
