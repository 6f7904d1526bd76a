"""State augmentation: the states of the last M steps are estimated beside the present one."""

from __future__ import annotations

from collections.abc import Mapping

from filters.covariance_forms import covariance_form
from filters.delayed.augmentation import new_gains, new_stack, predict_kind, update_kind
from filters.jobs import Job
from studies.board.serial.method import TEXTS, Parts, Serial, add_correction, add_record, as_jobs
from studies.board.wanted import Filter


def _more(wanted: Filter) -> Mapping[str, Job]:
    assert wanted.steps is not None
    M = wanted.steps.M
    jobs = as_jobs(wanted, covariance_form(wanted.update), predict_kind(M), update_kind(M))
    return dict(zip(("predict", "update"), jobs.values(), strict=True))


def _memory(parts: Parts) -> None:
    system, in_c, M = parts.system, parts.in_c, parts.steps.M
    add_record(parts, "stack", new_stack(system, M), in_c.parameter("update", "before"))
    add_record(parts, "spare", new_stack(system, M), in_c.parameter("update", "before"))
    add_record(parts, "gains", new_gains(system, M), in_c.parameter("update", "gains"))
    add_correction(parts, "update")


AUGMENTATION = Serial(
    title="filter whose state is augmented by those of the last M steps",
    behaviour="A late measurement is one of the oldest of them, and corrects them all.",
    jobs=("predict_0", "predict_1", "update_0", "update_1", "update_2"),
    order="after",
    template="augmentation.c",
    texts={
        **TEXTS,
        "stack": "stack_of(filter.now)",
        "m": "filter.j",
        "before": "stack_of(filter.now)",
        "after": "stack_of(1 - filter.now)",
        "gains": "&filter_gains",
    },
    memory=_memory,
    fields="    int now; /* which of the stacks in memory */\n",
    x="filter_stack_x[0]",
    P="filter_stack_P[0][0]",
    now="stack_of(filter.now)->x[filter.j % STATES_IN_STACK]",
    more=_more,
)
