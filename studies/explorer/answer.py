"""One sentence that a person reads first: whether the design does, what it takes, and what would do if it does not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import ceil, isfinite
from typing import Literal

from sched_sim.errors import option
from sched_sim.rounding import no_less, percent_up
from sched_sim.schedule.intervals import TASK
from studies.explorer.accuracy import Accuracy
from studies.explorer.methods import binding_words
from studies.explorer.planned import Planned
from studies.explorer.query import number_text
from studies.explorer.resolved import Resolved
from studies.explorer.schedule import Timeline
from studies.explorer.words import bound, figure, lands, listed, named, needs, place, within
from studies.selection.choice import Candidate
from studies.selection.methods import METHODS
from studies.selection.parts import OnPart

State = Literal["holds", "misses", "inaccurate", "unknown"]
Kept = Mapping[str, Candidate]
"""What each method needs to keep the accuracy, by `within.keeping`; empty where none was asked for."""

JOBS = {
    "hr": "the HR job",
    "hr_update": "the HR update",
    "lr_propagate": "LR propagate",
    "lr_gain": "the gain",
    "lr_update": "the LR update",
}
"""By kind."""


MANY = 10
"""Times from which on a need is not told in percent more."""


@dataclass(frozen=True, slots=True)
class Answer:
    """state: whether deadlines and accuracy hold, a deadline is missed, the output is too inaccurate, or its accuracy
    is not known."""

    sentence: str
    state: State


@dataclass(frozen=True, slots=True)
class DesignFound:
    """What is known of a design. plan: of its method; figures: its accuracy by landing, None without a model; kept: of
    each method; parts: verdicts on the design, by cost."""

    asked: Resolved
    plan: Planned
    timeline: Timeline
    figures: Accuracy | None = None
    kept: Kept = field(default_factory=dict)
    parts: Sequence[OnPart] = ()


def answer(found: DesignFound) -> Answer:
    """Of one design."""
    if not found.plan.fits:
        return Answer(_misses(found), "misses")
    if (allowed := within(found.asked)) is None:
        return Answer(_runs(found), "holds")
    std = None if found.figures is None else found.figures.at(found.plan.landed)
    if std is None:
        return Answer(_not_known(found), "unknown")
    if std <= allowed:
        return Answer(_keeps(found), "holds")
    return Answer(_inaccurate(found, std), "inaccurate")


def _runs(found: DesignFound) -> str:
    asked, plan = found.asked, found.plan
    std = None if found.figures is None else found.figures.at(plan.landed)
    then = ""
    if std is not None and asked.outputs is not None:
        kind = "worst" if asked.design.metric == "worst" else "rms"
        then = f", where the {kind} standard deviation of {asked.outputs.name} is {figure(asked, std)}"
    landed = f"{_landing(found, plan.timing.L)}{then}"
    if asked.pace is None:
        return f"{_subject(found)} needs {needs(asked, plan.least.speed)}: {landed}{_cheapest(found)}"
    return f"{_subject(found)} meets every deadline: {landed}{_takes(found)}"


def _keeps(found: DesignFound) -> str:
    asked, plan = found.asked, found.plan
    kept = found.kept.get(plan.method)
    allowed = plan.timing.L if kept is None or kept.L is None else min(plan.timing.L, kept.L)
    keeps = f"{_subject(found)} keeps {bound(asked)}"
    if asked.pace is None:
        least = f"at its least speed, {needs(asked, plan.least.speed)}"
        return f"{keeps}: {least}, {_landing(found, allowed)}{_cheapest(found)}"
    return f"{keeps}: {_landing(found, allowed)}{_takes(found)}"


def _misses(found: DesignFound) -> str:
    asked, plan = found.asked, found.plan
    late = _first_late(found.timeline)
    first = f": {late} is late first" if late else f", later than is shown: {binding_words(plan.least.binding)}"
    start = f"{_subject(found)} misses deadlines{first}"
    if plan.least.speed <= plan.speed:
        return f"{start}; {needs(asked, plan.least.speed)} would do, for then it lands in another step"
    times = plan.least.speed / plan.speed
    more = f"{no_less(100 * (times - 1), 3)} % more" if times < MANY else f"{ceil(times):,} times as much"
    needed = f"it needs {needs(asked, plan.least.speed)}"
    if asked.machine_pace is None or asked.design.speed is not None:
        needed += f", {more}"
    return f"{start}, and {needed}{_on_it(found)}{_cheapest(found)}"


def _on_it(found: DesignFound) -> str:
    """The methods that keep the accuracy on the same machine."""
    pace, kept = found.asked.machine_pace, found.kept
    if pace is None or found.asked.design.speed is not None:
        return ""
    does = sorted(
        (of.least.speed, method)
        for method, of in kept.items()
        if method != "standard" and of.least is not None and of.least.speed <= pace
    )
    return f"; on it {listed([method for _, method in does])} would do" if does else ""


def _inaccurate(found: DesignFound, std: float) -> str:
    asked, plan, kept = found.asked, found.plan, found.kept.get(found.plan.method)
    assert asked.outputs is not None
    assert plan.landed is not None
    if kept is None or kept.allowed is None:
        best = _best(found, std)
        return f"{named(plan.method)} cannot keep {bound(asked)}: {best}; {_others(found)}"
    start = (
        f"{_subject(found)} does not keep {bound(asked)}: its correction lands at {lands(asked, plan.landed)}, where "
        f"it is {figure(asked, std)}"
    )
    if kept.L is None or kept.least is None:
        return f"{start}; it would have to land by {lands(asked, kept.allowed)}"
    by = f"give {option('L')} {kept.L}" if asked.pace is None else f"it must land by {lands(asked, kept.L)}"
    return f"{start}; {by}, for which it needs {needs(asked, kept.least.speed)}"


def _best(found: DesignFound, std: float) -> str:
    kept = found.kept.get(found.plan.method)
    best, first = (std, found.plan.landed) if kept is None else (kept.best, kept.first)
    assert first is not None
    return f"at best it is {figure(found.asked, best)}, landing at {lands(found.asked, first)}"


def _others(found: DesignFound) -> str:
    """Which methods keep the accuracy, or how near they come to it."""
    kept = {method: of for method, of in found.kept.items() if method != "standard"}
    does = sorted((of.least.speed, method) for method, of in kept.items() if of.least is not None)
    if does:
        return f"{listed([method for _, method in does])} can"
    if enough := [method for method, of in kept.items() if of.allowed is not None]:
        return f"{listed(enough)} would be accurate enough"
    known = {method: of.best for method, of in kept.items() if _is_known(method, of)}
    if not known:
        return "no other method is known to"
    best = min(known.values())
    names = listed([method for method, std in known.items() if std == best])
    return (
        f"no method can, the best is {figure(found.asked, best)}, by {names}{_without_delay(found)}: allow more, "
        f"measure more often, or shorten the delay"
    )


def _without_delay(found: DesignFound) -> str:
    reference = found.kept.get("standard")
    if reference is None or not isfinite(reference.best):
        return ""
    return f" (without delay {figure(found.asked, reference.best)})"


def _is_known(method: str, of: Candidate) -> bool:
    return isfinite(of.best) and not METHODS[method].floored


def _not_known(found: DesignFound) -> str:
    """The schedule holds."""
    asked, figures = found.asked, found.figures
    reason = "its correction does not land" if figures is None or figures.curve is not None else figures.reason
    if figures is not None and figures.curve is not None and found.plan.landed is not None:
        reason = "its error grows without bound"
    return f"whether {_subject(found)} keeps {bound(asked)} is not known: {reason}"


def _subject(found: DesignFound) -> str:
    """The method, and what it runs on."""
    asked = found.asked
    if asked.design.speed is not None:
        return f"{named(found.plan.method)} at speed {number_text(found.plan.speed)}"
    on = place(asked)
    return f"{named(found.plan.method)} on {on}" if on else named(found.plan.method)


def _landing(found: DesignFound, allowed: int) -> str:
    plan = found.plan
    if plan.landed is None:
        return "its correction does not land"
    if METHODS[plan.method].landing == "at once":
        return "it corrects the step of the measurement itself"
    of = "" if METHODS[plan.method].landing != "later" else f" of the {allowed} allowed"
    if of and plan.landed == allowed:
        of = ", as late as is allowed"
    return f"its correction lands at {lands(found.asked, plan.landed)}{of}"


def _takes(found: DesignFound) -> str:
    asked, plan = found.asked, found.plan
    if asked.design.speed is not None or asked.pace is None:
        return f", and it needs {needs(asked, plan.least.speed)}"
    return f", and it takes {percent_up(plan.least.speed / asked.pace)} of the {'part' if asked.part else 'machine'}"


def _cheapest(found: DesignFound) -> str:
    """The first part that runs the design, and is accurate enough if that was asked for."""
    allowed = within(found.asked)
    for on in found.parts:
        enough = allowed is None or (on.std is not None and on.std <= allowed)
        if on.part is not None and on.for_sale and on.fits and on.needed is not None and enough:
            return f"; {on.name} would do: {percent_up(on.needed)} of it is needed"
    return ""


def _first_late(timeline: Timeline) -> str:
    """The job whose missed deadline is the first, with its step; empty if none is shown."""
    jobs = timeline.jobs
    late = [
        (deadline, at) for at, (deadline, missed) in enumerate(zip(jobs.deadline, jobs.missed, strict=True)) if missed
    ]
    if not late:
        return ""
    _, at = min(late)
    kind, step = jobs.kind[at], jobs.step[at]
    if kind.startswith(TASK):
        return f"task {kind.removeprefix(TASK)}"
    job = JOBS.get(kind, kind.replace("_", " "))
    return f"{job} of step {step}" if kind == "hr" else f"{job} of the measurement of step {step}"
