"""`sched-sim measure --filter`: what each part of the user's own composed filter takes, execution by execution."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from sched_sim.cli.measured_note import busy_row, say_busy
from sched_sim.cli.options import given_options
from sched_sim.cli.output import Format, lines, print_csv, print_json, print_table, say
from sched_sim.cli.outputs import module_files, refuse_one_file_for_two
from sched_sim.cli.own_note import parts_note
from sched_sim.cli.progress import progress_bar
from sched_sim.costs.table import busy_note
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from sched_sim.costs.sample_file import SampledCosts
    from sched_sim.scenario.scenario import Samples
    from studies.measurement.samples import Caches

SIZES = ("states", "inputs", "measurements")
OF_TIMES = ("cold", "sequence")
OF_A_SYSTEM = (*SIZES, "system", "method", "update", "sparse", "confirm_probed")
"""Options of `measure` that say what a system's filters are; a robust and a composed filter are what they are."""

Cold = Annotated[
    bool,
    typer.Option(
        "--cold",
        help="With --filter: other work before each execution, which drives the part out of the caches.",
        rich_help_panel="System",
    ),
]
InSequence = Annotated[
    bool,
    typer.Option(
        "--sequence",
        help="With --filter: parts in the order in which the filter's loop runs them, a sensor's when its measurement "
        "is due, so that caches and branch predictors are as in use.",
        rich_help_panel="System",
    ),
]


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
    cold: bool,
    sequence: bool,
    output: Path | None,
    format: Format,
) -> None:
    """Measure, print, and write the file of samples."""
    from studies.measurement.samples import measure_filter
    from studies.measurement.user_filter import load_filter
    from studies.measurement.user_function import explained

    if backend not in ("compiled", "counted"):
        raise InputError(f"--backend {backend} does not go with --filter {name}: give --backend compiled or counted")
    if cold and sequence:
        raise InputError("--cold, --sequence: give one of them: in a loop caches are as it leaves them")
    if backend == "counted" and (cold or sequence):
        raise InputError(
            f"{'--cold' if cold else '--sequence'}: not with --backend counted: counts are the same always"
        )
    caches: Caches = "cold" if cold else "sequence" if sequence else "warm"
    with progress_bar("Measuring") as progress:
        user = load_filter(name)
        refuse_one_file_for_two([("--output", output)], [("--filter", file) for file in module_files()])
        table = f"{backend}-{name.replace(':', '.')}"
        with explained(f"--filter {name!r}: its parts cannot be measured by --backend {backend}"):
            costs = measure_filter(user, backend, name=table, caches=caches, thorough=thorough, progress=progress)
    rows = [_row(costs, part) | busy_row(costs.provenance) for part in costs.samples]
    if format == "json":
        print_json(rows)
    elif format == "csv":
        print_csv(rows)
    else:
        timed = backend == "compiled"
        shown = [_timed(row) if timed else {key: row[key] for key in ("job", *KINDS, "operations")} for row in rows]
        print_table(f"{table}, in {'ns' if timed else 'operations'}", shown, _note(costs) if timed else "")
    if format != "table":
        say_busy(table, costs.provenance)
    if output is not None:
        from sched_sim.costs.sample_file import write_sampled_costs

        write_sampled_costs(costs, output)
        say(f"Wrote {output}; name it as `costs` in a scenario: sched-sim simulate --scenario FILE")


KINDS = ("multiply", "add", "divide", "sqrt", "function")


def _row(costs: SampledCosts, part: str) -> dict[str, Any]:
    """In the unit of the table."""
    from sched_sim.costs.sample_text import of_each

    values = sorted(of_each(float, costs.samples[part]))
    row = {"job": part, "unit": costs.unit}
    if costs.operations:
        counts = costs.operations[part]
        return {**row, "operations": int(values[0]), **{kind: counts.get(kind, 0) for kind in KINDS}}
    median, p95, p99 = _quantiles(values)
    figures = {"minimum": values[0], "median": median, "p95": p95, "p99": p99, "maximum": values[-1]}
    return {
        **row,
        "samples": len(values),
        **figures,
        "rank_autocorrelation": costs.provenance["autocorrelation"][part],
    }


def _timed(row: dict[str, Any]) -> dict[str, str]:
    figures = {key: f"{row[key]:.0f}" for key in ("minimum", "median", "p95", "p99", "maximum")}
    correlation = {"autocorrelation": f"{row['rank_autocorrelation']:.2f}"}
    return {"job": row["job"], "executions": f"{row['samples']:,}"} | figures | correlation


NOISY = 3
"""A part is noisy where its p95 is more than so many times its median."""


def _note(costs: SampledCosts) -> str:
    return lines(
        str(costs.provenance["source"]),
        what_is_not_seen(costs.samples),
        in_runs(costs.provenance["autocorrelation"]),
        *(noise(costs.samples) if costs.provenance["caches"] == "warm" else ()),
        parts_note(costs.provenance),
        busy_note(costs.provenance),
    )


def what_is_not_seen(samples: Samples) -> str:
    """How often slower executions than the slowest may come: of n independent ones none is with 95 % in 0.05^(1/n)."""
    fewest = min(map(len, samples.values()))
    return (
        f"a slower execution than the slowest may come with a probability of up to {1 - 0.05 ** (1 / fewest):.1e} each "
        f"(95 %, of {fewest:,} independent ones)"
    )


def in_runs(autocorrelation: Mapping[str, float]) -> str:
    """A line, if some parts' executions tell of their next ones."""
    from sched_sim.costs.autocorrelation import DOUBTFUL, doubtful

    parts = [part for part, each in autocorrelation.items() if doubtful(each)]
    if not parts:
        return ""
    return (
        f"rank autocorrelation of one execution and the next above {DOUBTFUL} of {', '.join(parts)}: independence "
        f"doubtful, for slow executions come together, and draws one by one spread them"
    )


def noise(samples: Samples) -> list[str]:
    """A line, if something else had the machine while these parts were timed."""
    from sched_sim.costs.sample_text import of_each

    spread = {part: _quantiles(of_each(float, times)) for part, times in samples.items() if len(times) > 1}
    loud = [
        f"p95 of {part} is {p95 / median:.1f} times its median"
        for part, (median, p95, _) in spread.items()
        if p95 > NOISY * median
    ]
    return [f"noisy: {', '.join(loud)}; repeat on an idle machine"] if loud else []


def _quantiles(values: Sequence[float]) -> tuple[float, float, float]:
    """The median, p95 and p99."""
    from statistics import median, quantiles

    hundredths = quantiles(values, n=100)
    return median(values), hundredths[94], hundredths[98]
