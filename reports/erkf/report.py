"""The report on "Computation of Extended Robust Kalman Filter for Real-Time Attitude and Position Estimation"
(Yengera, Inoue, Narasimha, Terra, arXiv:1801.04386): what each way of computing the filter costs, and when it pays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

from matplotlib.figure import Figure

from reports.charts.bar_rows import bar_rows
from reports.erkf import counts as ways
from reports.erkf import tables
from reports.erkf.cost_figure import Way, cost_figure
from reports.erkf.counts import Parallel, all_counts, parallel
from reports.erkf.drive import attitude_figure, errors_figure, position_figure
from reports.erkf.linear import linear_rows, linear_said, sample_rows
from reports.erkf.parallel import parallel_figure
from reports.erkf.results import CURVES, Results
from reports.erkf.route import HEIGHT_TIMES, route_figure
from reports.erkf.said import (
    cost_said,
    drive_said,
    parallel_said,
    rounding_said,
    schedule_said,
    shown_drive_said,
)
from reports.erkf.schedule import speed_figure
from reports.erkf.scheme import filters_figure, imu_figure
from reports.erkf.singular import singular_figure
from reports.erkf.sliding import DRAWN, over_l
from reports.erkf.stability import stability_figure
from reports.erkf.ways import Response, response_s, ways_figure
from reports.pages.machine import legend, timed_on
from reports.pages.measurements import counted_on, who_measured
from reports.pages.pictures import files, pictures
from reports.pages.render import csv_bytes, render
from sched_sim.costs.methods import ROBUST_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from sched_sim.processors.part import Part
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.robust import drive
from studies.robust.costs import HR_HZ, SYSTEMS, N, SystemName
from studies.robust.singular_values import Case

TITLE = "Extended robust Kalman filter: how to compute it, what it buys"
SLOWEST = "leon3"
"""The processor of the lead figure and of the parallel device."""
FIGURES = dict(zip((7, 8), CURVES, strict=True))
"""The paper's, and the filters that they are drawn of here."""
SMALL, LARGE = (f"{100 * error:g} %" for error in drive.SCALE_ERRORS)


def build(results: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what was measured and simulated."""
    counted = {system: load_costs(f"erkf-{system}") for system in SYSTEMS}
    devices = {system: parallel(system) for system in SYSTEMS}
    parts = [load_part(name) for name in shipped_parts()]
    slowest = next(part for part in parts if part.name == SLOWEST)
    responses = _responses(counted, slowest)
    schedules = over_l(tables.robust_costs_of(counted["position"], "robust-givens"))
    rows = {
        "ways": tables.response_rows(responses),
        "costs": tables.cost_rows(all_counts(), results.measurements),
        "parallel": tables.parallel_rows(devices),
        "agreements": tables.agreement_rows(results),
        "attitude-errors": tables.attitude_rows(results),
        "position-errors": tables.position_rows(results),
        "linear": linear_rows(results),
        "linear-sample": sample_rows(results),
        "speeds": tables.speed_rows(counted, results.measurements),
        **{f"measurements-{name}": tables.measurement_rows_of(of) for name, of in results.measurements.items()},
        "least-speeds": tables.least_speed_rows(counted),
        "processors": tables.processor_rows(counted, parts),
        "device": tables.device_rows(slowest),
        "deadlines": [[*row] for row in bar_rows(schedules.frames[schedules.at].panels)],
    }
    figures = pictures({**_figures(results, counted, devices, responses), "deadlines.svg": schedules})
    pages = render(
        "erkf",
        TITLE,
        figures,
        **{name.replace("-", "_"): tables.typeset(table) for name, table in rows.items()},
        measurements=tables.by_system({system: rows[f"measurements-{system}"] for system in SYSTEMS}),
        legend=legend(timed_on(results.measured["position"].provenance), residues=True),
        who_measured=who_measured(results.measurements["position"]),
        measured_on=counted_on(results.measurements["position"]),
        cost=cost_said(results),
        device_gain=parallel_said(devices),
        rounding=rounding_said(results),
        drive=drive_said(results),
        shown_drive=shown_drive_said(results),
        linear_said=linear_said(results),
        schedule=schedule_said(counted, parts, slowest),
        response={f"{each.system} {each.way}": f"{1e3 * each.seconds:#.3g}" for each in responses},
        by_part=tables.typeset(tables.part_rows(counted["position"], parts)),
        shown={_system(case): f"{_system(case)}, {_rows(case)}" for case in CURVES},
        height_times=f"{HEIGHT_TIMES:g}",
        N=N,
        hz=HR_HZ,
        period_ms=f"{1000 / HR_HZ:g}",
        fix_hz=HR_HZ // N,
        soon=DRAWN,
        slowest=SLOWEST,
        small=unbroken(SMALL),
        large=unbroken(LARGE),
        device_last=rows["device"][-1],
    )
    return {
        **pages,
        **files(figures),
        **results.files(),
        **{f"{name}.csv": csv_bytes(table) for name, table in rows.items()},
    }


def unbroken(text: str) -> str:
    """That stays on one line."""
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def _figures(
    results: Results,
    counted: Mapping[SystemName, CostTable],
    devices: Mapping[SystemName, Parallel],
    responses: Sequence[Response],
) -> dict[str, Figure]:
    course = results.columns("drive")
    period_s = 1 / HR_HZ
    return {
        "ways.svg": ways_figure(responses, {"one period": period_s, "next fix": N * period_s}),
        "imu.svg": imu_figure(),
        "filters.svg": filters_figure(),
        "costs.svg": cost_figure(
            _ways(results), {str(system): number for system, number in all_counts().unknowns.items()}, period_s
        ),
        "parallel.svg": parallel_figure({f"{s.capitalize()}, N = {devices[s].N}": devices[s].times for s in SYSTEMS}),
        "singular-values.svg": singular_figure(
            results.columns("singular-values"),
            {
                _system(case): f"{_system(case).capitalize()} (Fig. {figure}): {_rows(case)}"
                for figure, case in FIGURES.items()
            },
        ),
        "route.svg": route_figure(course, results.columns("close-up"), SMALL),
        "attitude.svg": attitude_figure(course, LARGE),
        "position.svg": position_figure(course, SMALL),
        "errors.svg": errors_figure(course, [SMALL, LARGE]),
        "stability.svg": stability_figure(results.columns("linear-curves")),
        "speeds.svg": speed_figure(
            {
                system.capitalize(): {
                    tables.WAYS[method]: tables.robust_costs_of(counted[system], method) for method in ROBUST_METHODS
                }
                for system in SYSTEMS
            },
            N,
            HR_HZ,
        ),
    }


def _system(case: Case) -> str:
    return case.name.partition(", ")[0]


def _rows(case: Case) -> str:
    """Which are uncertain, and mu."""
    return tables.spoken(case.name.partition(", ")[2])


def _ways(results: Results) -> list[Way]:
    counts, measured = all_counts(), results.measurements

    def way_of(way: str) -> Way:
        timed: dict[str, tuple[float, float]] = {
            system: tables.seconds(measured[system], ways.TIMED[way]) for system in SYSTEMS if way in ways.TIMED
        }
        return Way(way, {system: counts.operations[way][system, "finite"] for system in SYSTEMS}, timed)

    return [way_of(way) for way in ways.ALL_WAYS]


def _responses(counted: Mapping[SystemName, CostTable], part: Part) -> list[Response]:
    """Of every way on one processor, with a robust step for each fix."""
    found = []
    for method, system in product(ROBUST_METHODS, SYSTEMS):
        costs = tables.on(counted[system], part, method)
        assert costs is not None
        found.append(Response(system, tables.WAYS[method], response_s(costs, Timing(N, 0, N), HR_HZ)))
    return found
