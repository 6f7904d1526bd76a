"""`sched-sim measure --filter`: what each part of the user's own composed filter takes, sample by sample."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import typer

from sched_sim.cli.measured_note import busy_note, busy_row, say_busy
from sched_sim.cli.options import given_options
from sched_sim.cli.output import Format, lines, print_csv, print_json, print_table, say
from sched_sim.cli.outputs import module_files, refuse_one_file_for_two
from sched_sim.cli.own_note import parts_note
from sched_sim.cli.progress import progress_bar
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from sched_sim.costs.sample_file import SampledCosts
    from sched_sim.scenario.scenario import Samples

SIZES = ("states", "inputs", "measurements")
OF_A_SYSTEM = (*SIZES, "system", "method", "update", "sparse", "confirm_probed")
"""Options of `measure` that say what a system's filters are; a robust and a composed filter are what they are."""


def refuse_with_filter(name: str, context: typer.Context) -> None:
    """Raises InputError for options that were given beside --filter and have no meaning with it."""
    options = given_options(context, lambda name: name in (*OF_A_SYSTEM, "robust", "parallel"))
    if options:
        raise InputError(
            f"--filter {name}: leave out {', '.join(options)}: the filter that it returns says all of that itself"
        )


def measure_own_filter(
    name: str,
    backend: Literal["compiled", "counted", "numpy", "c", "emulated"],
    thorough: bool,
    output: Path | None,
    format: Format,
) -> None:
    """Measure, print, and write the file of samples."""
    from studies.measurement.samples import measure_filter
    from studies.measurement.user_filter import load_filter
    from studies.measurement.user_function import explained

    if backend not in ("compiled", "counted"):
        raise InputError(f"--backend {backend} does not go with --filter {name}: give --backend compiled or counted")
    with progress_bar("Measuring") as progress:
        user = load_filter(name)
        refuse_one_file_for_two([("--output", output)], [("--filter", file) for file in module_files()])
        table = f"{backend}-{name.replace(':', '.')}"
        with explained(f"--filter {name!r}: its parts cannot be measured by --backend {backend}"):
            costs = measure_filter(user, backend, name=table, thorough=thorough, progress=progress)
    rows = [_row(costs, part) | busy_row(costs.provenance) for part in costs.samples]
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(rows)
    else:
        timed = costs.unit == "second"
        shown = [_timed(row) if timed else {key: row[key] for key in ("job", *KINDS, "operations")} for row in rows]
        print_table(f"{table}, in {'ns' if timed else 'operations'}", shown, _note(costs) if timed else "")
    if format != "table":
        say_busy(table, costs.provenance)
    if output is not None:
        from sched_sim.costs.sample_file import write_sampled_costs

        write_sampled_costs(costs, output)
        say(f"Wrote {output}; name it as `costs` in a scenario: sched-sim simulate --scenario FILE")


Number = TypeVar("Number", float, Fraction)

KINDS = ("multiply", "add", "divide", "sqrt", "function")


def _row(costs: SampledCosts, part: str) -> dict[str, Any]:
    """In the unit of the table."""
    values = sorted(map(float, costs.samples[part]))
    row = {"job": part, "unit": costs.unit}
    if costs.operations:
        counts = costs.operations[part]
        return {**row, "operations": int(values[0]), **{kind: counts.get(kind, 0) for kind in KINDS}}
    median, p95 = _median_and_p95(values)
    return {**row, "samples": len(values), "minimum": values[0], "median": median, "p95": p95, "maximum": values[-1]}


def _timed(row: dict[str, Any]) -> dict[str, str]:
    return {"job": row["job"]} | {key: f"{1e9 * row[key]:.0f}" for key in ("minimum", "median", "p95", "maximum")}


NOISY = 3
"""A part is noisy where its p95 is more than so many times its median."""


def _note(costs: SampledCosts) -> str:
    repetitions = costs.provenance["protocol"]["repetitions"]
    return lines(
        str(costs.provenance["source"]),
        what_a_sample_means(repetitions),
        *noise(costs.samples),
        parts_note(costs.provenance),
        busy_note(costs.provenance),
    )


def what_a_sample_means(repetitions: int) -> str:
    return (
        f"Most of a sample is the loop that takes it, not the job, and a mean of {repetitions} executions hides single "
        f"slow ones: no probability of a miss follows from these samples, and `simulate --scenario` gives none"
    )


def noise(samples: Samples) -> list[str]:
    """A line, if something else had the machine while these parts were timed."""
    spread = {part: _median_and_p95(times) for part, times in samples.items() if len(times) > 1}
    loud = [
        f"p95 of {part} is {float(p95 / median):.1f} times its median"
        for part, (median, p95) in spread.items()
        if p95 > NOISY * median
    ]
    return [f"noisy: {', '.join(loud)}; repeat on an idle machine"] if loud else []


def _median_and_p95(values: Sequence[Number]) -> tuple[Number, Number]:
    from statistics import median, quantiles

    return median(values), quantiles(values, n=20)[-1]
