"""What a live run came to: for scripts, with units in the names of the keys, and in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from math import floor
from statistics import median
from typing import TYPE_CHECKING, Any

from sched_sim.cli.output import Format, lines, print_csv, print_json, print_table
from sched_sim.shares import percent

if TYPE_CHECKING:
    from studies.live.agreement import Agreement, Word
    from studies.live.measure import Measured


def show_run(run: Measured, core: int, swapped: bool, format: Format) -> None:
    """One run."""
    if format == "json":
        print_json(_about(run, core, swapped) | _figures(run) | _by_cycle(run))
    elif format == "csv":
        print_csv(_cycle_rows(run))
    else:
        title = f"{_title(run, core, swapped)}, speed {float(run.design.speed):.6g}"
        print_table(title, _landed_rows(run), lines(_verdict(run), *_facts(run)))


def show_stairs(runs: Sequence[Measured], word: Word, core: int, swapped: bool, format: Format) -> None:
    """Runs at several speeds, and the word for all."""
    from studies.live.agreement import together
    from studies.live.stairs import far_from_steps
    from studies.live.taken import NEAR

    rows = [_about(run, core, swapped) | _figures(run) for run in runs]
    if format == "json":
        print_json({"verdict": word, "speeds": rows})
    elif format == "csv":
        print_csv([{key: value for key, value in row.items() if key != "wake_us"} for row in rows])
    else:
        near = float(100 * NEAR)
        note = f"{word}, by the speeds {near:g} % or more from a step"
        if far := far_from_steps(runs):
            note += f": {_calm(together(far))} landed as predicted at these {len(far)} together{_alone(far)}"
        print_table(_title(runs[0], core, swapped), [_speed_row(run) for run in runs], lines(note, _ground()))


def _title(run: Measured, core: int, swapped: bool) -> str:
    design = run.design
    priorities = "LR above HR" if swapped else "HR above LR"
    return (
        f"dual-rate, N={design.N} M={design.M}, two SCHED_FIFO threads on CPU {core}, {priorities}, HR period "
        f"{design.period_ns / 1e6:g} ms, {design.cycles} cycles"
    )


def _about(run: Measured, core: int, swapped: bool) -> dict[str, Any]:
    design = run.design
    return {
        "N": design.N,
        "M": design.M,
        "speed": float(design.speed),
        "speed_exact": str(design.speed),
        "period_ms": design.period_ns / 1e6,
        "cycles": design.cycles,
        "cpu": core,
        "swapped_priorities": swapped,
    }


def _figures(run: Measured) -> dict[str, Any]:
    """Shares are of 1; times in us."""
    from studies.live.stairs import nearest_step

    found = run.agreement
    calm = found.share_undisturbed
    return {
        "verdict": found.word,
        "predicted_l": run.predicted,
        "from_step": float(nearest_step(run.design)),
        "agreeing": found.agreeing,
        "share": float(found.share),
        "undisturbed": found.undisturbed,
        "agreeing_undisturbed": found.agreeing_undisturbed,
        "share_undisturbed": None if calm is None else float(calm),
        "taken_share": run.taken_share,
        "wake_us": _spread_us(run.wake),
        "differing_states": run.ran.differing,
    }


def _by_cycle(run: Measured) -> dict[str, Any]:
    taken = [ns / 1e3 for ns in run.taken]
    return {"achieved_l": run.achieved, "disturbed": run.disturbed, "taken_us": taken}


def _cycle_rows(run: Measured) -> list[dict[str, Any]]:
    columns = zip(run.achieved, run.disturbed, run.taken, strict=True)
    return [
        {
            "cycle": cycle,
            "achieved_l": l,
            "predicted_l": run.predicted,
            "agrees": l == run.predicted,
            "disturbed": disturbed,
            "taken_us": taken / 1e3,
        }
        for cycle, (l, disturbed, taken) in enumerate(columns, start=1)
    ]


def _landed_rows(run: Measured) -> list[dict[str, Any]]:
    """The histogram of achieved l."""
    everything = Counter(run.achieved)
    calm = Counter(l for l, disturbed in zip(run.achieved, run.disturbed, strict=True) if not disturbed)
    found = sorted({run.predicted, *(l for l in everything if l is not None)})
    return [
        {
            "l - k": "left out" if l is None else str(l),
            "predicted": "yes" if l == run.predicted else "",
            "cycles": everything[l],
            "of all": _no_more(Fraction(everything[l], len(run.achieved))),
            "undisturbed": calm[l],
            "of these": _no_more(Fraction(calm[l], max(calm.total(), 1))),
        }
        for l in [*found, *([None] if None in everything else [])]
    ]


def _verdict(run: Measured) -> str:
    """Its word first."""
    found = run.agreement
    where = f"landed as predicted, at l = k + {run.predicted}"
    everything = f"of all {found.cycles} cycles {found.agreeing} ({_no_more(found.share)})"
    return f"{found.word}: {_calm(found)} {where}; {everything}{_lacking(found)}"


def _calm(found: Agreement) -> str:
    share = found.share_undisturbed
    how_many = "" if share is None else f" ({_no_more(share)})"
    return f"{found.agreeing_undisturbed} of {found.undisturbed} undisturbed cycles{how_many}"


def _alone(far: Sequence[Agreement]) -> str:
    """Speeds that decide the word by themselves, or else what all of them together lack."""
    from studies.live.agreement import ENOUGH, together

    if wrong := sum(of.word == "disagrees" for of in far):
        return f"; by its own cycles {wrong} disagrees" if wrong == 1 else f"; by their own cycles {wrong} disagree"
    if spoilt := sum(of.too_disturbed for of in far):
        return f"; at {spoilt} of them fewer than {float(100 * ENOUGH):g} % of the cycles were undisturbed"
    return _lacking(together(far))


def _lacking(found: Agreement) -> str:
    """What there would have to be for a verdict, where there is none."""
    from studies.live.agreement import ALIKE, CONFIDENCE, ENOUGH, would_do

    if found.word != "inconclusive":
        return ""
    if found.too_disturbed:
        least = f"{float(100 * ENOUGH):g} %"
        return f"; only {found.undisturbed} of {found.cycles} cycles were undisturbed, and {least} must be"
    return (
        f"; too few to say with {float(100 * CONFIDENCE):g} % confidence whether at least {float(100 * ALIKE):g} % do: "
        f"with {found.elsewhere} elsewhere {would_do(found.elsewhere)} undisturbed cycles would do"
    )


def _facts(run: Measured) -> list[str]:
    from studies.live.stairs import nearest_step
    from studies.live.taken import NEAR

    distance = nearest_step(run.design)
    near = (
        f"the speed is {float(100 * distance):.3g} % above a step of the staircase: there a cycle from which little is "
        f"taken lands a step later"
        if 0 <= distance < NEAR
        else ""
    )
    wake, taken = _spread_us(run.wake), _spread_us(run.taken)
    states = (
        "states: to the bit those of one thread that does the same steps"
        if not run.ran.differing
        else f"WRONG: {run.ran.differing} states are not those of one thread that does the same steps"
    )
    return [
        near,
        f"wake-up latency of HR, us: {_words(wake)}; taken from a cycle, us: {_words(taken)}; "
        f"{percent(run.taken_share)} of all time",
        _ground(run),
        states,
    ]


def _ground(*runs: Measured) -> str:
    """Of one run with what that is in us."""
    from studies.live.taken import NEAR, may_be_taken

    most_us = [float(may_be_taken(run.design, run.predicted)) / 1e3 for run in runs]
    most = "".join(f", {us:,.0f} us," for us in most_us)
    return (
        f"disturbed: something else took more than {float(100 * NEAR):g} % of the speed make up from m to l{most} "
        f"while a job was ready"
    )


def _spread_us(times_ns: Sequence[int]) -> dict[str, float]:
    ordered = sorted(times_ns)
    within = ordered[-(-99 * len(ordered) // 100) - 1]
    return {"median": median(ordered) / 1e3, "p99": within / 1e3, "worst": ordered[-1] / 1e3}


def _words(spread: dict[str, float]) -> str:
    return f"median {spread['median']:,.0f}, 99 % within {spread['p99']:,.0f}, worst {spread['worst']:,.0f}"


def _speed_row(run: Measured) -> dict[str, Any]:
    from studies.live.stairs import nearest_step
    from studies.live.taken import NEAR

    distance = nearest_step(run.design)
    found: Agreement = run.agreement
    most = Counter(run.achieved).most_common(1)[0][0]
    calm = found.share_undisturbed
    return {
        "speed": f"{float(run.design.speed):.4f}",
        "from a step": f"{float(100 * distance):+.1f} %",
        "predicted": run.predicted,
        "measured": "left out" if most is None else most,
        "of undisturbed": None if calm is None else _no_more(calm),
        "of all": _no_more(found.share),
        "undisturbed": _no_more(Fraction(found.undisturbed, found.cycles)),
        "verdict": _word(found) if abs(distance) >= NEAR else "near a step",
    }


def _word(found: Agreement) -> str:
    """With why it is none."""
    if found.word != "inconclusive":
        return found.word
    return "inconclusive: disturbed" if found.too_disturbed else "inconclusive: few"


def _no_more(share: Fraction) -> str:
    """Rounded down: 100.0% is all."""
    return f"{floor(1000 * share) / 10:.1f}%"
