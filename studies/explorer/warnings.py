"""What a designer should be told of a design, each with what would mend it."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from filters.accuracy.pattern import repeats_soon
from sched_sim.costs.methods import CAVEATS
from sched_sim.costs.table import COUNTED, PAPERS, busy_note
from sched_sim.design.least_speed import has_closed_form
from sched_sim.design.less_work import enough_for_less, holds_for_less
from sched_sim.design.methods import method_of
from sched_sim.errors import option
from sched_sim.processors.part import ranged
from sched_sim.rounding import down, percent_up
from studies.explorer.answer import DesignFound
from studies.explorer.words import needs, place
from studies.selection.remarks import BOUND

LITTLE = Fraction(1, 20)
"""A share of a processor that is little to have left."""


def warnings(found: DesignFound) -> tuple[str, ...]:
    """One line each, most telling first."""
    return (
        *_lands_earlier(found),
        *_needs_no_later(found),
        *_to_spare(found),
        *_calibrated(found),
        *_less_work(found),
        *_by_design(found),
        *_assumed_costs(found),
        *_other_size(found),
        *_measured(found),
        *_bounded(found),
    )


def _lands_earlier(found: DesignFound) -> Iterator[str]:
    plan = found.plan
    if plan.fits and plan.landed is not None and _chooses(found) and plan.landed < plan.timing.L:
        same = f": L = {plan.landed} needs the same processor"
        if found.asked.pace is not None:
            same = f": this processor keeps L = {plan.landed} as well"
        if _by_deadline(found):
            same = ""
        yield f"lands at {plan.landed} of the {plan.timing.L} you allow{same}"


def _needs_no_later(found: DesignFound) -> Iterator[str]:
    """A later L than is of any use."""
    timing = found.plan.timing
    law = method_of(found.plan.costs).law(found.asked.design.options.feedback)
    last = law.last_of_use(timing.N, timing.M)
    if _chooses(found) and last < timing.L and law.several and not _by_deadline(found):
        yield f"L = {timing.L} needs what L = {last} does: no later one needs less"


def _by_deadline(found: DesignFound) -> bool:
    """Whether another L changes what runs when."""
    return found.asked.design.options.policy == "edf"


def _chooses(found: DesignFound) -> bool:
    """Whether the method has a choice of where it lands."""
    return not method_of(found.plan.costs).law(found.asked.design.options.feedback).only_first


def _to_spare(found: DesignFound) -> Iterator[str]:
    plan, asked = found.plan, found.asked
    if asked.pace is None or not plan.fits:
        return
    left = 1 - plan.least.speed / plan.speed
    if left == 0:
        yield "nothing is to spare: what takes longer than its cost is late; take a faster processor"
    elif 0 < left < LITTLE:
        of = f" of {place(asked)}" if place(asked) else ""
        yield f"only {down(100 * left, 2)} %{of} is to spare: what takes that much longer is late; take a faster one"


def _calibrated(found: DesignFound) -> Iterator[str]:
    """Where a verdict by counts hangs on how near counts come to the part."""
    asked, plan, part = found.asked, found.plan, found.asked.part
    if part is None or asked.machine_pace is None:
        return
    needed, known = plan.least.speed / asked.machine_pace, ranged(asked.counts, part).calibration
    time_it = "time the jobs there, with the C that `sched-sim code` writes"
    if known is None:
        yield f"what {part.name} takes over what is counted was never measured: {time_it}"
    elif plan.fits and needed * known.most > 1:
        most = percent_up(needed * known.most)
        yield f"fits by counts, but {part.name} took {known.text} of them, and may need {most} of its speed: {time_it}"
    elif not plan.fits and needed * known.least <= 1 < needed:
        least = percent_up(needed * known.least)
        yield f"too slow by counts, but {part.name} took {known.text} of them, and may need only {least}: {time_it}"


def _less_work(found: DesignFound) -> Iterator[str]:
    """Where executions that take less than their costs may be late; only where that takes no simulation to know."""
    asked, plan, options = found.asked, found.plan, found.asked.design.options
    if not plan.fits or not has_closed_form(options, asked.tasks, plan.costs, plan.timing):
        return
    if holds_for_less(plan.costs, plan.timing, plan.speed, options, asked.tasks):
        return
    enough = enough_for_less(plan.costs, plan.timing, options, asked.tasks, plan.least.speed)
    none = "`sched-sim simulate --less-work` looks for such" if enough is None else f"at {needs(asked, enough)} none is"
    yield f"work that takes less than its cost may land in another step and be late: {none}"


def _by_design(found: DesignFound) -> Iterator[str]:
    if found.plan.method in CAVEATS:
        yield f"{CAVEATS[found.plan.method]}: clone lands as early, and is exact"


def _assumed_costs(found: DesignFound) -> Iterator[str]:
    """Of a filter that nobody named."""
    asked = found.asked
    if asked.design.costs is None and asked.design.model is None:
        of = {
            PAPERS: "those that S. Steffes printed, in steps of the standard filter",
            COUNTED: "of 9 states, 3 inputs and 3 measurements",
        }
        yield f"costs are {of[asked.counts.name]}: give a {option('model')}, or {option('costs')} of your own"


def _other_size(found: DesignFound) -> Iterator[str]:
    """Costs of a filter that is not the model's."""
    asked, said = found.asked, found.asked.counts.provenance
    if asked.model is None or not {"states", "measurements"} <= {*said}:
        return
    states, _, measurements = asked.model.sizes
    if (said["states"], said["measurements"]) != (states, measurements):
        yield (
            f"costs are of {said['states']} states and {said['measurements']} measurements, {asked.model.name} has "
            f"{states} and {measurements}: leave {option('costs')} out, and its own operations are counted"
        )


def _measured(found: DesignFound) -> Iterator[str]:
    asked, statistic = found.asked, found.asked.design.statistic
    if busy := busy_note(asked.counts.provenance):
        yield busy
    costs = asked.table.costs.get(found.plan.method, {}).values()
    spread = any(cost.minimum != cost.p95 for cost in costs)
    if spread and statistic == "minimum":
        yield f"costs are the least that was measured: {option('statistic')} p95 plans with what 95 % take at most"
    if costs and not spread and statistic != "minimum":
        yield f"{option('statistic')} {statistic} changes nothing: each cost is one figure, counted or stated"


def _bounded(found: DesignFound) -> Iterator[str]:
    if found.figures is not None and not repeats_soon(found.asked.sampling.between):
        yield BOUND
