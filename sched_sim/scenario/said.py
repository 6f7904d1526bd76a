"""What is said of a scenario's figures, wherever they are shown."""

from __future__ import annotations

from sched_sim.scenario.scenario import Scenario

WITHHELD = (
    "no P(miss): these samples are of an earlier `measure --filter`, for the most part the loop that took them, and a "
    "mean of several executions hides the slow ones; for a probability measure again: each sample is then one execution"
)
INTERVAL = "95 % interval: noise of this simulation only, for the costs as stated, as if each job missed on its own"


def phases_note(scenario: Scenario) -> str:
    """Of tasks whose phase may be any, of which a simulation shows one; empty if there are none."""
    free = ", ".join(task.name for task in scenario.tasks if task.offset == "any")
    return free and f"{free}: of any phase, and here first released with step 0 (offset = ... for another)"
