"""The accuracies of `sched-sim accuracy` as rows for scripts and as a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from sched_sim.cli import accuracy_flags as flags
from sched_sim.cli import options as opt
from sched_sim.cli.output import lines, print_csv, print_json, print_table

if TYPE_CHECKING:
    from studies.selection.along import AlongComparison
    from studies.selection.compare import AccuracyRow, Comparison
    from studies.selection.outputs import Outputs


def show(found: Comparison, asked: flags.Sampled, format: opt.Format) -> None:
    from studies.selection.methods import by_reason

    if format == "json":
        print_json([_row(row, found) for row in found.rows])
        return
    if format == "csv":
        print_csv([_row(row, found) for row in found.rows])
        return
    remarks = [*by_reason((row.method, row.remark) for row in found.rows), *found.left_out]
    unit = _in_unit(found.outputs)
    print_table(
        f"Standard deviation of {found.outputs.name}{unit}, {found.model.name}, {flags.shown(found.sampling)}",
        _said([_words(row, found) for row in found.rows]),
        lines(
            f"over no delay: {found.metric}, over {found.no_delay:.6g}{_unit(found.outputs)} of the filter that uses "
            f"every measurement without delay",
            _meaning(found.rows),
            asked.words,
            _intervals(found),
            *remarks,
        ),
    )


MEANING = {
    "jump": "jump: how far the output moves when a correction lands (1 sigma)",
    "believed": "believed: what the filter's own covariance says of its worst step, where that is not the truth",
    "bound": "bound: the figures are no less than the true ones: the intervals between measurements repeat too late to "
    "look at each, so any order of the shorter and the longer is allowed for",
    "bias": "bias: the mean error, from --motion and the delay; worst and rms are about it",
}


def _meaning(rows: Sequence[AccuracyRow]) -> str:
    said = [MEANING["jump"]]
    if any(row.accuracy and row.accuracy.believed is not None for row in rows):
        said.append(MEANING["believed"])
    if any(row.accuracy and row.accuracy.verdict == "bound" for row in rows):
        said.append(MEANING["bound"])
    if any(row.accuracy and row.accuracy.bias for row in rows):
        said.append(MEANING["bias"])
    return "\n".join(said)


def _intervals(found: Comparison) -> str:
    """Of which they are the figures, where they are not all the same."""
    exact = {row.every for row in found.rows if row.accuracy and row.accuracy.verdict != "bound"}
    if all(isinstance(found.sampling.using(every).between, int) for every in exact):
        return ""
    return "accuracy and ages are of all intervals between measurements, the longer ones too"


def _in_unit(outputs: Outputs) -> str:
    return f" in {outputs.unit}" if outputs.unit else ""


def _unit(outputs: Outputs) -> str:
    return f" {outputs.unit}" if outputs.unit else ""


def _row(row: AccuracyRow, found: Comparison) -> dict[str, Any]:
    """For scripts."""
    of = row.accuracy

    return {
        "method": row.method,
        "every": row.every,
        "N": row.N,
        "M": found.sampling.M,
        "L": None if of is None else of.L,
        "reaction_ms": row.reaction_ms,
        "oldest_age_steps": None if of is None else of.oldest,
        "oldest_age_ms": row.oldest_ms,
        "mean_age_steps": None if of is None else of.mean_age,
        "mean_age_ms": None if of is None or of.L is None else found.sampling.using(row.every).mean_age_ms(of.L),
        "output": found.outputs.name,
        "unit": found.outputs.unit or None,
        "worst_std": None if of is None else _finite(of.worst),
        "rms_std": None if of is None else _finite(of.rms),
        "no_delay_std": found.no_delay,
        "over_no_delay": None if row.over is None else _finite(row.over),
        "jump_std": None if of is None else _finite(of.jump),
        "believed_std": None if of is None or of.believed is None else _finite(of.believed),
        "bias": None if of is None else of.bias,
        "worst_with_bias": None if of is None else _finite(of.total),
        "spectral_radius": None if of is None or of.radius is None else _finite(of.radius),
        "verdict": None if of is None else of.verdict,
        "remark": row.remark or None,
    }


def _finite(value: float) -> float | None:
    return value if value < float("inf") else None


def _words(row: AccuracyRow, found: Comparison) -> dict[str, Any]:
    of = row.accuracy
    timed = found.sampling.hr_hz is not None
    age = "oldest age, ms" if timed else "oldest age, steps"
    oldest = None if of is None else (row.oldest_ms if timed else of.oldest)
    return {
        "method": "standard (no delay)" if row.method == "standard" else row.method,
        "every": row.every,
        "N": row.N,
        "lands at L": None if of is None else of.L,
        age: None if oldest is None else f"{oldest:g}",
        "worst": _figure(of and of.worst),
        "rms": _figure(of and of.rms),
        "over no delay": None if row.over is None else _percent(row.over),
        "jump": _figure(of and of.jump),
        "believed": _figure(of and of.believed),
        "bias": _figure((of and of.bias) or None),
        "verdict": "does not land" if of is None else of.verdict,
    }


def _said(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Without the columns in which there may be nothing, and is."""
    empty = [name for name in ("believed", "bias") if all(row[name] is None for row in rows)]
    return [{name: value for name, value in row.items() if name not in empty} for row in rows]


def _figure(value: float | None) -> str | None:
    if value is None:
        return None
    return f"{value:.5g}" if value < float("inf") else "grows"


def _percent(over: float) -> str:
    if not over < float("inf"):
        return "grows"
    return f"{100 * over:.3g} %" if over < LARGE else f"{100 * over:,.0f} %"


LARGE = 9.99
"""From here on a percentage has no more than three digits before its point."""


def show_along(found: AlongComparison, asked: flags.Sampled, format: opt.Format) -> None:
    from studies.selection.methods import by_reason

    rows = [
        {
            "method": row.method,
            "every": row.every,
            "N": row.N,
            "M": found.sampling.M,
            "L": row.L,
            "oldest_age_ms": row.oldest_ms,
            "output": found.outputs.name,
            "unit": found.outputs.unit or None,
            "median_std": row.spread and row.spread.median,
            "p95_std": row.spread and row.spread.p95,
            "worst_std": row.spread and row.spread.worst,
            "over_no_delay": row.over,
            "remark": row.remark or None,
        }
        for row in found.rows
    ]
    if format == "json":
        print_json(rows)
        return
    if format == "csv":
        print_csv(rows)
        return
    shown = [
        {
            "method": "standard (no delay)" if row.method == "standard" else row.method,
            "every": row.every,
            "N": row.N,
            "lands at L": row.L,
            **({} if found.sampling.hr_hz is None else {"oldest age, ms": f"{row.oldest_ms:g}"}),
            "median": _figure(row.spread and row.spread.median),
            "95 %": _figure(row.spread and row.spread.p95),
            "worst": _figure(row.spread and row.spread.worst),
            "over no delay": None if row.over is None else _percent(row.over),
        }
        for row in found.rows
    ]
    remarks = [*by_reason((row.method, row.remark) for row in found.rows), *found.left_out]
    print_table(
        f"Standard deviation of {found.outputs.name}{_in_unit(found.outputs)}, {found.model.name}, "
        f"{flags.shown(found.sampling)}, over steps {found.first} to {found.steps} of the trajectory",
        shown,
        lines(
            "over no delay: worst, over that of the filter that uses every measurement without delay",
            asked.words,
            *remarks,
        ),
    )
