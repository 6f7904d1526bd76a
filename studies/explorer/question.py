"""What is asked of the accuracy of a design, where it has a model."""

from __future__ import annotations

from math import inf

from sched_sim.errors import option
from sched_sim.ticks import positive
from studies.explorer.resolved import Resolved
from studies.selection.conditions import conditions_of
from studies.selection.question import Question


def question_of(asked: Resolved) -> Question | None:
    """With the costs of its schedule, every measurement and its options alone. within: infinite where none is asked
    for."""
    if asked.model is None or asked.outputs is None:
        return None
    within = asked.design.within
    return Question(
        asked.model,
        asked.outputs,
        asked.sampling,
        inf if within is None else float(positive(within, option("within"))),
        asked.design.metric,
        conditions_of(asked.model, asked.sampling, None),
        (asked.table,),
        (),
        asked.design.options,
        {},
        asked.design.statistic,
        asked.tasks,
    )
