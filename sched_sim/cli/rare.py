"""`simulate --scenario --rare`: the probability of misses of which a simulation has none."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from sched_sim import shares
from sched_sim.cli.output import print_table
from sched_sim.cli.progress import progress_bar
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from sched_sim.scenario.outcome import Outcome
    from sched_sim.scenario.rare import RareMisses
    from sched_sim.scenario.scenario import Scenario

NOT_RESOLVED = "not resolved"
"""Instead of a probability of 0, which no simulation shows."""


def check_rare(scenario: Scenario) -> None:
    """Raises InputError where no probability follows from the costs."""
    if scenario.harness:
        raise InputError("--rare asks for P(miss); from samples of `measure --filter` none follows: state the costs")


def find_rare(scenario: Scenario, outcome: Outcome) -> dict[str, RareMisses]:
    """Of each kind of job of which none missed its deadline."""
    from sched_sim.scenario.rare import rare_misses

    found = {}
    for kind, figures in outcome.jobs.items():
        if figures.decided and not figures.misses:
            with progress_bar(f"Splitting for {kind}") as progress:
                found[kind] = rare_misses(scenario, kind, on_progress=progress)
    return found


def probability_words(probability: float | None, interval: tuple[float, float] | None) -> dict[str, str | None]:
    """Of a table. probability: None where no job missed."""
    if probability is not None and interval is not None:
        return {"P(miss)": shares.probability(probability), "95 % interval": shares.interval(*interval)}
    return {
        "P(miss)": NOT_RESOLVED,
        "95 % interval": None if interval is None else f"below {shares.at_most(interval[1])}",
    }


def show_rare(found: Mapping[str, RareMisses]) -> None:
    rows = [
        {
            "job": kind,
            "runs": rare.runs,
            "with a miss": rare.missed,
            **probability_words(rare.probability, rare.interval),
        }
        for kind, rare in found.items()
    ]
    print_table(
        "Misses that one simulation does not show, from independent runs, each split near the deadlines",
        rows,
        "95 % interval: from the spread of the runs, for the costs as stated; not resolved: too few runs with a miss",
    )


def document_of(found: Mapping[str, RareMisses]) -> dict[str, Any]:
    """Of JSON."""
    return {
        kind: {
            "runs": rare.runs,
            "runs_with_a_miss": rare.missed,
            "miss_probability": rare.probability,
            "miss_interval": rare.interval,
        }
        for kind, rare in found.items()
    }


def rare_columns(rare: RareMisses | None) -> dict[str, Any]:
    """Of a row of CSV. rare: None of a kind that was not looked at."""
    probability = None if rare is None else rare.probability
    least, most = (None, None) if rare is None or rare.interval is None else rare.interval
    return {"rare_miss_probability": probability, "rare_miss_least": least, "rare_miss_most": most}
