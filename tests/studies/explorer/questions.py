"""What may be asked of the shipped models: every method, at rates and in steps, with options and parts."""

from __future__ import annotations

from fractions import Fraction
from math import inf

from hypothesis import strategies as st

from sched_sim.design.options import Options
from sched_sim.processors.part import Part
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.explorer.accuracy import accuracy
from studies.explorer.answer import DesignFound
from studies.explorer.given import Given
from studies.explorer.parts import Where, verdicts, where_of
from studies.explorer.planned import planned
from studies.explorer.query import design_of
from studies.explorer.question import question_of
from studies.explorer.resolved import resolved
from studies.explorer.schedule import timeline
from studies.explorer.within import keeping
from studies.selection.conditions import conditions_of
from studies.selection.outputs import outputs_of
from studies.selection.question import Question
from studies.selection.sampling import Sampling

GIVEN = Given()
PARTS: tuple[Part, ...] = tuple(map(load_part, shipped_parts()))
RATE = {"ins-gps": 400, "camera": 200}


def question(
    model: str = "ins-gps",
    *,
    N: int = 80,
    M: int = 44,
    within: float = inf,
    metric: str = "worst",
    hr_hz: int | None = 400,
    options: Options = Options(),
    parts: tuple[Part, ...] = PARTS,
    costs: str = "counted-9-3-3",
) -> Question:
    """By default the design that the explorer starts with."""
    rate = None if hr_hz is None else Fraction(hr_hz)
    loaded = GIVEN.model(model, rate)
    sampling = Sampling.of(None, N, M, rate)
    conditions = conditions_of(loaded, sampling, None)
    where = parts if hr_hz else ()
    table = GIVEN.table(costs)
    return Question(
        loaded, outputs_of(loaded), sampling, within, metric, conditions, (table,), where, options, {}  # type: ignore[arg-type]
    )  # fmt: skip


def where(asked: Question) -> Where | None:
    """The parts of a question, by its own counts."""
    rate = asked.sampling.hr_hz
    if rate is None:
        return None
    return Where(asked.tables[0], tuple(asked.parts), rate, asked.options, asked.statistic, tuple(asked.tasks))


@st.composite
def options(draw: st.DrawFn) -> Options:
    return Options(
        lr_propagate_by=draw(st.sampled_from(["m", "l"])),
        feedback=draw(st.sampled_from(["next-step", "same-step"])),
        gain=draw(st.sampled_from(["at-update", "precomputed"])),
        low_rate_noise=draw(st.sampled_from(["exact", "sum", "euler"])),
        cpus=draw(st.sampled_from([1, 2])),
    )


@st.composite
def questions(draw: st.DrawFn) -> Question:
    """Of short cycles, that are quick to search; several measurements may be on their way."""
    N = draw(st.integers(2, 12))
    M = draw(st.integers(0, N) | st.integers(0, 2 * N))
    model = draw(st.sampled_from(["ins-gps", "camera"]))
    within = draw(st.floats(0.3, 0.5) if model == "ins-gps" else st.floats(0.01, 1.0))
    return question(
        model,
        N=N,
        M=M,
        within=within,
        metric=draw(st.sampled_from(["worst", "rms"])),
        hr_hz=draw(st.sampled_from([None, RATE[model], 20 * RATE[model]])),
        options=draw(options()),
    )


def found_of(query: str, given: Given = GIVEN) -> DesignFound:
    """All that is known of the design of a query."""
    design = design_of(query, given)
    asked = resolved(design, given)
    plan, question = planned(asked, design.method), question_of(asked)
    line = timeline(plan.costs, plan.timing, plan.speed, design.cycles, design.options, asked.tasks, None)
    at, _ = where_of(asked)
    if question is None:
        parts = () if at is None else verdicts(at, plan.method, plan.timing, lambda _: None)
        return DesignFound(asked, plan, line, parts=parts)
    figures = accuracy(question, plan.method, whole=True, last=plan.timing.L)
    kept = {} if design.within is None else keeping(question, asked.methods, plan.method, at)
    parts = () if at is None else verdicts(at, plan.method, plan.timing, figures.at)
    return DesignFound(asked, plan, line, figures, kept, parts)
