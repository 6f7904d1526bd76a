"""`sched-sim design`: from an accuracy to a filter and a part."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import accuracy_flags as flags
from sched_sim.cli import options as opt
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.output import lines, print_csv, print_json, print_table, say
from sched_sim.cli.processors import Parts
from sched_sim.costs.table import units
from sched_sim.design.options import Options
from sched_sim.errors import InputError, option
from sched_sim.rounding import no_less, percent_up

if TYPE_CHECKING:
    from collections.abc import Sequence

    from studies.selection.choice import Candidate, Choice
    from studies.selection.parts import OnPart
    from studies.selection.question import Question

Within = Annotated[
    str | None,
    typer.Option(
        "--within",
        help="The accuracy that is needed: a standard deviation of the outputs together, in their unit.",
        metavar="NUMBER",
        rich_help_panel=flags.ACCURACY,
    ),
]
CostTables = Annotated[
    list[str] | None,
    typer.Option(
        "--costs",
        help="Cost table, shipped or your own file; repeatable, for other forms of the covariance update. By default "
        "the operations of filters of the model's size are counted, textbook and short.",
        rich_help_panel=opt.DESIGN,
    ),
]
DesignMethods = Annotated[
    list[str] | None,
    typer.Option(
        "--method",
        help="recalculate, larsen, clone, clone-split, carried-gain, augmentation, dual-rate, delayed-horizon, "
        "px4-predictor, fuse-as-fresh, or standard, to which nothing is late; repeatable; by default all that the cost "
        "tables have, but for standard.",
        rich_help_panel=opt.DESIGN,
    ),
]
AllMethods = Annotated[
    bool,
    typer.Option(
        "--all-methods",
        help="Every way that keeps the accuracy, not the best of each method alone.",
        rich_help_panel=opt.OUTPUT,
    ),
]
Figure = Annotated[
    Path | None,
    typer.Option(
        "--figure",
        help="Draw power against accuracy, all methods: FILE.svg, .pdf or .png, for a column of 88 mm.",
        rich_help_panel=opt.OUTPUT,
    ),
]


@with_options
def design(
    context: typer.Context,
    within: Within = None,
    model: flags.AnyModel = None,
    output: flags.Output = None,
    unit: flags.Unit = None,
    N: opt.StepsOrNone = None,
    M: opt.AnyDelay = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    method: DesignMethods = None,
    every: flags.Every = "1:4",
    metric: flags.Metric = "worst",
    motion: flags.Motion = None,
    tau: flags.Tau = "0.25",
    processor: Parts = None,
    costs: CostTables = None,
    statistic: opt.WhichCost = "minimum",
    options: Options = Options(),
    tasks: opt.Tasks = None,
    all_methods: AllMethods = False,
    figure: Figure = None,
    format: opt.Format = "table",
) -> None:
    """Which filter keeps an accuracy, how late its corrections may land for it, and on which part: for each method the
    latest landing, the least speed for that, the part that just does, and what it does better; and why the others do
    not. That no part will do is an answer, as of `minimum` and `processors` (exit code 0, and what would help); that no
    method keeps the accuracy is an error (exit code 2, and the best that there is).

    sched-sim design --within 0.38 --model ins-gps
    sched-sim design --within 0.38 --model ins-gps --processor cortex-m4f --processor rp2040 --all-methods
    sched-sim design --within 0.5 --model mymodule:my_system --output position=0:3 --unit m --hr-hz 400 \
--measurement-hz 5 --delay-ms 110 --figure front.svg
    """
    from studies.selection.choose import check_rate, chosen, parts_for, with_parts, within_of
    from studies.selection.conditions import conditions_of
    from studies.selection.costs import tables_for
    from studies.selection.model import load_model, shipped_defaults
    from studies.selection.outputs import outputs_of
    from studies.selection.question import Question
    from studies.selection.variants import WAYS

    if model is None:
        raise InputError(f"--model is missing: give one of {flags.MODELS}, or package.module:function of your own")
    if within is None:
        raise InputError("--within is missing: give the standard deviation that is allowed, such as --within 0.38")
    bound, numbers = within_of(within), flags.every_of(every)
    flags.refuse_of_others(context, method)
    if figure is not None:
        from reports.drawing.picture import check_picture

        check_picture(figure, "--figure")
    asked = flags.sampled(shipped_defaults(model), N, M, None, hr_hz, measurement_hz, delay_ms)
    rate = asked.sampling.hr_hz
    check_rate(processor, asked.sampling)
    loaded = load_model(model, rate)
    outputs = outputs_of(loaded, output, unit)
    conditions = conditions_of(loaded, asked.sampling, motion, tau)
    tables = tables_for(loaded, costs)
    if tasks is not None and rate is None and all(table.operations for table in tables):
        raise InputError(f"--tasks {tasks} without --hr-hz: give the rate of the HR loop, such as --hr-hz 400")
    parts = parts_for(_listed(processor), tables, asked.sampling)
    given = opt.given_options(context, lambda name: name in WAYS)
    question = Question(
        loaded,
        outputs,
        asked.sampling,
        bound,
        metric,
        conditions,
        tables,
        parts,
        options,
        {name: (getattr(options, name),) if option(name) in given else known for name, known in WAYS.items()},
        statistic,
        opt.make_tasks(tasks, "second" if parts else tables[0].unit, rate),
    )
    found = chosen(question, method, numbers)
    ways = with_parts(question, found.keeping) if all_methods else found.best
    if format == "json":
        print_json(_document(found, ways))
    elif format == "csv":
        print_csv([_flat(of, found) for of in ways])
    else:
        _show(found, ways, question, asked.words)
    if figure is not None:
        _draw(figure, question, found, numbers)


def _listed(named: Sequence[str] | None) -> list[str] | None:
    from sched_sim.cli.processors import listed

    return listed(named) if named else None


def _draw(path: Path, question: Question, found: Choice, every: Sequence[int]) -> None:
    from reports.drawing.picture import save
    from reports.selection.front_figure import front_figure
    from studies.selection.front import front

    save(front_figure(front(question, [of.variant.method for of in (*found.best, *found.others)], every)), path)
    say(f"Wrote {path}")


def _show(found: Choice, ways: Sequence[Candidate], question: Question, words: str) -> None:
    from sched_sim.cli.instructions import cycles_note, target_note
    from sched_sim.cli.less_work import offsets_note
    from sched_sim.processors.ground import calibration_texts, ground
    from studies.selection.methods import by_reason

    unit = found.outputs.unit and f" {found.outputs.unit}"
    title = (
        f"{found.metric} standard deviation of {found.outputs.name} within {found.within:g}{unit}, {found.model.name}, "
        f"{flags.shown(found.sampling)}"
    )
    of_each = {table.structure: table for table in reversed(question.tables)} if question.parts else {}
    machine = any(on.part is None for of in ways for on in of.parts)
    slow = [on for of in ways if of.cheapest is None for on in of.parts]
    too_slow = any(on.part is not None and on.needed is not None for on in slow)
    print_table(
        title,
        [_words(of, found) for of in ways],
        lines(
            *found.remarks,
            *(f"not {words}" for words in by_reason((of.variant.method, of.reason) for of in found.others)),
            *found.left_out,
            f"without delay: {found.no_delay:.6g}{unit}; least speed: {units(found.unit)} per HR period, to land by L"
            + (", beside the tasks" if question.tasks_in_unit else ""),
            "part: the cheapest where prices are known, else the one with the least to spare" if question.parts else "",
            f"{TOO_SLOW}: no part runs it; of its speed is what the nearest would need" if too_slow else "",
            f"fits: the machine of {_names(question)}; of its speed: what the tightest deadline takes of it; load: the "
            "share of time it is busy"
            if machine
            else "",
            *by_reason((of.variant.method, of.reason) for of in ways if of.parts and of.parts[0].needed is None),
            "" if question.parts or machine else _why_no_parts(question),
            offsets_note([of.variant.method for of in ways], question.tasks),
            words,
            f"costs: {_names(question)}",
            *(
                ground(table, [of.variant.method for of in ways], calibration_texts(table, question.parts))
                for table in of_each.values()
            ),
            *(target_note(table) for table in question.tables),
            *(cycles_note(table, part) for table in question.tables[:1] for part in question.parts),
        ),
    )


def _names(question: Question) -> str:
    """Of the cost tables."""
    return ", ".join(table.name for table in question.tables)


def _why_no_parts(question: Question) -> str:
    if question.sampling.hr_hz is None:
        return "no parts: which do depends on the rate of the HR loop; give --hr-hz"
    if (target := question.tables[0].target) is not None:
        return (
            f"no parts: none that ships states the cycles of instructions of {target}; give one that does with "
            f"--processor, as your own file, or leave --costs out, and operations are counted"
        )
    return f"no parts: {question.tables[0].name} has no counted operations; leave --costs out, and they are counted"


def _words(of: Candidate, found: Choice) -> dict[str, Any]:
    from sched_sim.cli.update_form import structure_word

    assert of.least is not None
    row: dict[str, Any] = {
        "method": "standard (no delay)" if of.variant.method == "standard" else of.variant.method,
        **structure_word(of.variant.table),
        "how": of.variant.how or None,
        "every": of.variant.every,
        "land by L": of.L,
        "least speed": no_less(of.least.speed, 5),
    }
    if not of.parts:
        return row | {"lands at L": of.landed, "std": _figure(of.landed_std)}
    on = of.cheapest
    if of.parts[0].part is None:
        return row | {"fits": "no" if on is None else "yes"} | _shares(of.parts[0]) | _landed(on, of, found)
    do = sum(on.fits for on in of.parts)
    if on is None:
        nearest = of.parts[0]
        known = nearest.needed is not None
        return row | {
            "part": f"{TOO_SLOW}: {nearest.name}" if known else "not known",
            **_shares(nearest),
            **_landed(on, of, found),
            "parts that do": f"0 of {len(of.parts)}",
        }
    return row | {
        "part": on.name,
        **_shares(on),
        **_landed(on, of, found),
        "parts that do": f"{do} of {len(of.parts)}",
    }


def _shares(on: OnPart) -> dict[str, Any]:
    return {"of its speed": _percent(on.needed), "load": _percent(on.load)}


def _landed(on: OnPart | None, of: Candidate, found: Choice) -> dict[str, Any]:
    """on: None where it lands on none."""
    landed = None if on is None else on.landed
    return {
        "lands at L": landed,
        "after, ms": _ms(found.sampling.using(of.variant.every).ms(landed)),
        "std": None if on is None else _figure(on.std),
    }


def _ms(value: float | None) -> str | None:
    return None if value is None else f"{value:.6g}"


def _figure(value: float | None) -> str | None:
    return None if value is None else f"{value:.5g}"


def _percent(share: Any) -> str | None:
    return None if share is None else percent_up(share)


TOO_SLOW = "too slow"
"""Before the name of the nearest part, in the table."""


def _document(found: Choice, ways: Sequence[Candidate]) -> dict[str, Any]:
    return {
        "within": found.within,
        "metric": found.metric,
        "model": found.model.name,
        "output": found.outputs.name,
        "unit": found.outputs.unit or None,
        "N": found.sampling.N,
        "M": found.sampling.M,
        "hr_hz": None if found.sampling.hr_hz is None else float(found.sampling.hr_hz),
        "no_delay_std": found.no_delay,
        "cost_unit": found.unit,
        "designs": [_row(of, found) | {"parts": [_on(on, of, found) for on in of.parts]} for of in ways],
        "others": [
            {"method": of.variant.method, "best_std": _finite(of.best), "reason": of.reason} for of in found.others
        ],
        "remarks": [*found.remarks, *found.left_out],
    }


def _finite(value: float) -> float | None:
    return value if value < float("inf") else None


def _row(of: Candidate, found: Choice) -> dict[str, Any]:
    assert of.least is not None
    options = of.variant.options
    return {
        "method": of.variant.method,
        "low_rate_noise": options.low_rate_noise if of.variant.method == "dual-rate" else None,
        "gain": options.gain if of.variant.method == "dual-rate" else None,
        "lr_propagate_by": options.lr_propagate_by if of.variant.method == "dual-rate" else None,
        "feedback": options.feedback if of.variant.method == "dual-rate" else None,
        "update_form": of.variant.table.update_form,
        "structure": of.variant.table.structure,
        "costs": of.variant.table.name,
        "every": of.variant.every,
        "N": of.N,
        "M": found.sampling.M,
        "L": of.L,
        "allowed_L": of.allowed,
        "std": of.std,
        "min_speed": float(of.least.speed),
        "min_speed_exact": str(of.least.speed),
        "binding": of.least.binding,
        "achieved_l_at_min_speed": of.landed,
        "std_at_min_speed": of.landed_std,
        "reason": of.reason or None,
    }


def _on(on: OnPart, of: Candidate, found: Choice) -> dict[str, Any]:
    sampling = found.sampling.using(of.variant.every)
    return {
        "processor": None if on.part is None else on.name,
        "price": None if on.price is None else float(on.price),
        "fits": on.fits if on.needed is not None else None,
        "needed_share": None if on.needed is None else float(on.needed),
        "slack": None if on.slack is None else float(on.slack),
        "load": None if on.load is None else float(on.load),
        "achieved_l": on.landed,
        "correction_ms": sampling.ms(on.landed),
        "std": on.std,
        "reason": on.remark or None,
    }


OF_A_PART = ("processor", "price", "fits", "needed_share", "slack", "load", "achieved_l", "correction_ms")


def _flat(of: Candidate, found: Choice) -> dict[str, Any]:
    """With what its cheapest part makes of it."""
    on = of.cheapest
    figures = dict.fromkeys(OF_A_PART) if on is None else _on(on, of, found)
    part = {name: figures[name] for name in OF_A_PART} | {"std_on_part": None if on is None else on.std}
    do = [other.part.name for other in of.parts if other.part is not None and other.fits]
    return _row(of, found) | part | {"parts_that_do": " ".join(do) or None}
