"""The exact probability of a miss beside that of a simulated scenario, where its structure allows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sched_sim.errors import InputError

if TYPE_CHECKING:
    from sched_sim.scenario.scenario import Scenario
    from studies.probability.beside_sampled import Beside


def find_exact(scenario: Scenario) -> Beside | str:
    """Or why there is none, in words."""
    from studies.probability.beside_sampled import beside_sampled

    if scenario.harness or len(scenario.sensors) > 1:
        return ""
    try:
        found = beside_sampled(scenario)
    except InputError as error:
        return str(error)
    return found if found.misses else found.why


def exact_note(found: Beside | str) -> str:
    """A line below the table; empty for several sensors, of which there is none."""
    from sched_sim.probability.words import chance

    if isinstance(found, str):
        return found and f"P(miss) is not had exactly: {found}"
    misses = ", ".join(f"{kind} {chance(exact.bounds, exact.floor)}" for kind, exact in found.misses.items())
    why = f"; {found.why}" if found.why else ""
    return (
        f"P(miss) exactly, for the costs as stated, each draw independent, mean of the first {found.cycles:,} cycles: "
        f"{misses}{why}"
    )


def exact_document(found: Beside | str) -> dict[str, Any]:
    """For scripts."""
    from sched_sim.cli.probability_shown import bounds_document

    if isinstance(found, str):
        return {"exact": None, "why_not_exact": found or "there are several sensors, and a design has one"}
    misses = {kind: bounds_document(exact.bounds, exact.floor) for kind, exact in found.misses.items()}
    return {"exact": {"cycles": found.cycles, "miss_probability": misses}, "why_not_exact": found.why or None}
