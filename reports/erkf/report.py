"""The report on "Computation of Extended Robust Kalman Filter for Real-Time Attitude and Position Estimation"
(Yengera, Inoue, Narasimha, Terra, arXiv:1801.04386): what each way of computing the filter costs, and when it pays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from matplotlib.figure import Figure

from reports.charts.panels import Panel
from reports.erkf import counts as ways
from reports.erkf import tables
from reports.erkf.cost_figure import Way, cost_figure
from reports.erkf.counts import Parallel, all_counts, parallel
from reports.erkf.drive import attitude_figure, errors_figure, position_figure, route_figure
from reports.erkf.parallel import parallel_figure
from reports.erkf.results import Results
from reports.erkf.schedule import millions, one_period, speed_figure, two_rates
from reports.erkf.singular import singular_figure
from reports.pages.machine import legend, residue, timed_on
from reports.pages.numbers import percent, span
from reports.pages.pictures import files, pictures
from reports.pages.render import csv_bytes, render
from sched_sim.costs.methods import ROBUST_METHODS, RobustMethod
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.fit import Fit, fit
from sched_sim.design.least_speed import least_speed
from sched_sim.design.timing import Timing
from sched_sim.processors.part import Part
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.robust import drive
from studies.robust.costs import HR_HZ, SYSTEMS, N, SystemName, between_fixes

TITLE = "The extended robust Kalman filter: which way to compute it, on which processor, and what it buys"
SLOWEST = "leon3"
"""The processor of the Gantt charts and of the parallel device."""
SOON = 10
"""The L of the Gantt charts other than N."""
SMALL, LARGE = (f"{100 * error:g} %" for error in drive.SCALE_ERRORS)


def build(results: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what was measured and simulated."""
    counted = {system: load_costs(f"erkf-{system}") for system in SYSTEMS}
    devices = {system: parallel(system) for system in SYSTEMS}
    parts = [load_part(name) for name in shipped_parts()]
    slowest = next(part for part in parts if part.name == SLOWEST)
    rows = {
        "costs": tables.cost_rows(all_counts(), results.measured),
        "parallel": tables.parallel_rows(devices),
        "agreements": tables.agreement_rows(results),
        "attitude-errors": tables.attitude_rows(results),
        "position-errors": tables.position_rows(results),
        "speeds": tables.speed_rows(counted, results.measured),
        "processors": tables.processor_rows(counted, parts),
        "device": tables.device_rows(slowest),
    }
    figures = pictures(_figures(results, counted, devices, slowest))
    pages = render(
        "erkf",
        TITLE,
        figures,
        **{name.replace("-", "_"): table for name, table in rows.items()},
        legend=legend(timed_on(results.measured["position"].provenance), residues=True),
        cost=_cost(results),
        device_gain=_parallel(devices),
        rounding=_rounding(results),
        drive=_drive(results),
        schedule=_schedule(counted, parts, slowest),
        heavy=_heavy(rows["processors"]),
        N=N,
        hz=HR_HZ,
        fix_hz=HR_HZ // N,
        soon=SOON,
        slowest=SLOWEST,
        small=SMALL,
        large=LARGE,
        device_last=rows["device"][-1],
    )
    return {
        **pages,
        **files(figures),
        **results.files(),
        **{f"{name}.csv": csv_bytes(table) for name, table in rows.items()},
    }


def _figures(
    results: Results,
    counted: Mapping[SystemName, CostTable],
    devices: Mapping[SystemName, Parallel],
    slowest: Part,
) -> dict[str, Figure | Sequence[Panel]]:
    course = results.columns("drive")
    return {
        "costs.svg": cost_figure(_ways(results), 1 / HR_HZ),
        "parallel.svg": parallel_figure({f"{s.capitalize()}, N = {devices[s].N}": devices[s].times for s in SYSTEMS}),
        "singular-values.svg": singular_figure(
            results.columns("singular-values"), {"attitude": "Attitude (Fig. 7)", "position": "Position (Fig. 8)"}
        ),
        "route.svg": route_figure(course, results.columns("close-up"), SMALL),
        "attitude.svg": attitude_figure(course, LARGE),
        "position.svg": position_figure(course, SMALL),
        "errors.svg": errors_figure(course, [SMALL, LARGE]),
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
        "ways.svg": _ways_panels(counted["position"], slowest),
        "deadlines.svg": _deadlines_panels(counted["position"]),
    }


def _ways(results: Results) -> list[Way]:
    counts = all_counts()
    names = {system: f"{system}, N = {counts.unknowns[system]}" for system in SYSTEMS}

    def way_of(way: str) -> Way:
        timed = {
            names[system]: tables.seconds(results.measured[system], ways.TIMED[way])
            for system in SYSTEMS
            if way in ways.TIMED
        }
        return Way(way, {names[system]: counts.operations[way][system, "finite"] for system in SYSTEMS}, timed)

    return [way_of(way) for way in ways.ALL_WAYS]


def _ways_panels(table: CostTable, part: Part) -> list[Panel]:
    """Every way on one processor."""
    pace, panels = Fraction(1, HR_HZ), []
    for method in ROBUST_METHODS:
        costs = tables.on(table, part, method)
        assert costs is not None
        title = tables.WAYS[method]
        panels.append(
            two_rates(
                costs, Timing(N, 0, N), pace, title[0].upper() + title[1:], f"HR period {float(1000 * pace):g} ms"
            )
        )
    return panels


def _deadlines_panels(table: CostTable) -> list[Panel]:
    """Givens at the least speeds for two L, and in one period at the faster of them."""
    costs = tables.robust_costs_of(table, "robust-givens")
    timings = [Timing(N, 0, L) for L in (N, SOON)]
    speeds = [least_speed(costs, timing).speed for timing in timings]
    panels = [
        two_rates(costs, timing, speed, f"Two rates, L = {timing.L}", _pace(speed))
        for timing, speed in zip(timings, speeds, strict=True)
    ]
    return [*panels, one_period(costs, N, speeds[-1], "In one period", _pace(speeds[-1]))]


def _pace(speed: Fraction) -> str:
    return f"{millions(speed, HR_HZ):.3g} million operations/s"


# ------------------------------------------------------------------------------------------- the numbers of the text


def _cost(results: Results) -> dict[str, Any]:
    counts = all_counts()

    def both(way: str, reference: str, digits: int = 1) -> list[str]:
        return [f"{counts.ratio(way, reference, system):.{digits}f}" for system in SYSTEMS]

    def by_system_and_penalty(way: str, reference: str) -> str:
        ratios = [counts.ratio(way, reference, s, penalty) for s in SYSTEMS for penalty in ("infinite", "finite")]
        return f"{min(ratios):.2f} to {max(ratios):.2f}"

    timed = {
        method: [tables.seconds(results.measured[system], method) for system in SYSTEMS] for method in ROBUST_METHODS
    }
    position = {way: f"{numbers['position', 'finite']:,}" for way, numbers in counts.operations.items()}
    return {
        "unknowns": counts.unknowns,
        "inverse": position[ways.INVERSE],
        "givens": position[ways.GIVENS_ORDERED],
        "lu": position[ways.LU_ORDERED],
        "closed": position[ways.CLOSED],
        "paper": both(ways.REPEATED, ways.PER_COLUMN, 2),
        "against_one": both(ways.GIVENS, ways.INVERSE, 2),
        "columns_against_one": both(ways.PER_COLUMN, ways.INVERSE),
        "natural": by_system_and_penalty(ways.GIVENS_NATURAL, ways.INVERSE_SKIPPING),
        "order": both(ways.GIVENS_NATURAL, ways.GIVENS_ORDERED),
        "over_lu": both(ways.GIVENS_ORDERED, ways.LU_ORDERED),
        "over_closed": both(ways.GIVENS_ORDERED, ways.CLOSED),
        "over_kalman": both(ways.CLOSED, ways.KALMAN, 2),
        "inverse_over_givens": both(ways.INVERSE, ways.GIVENS_ORDERED),
        "slowest": tables.micros(results.measured["position"], "robust-inverse"),
        "slowest_share": span(*(f"{100 * time * HR_HZ:.1f}" for time in timed["robust-inverse"][-1])),
        "time_ratio": {
            "inverse": _ratios(timed, "robust-inverse", "robust-givens"),
            "lu": _ratios(timed, "robust-givens", "robust-lu"),
            "closed": _ratios(timed, "robust-givens", "robust-closed"),
        },
    }


def _ratios(
    timed: Mapping[RobustMethod, list[tuple[float, float]]], first: RobustMethod, second: RobustMethod
) -> list[str]:
    """For each system how many times as long `first` takes: by the least times, and by the 95th percentiles."""
    both = zip(timed[first], timed[second], strict=True)
    ratios = [sorted(long / short for long, short in zip(*ends, strict=True)) for ends in both]
    return [span(f"{least:.1f}", f"{most:.1f}") for least, most in ratios]


def _parallel(devices: Mapping[SystemName, Parallel]) -> dict[str, Any]:
    first, last = ways.PROCESSORS[0], ways.PROCESSORS[-1]
    dense, _, ordered = ways.SCHEDULES

    def gain(name: str, P: int = last) -> list[str]:
        return [f"{devices[s].times[name][first] / devices[s].times[name][P]:.0f}" for s in SYSTEMS]

    return {
        "dense": gain(dense),
        "ordered": gain(ordered),
        "ordered_16": gain(ordered, 16),
        "last": last,
        "by_sparsity": [f"{devices[s].times[dense][first] / devices[s].times[ordered][first]:.0f}" for s in SYSTEMS],
        "one": [f"{devices[s].times[ordered][first]:,}" for s in SYSTEMS],
        "ordered_at_16": [f"{devices[s].times[ordered][16]:,}" for s in SYSTEMS],
        "dense_last": [f"{devices[s].times[dense][last]:,}" for s in SYSTEMS],
        "dense_16": [f"{devices[s].times[dense][16]:,}" for s in SYSTEMS],
        "stages": [(devices[s].stages[dense], devices[s].stages[ordered]) for s in SYSTEMS],
    }


def _rounding(results: Results) -> dict[str, Any]:
    """How far each way is from the inverse. Residues, but for what fails."""
    records = results.records("agreement")
    scaled = [record for record in records if "radians" not in record["case"]]

    def worst(rows: Sequence[Mapping[str, str]], *keys: str) -> str:
        return residue(max(float(row[key]) for row in rows for key in keys))

    by_way = {way: [record for record in scaled if record["way"] == way] for way in ("givens", "lu")}
    (radians,) = [r for r in records if "radians" in r["case"] and r["way"] == "givens"]
    unpivoted = [r for r in records if r["way"] == "lu without pivoting"]
    kept, failing = ([r for r in unpivoted if bool(r["fails_in_step"]) == fails] for fails in (False, True))
    limits = [record for record in unpivoted if "mu=inf" in record["case"]]
    return {
        "absolute": worst(by_way["givens"], "largest", "smallest"),
        "relative": worst(by_way["givens"], "relative_largest", "relative_smallest"),
        "lu_absolute": worst(by_way["lu"], "largest", "smallest"),
        "lu_relative": worst(by_way["lu"], "relative_largest", "relative_smallest"),
        "radians_absolute": worst([radians], "largest", "smallest"),
        "radians_percent": f"{100 * float(radians['relative_smallest']):.0f}",
        "failing": len(failing),
        "of": len(unpivoted),
        "the_limits_fail": failing == limits,
        "step": max(int(record["fails_in_step"]) for record in failing),
        "unpivoted": worst(kept, "relative_largest"),
        "pivoted": worst([r for r in by_way["lu"] if _same(r, kept)], "relative_largest"),
    }


def _same(record: Mapping[str, str], others: list[dict[str, str]]) -> bool:
    return record["case"] in [candidate["case"] for candidate in others]


def _drive(results: Results) -> dict[str, Any]:
    """Errors with twice their standard errors."""
    attitude = {(float(r["scale_error"]), r["method"]): r for r in results.records("attitude")}
    at = {(float(r["scale_error"]), r["method"]): r for r in results.records("position")}
    small, large = drive.SCALE_ERRORS
    (raw,) = results.records("raw")
    mild, strong = drive.POSITION_EKF.name, drive.POSITION_ROBUST.name

    def error(scale: float, method: drive.AttitudeMethod, angle: str = "yaw") -> str:
        return tables.with_error(attitude[scale, method.name], f"{angle}_deg")

    def both(method: drive.AttitudeMethod) -> list[str]:
        return [error(scale, method) for scale in (small, large)]

    def worse(scale: float, method: drive.AttitudeMethod, angle: str) -> str:
        """Than the EKF, in percent; negative if it is better."""
        robust, plain = (float(attitude[scale, candidate.name][f"{angle}_deg"]) for candidate in (method, drive.EKF))
        return f"{100 * (robust / plain - 1):.0f}"

    def sides(record: Mapping[str, str], what: str) -> str:
        return ", ".join(record[f"{what}_{axis}_m"] for axis in ("north", "east", "down"))

    return {
        "seeds": len(drive.SEEDS),
        "ekf": both(drive.EKF),
        "robust": both(drive.ROBUST),
        "more": both(drive.MORE_ROBUST),
        "inflated": both(drive.INFLATED),
        "noisier": both(drive.NOISIER),
        "limits": [error(small, method) for method in (drive.LIMIT_GYRO, drive.LIMIT_BIAS, drive.LIMIT_ALL)],
        "pitch": [error(large, method, "pitch") for method in (drive.EKF, drive.MORE_ROBUST)],
        "roll": [error(small, method, "roll") for method in (drive.EKF, drive.MORE_ROBUST)],
        "worse": [
            {angle: worse(scale, drive.MORE_ROBUST, angle) for angle in ("roll", "pitch")}
            for scale in drive.SCALE_ERRORS
        ],
        "from_gps": attitude[small, drive.ROBUST.name]["gps_deg"],
        "from_imu": attitude[small, drive.ROBUST.name]["imu_deg"],
        "ekf_from_gps": attitude[small, drive.EKF.name]["gps_deg"],
        "raw": raw,
        "fix": sides(at[small, strong], "fix"),
        "between": sides(at[small, strong], "between"),
        "ekf_between": sides(at[small, mild], "between"),
        "gps": sides(raw, "gps"),
        "held": sides(raw, "held"),
        "position_differs": any(
            tables.differ(at[scale, mild], at[scale, strong], name)
            for scale in drive.SCALE_ERRORS
            for name in tables.OF_POSITION
        ),
        "outage": [tables.with_error(at[small, name], "outage_end_m") for name in (mild, strong)],
    }


def _schedule(counted: Mapping[SystemName, CostTable], parts: list[Part], slowest: Part) -> dict[str, Any]:
    position = counted["position"]
    costs = {method: tables.robust_costs_of(position, method) for method in ROBUST_METHODS}
    least = {method: least_speed(work, Timing(N, 0, N)).speed for method, work in costs.items()}
    serial = {method: work.inertial + work.robust_step for method, work in costs.items()}
    able: dict[str, dict[RobustMethod, Fit]] = {}
    in_every_step: dict[str, dict[RobustMethod, Fit]] = {}
    for part in parts:
        on = {method: tables.on(position, part, method) for method in ROBUST_METHODS}
        if all(work is not None for work in on.values()):
            for fits, timing in ((able, Timing(N, 0, N)), (in_every_step, Timing(1, 0, 1))):
                fits[part.name] = {m: fit(work, timing, Fraction(HR_HZ)) for m, work in on.items() if work is not None}
    here, here_in_every_step = able[slowest.name], in_every_step[slowest.name]
    alone = {m: tables.on(position, slowest, m) for m in ROBUST_METHODS}
    every_way = [name for name, of_part in able.items() if all(verdict.fits for verdict in of_part.values())]
    lacking = [part.name for part in parts if part.name not in able]
    failing = [tables.WAYS[method] for method, verdict in here_in_every_step.items() if not verdict.fits]
    return {
        "serial": {method: f"{millions(speed, HR_HZ):.3g}" for method, speed in serial.items()},
        "least": {method: f"{millions(speed, HR_HZ):.2g}" for method, speed in least.items()},
        "gain": {method: f"{float(serial[method] / least[method]):.0f}" for method in costs},
        "load": {method: percent(verdict.load) for method, verdict in here.items()},
        "landed": {method: verdict.landed for method, verdict in here.items()},
        "one_period": {m: percent((work.inertial + work.robust_step) * HR_HZ) for m, work in alone.items() if work},
        "inertial": f"{float(100 * HR_HZ * _inertial(position, slowest)):.2f}",
        "able": len(able),
        "every_way": every_way,
        "not_every_way": f", not {' and '.join(name for name in able if name not in every_way)}"
        * (every_way != list(able)),
        "single": [part.name for part in parts if part.precision == "single"],
        "lacking": lacking,
        "every_step": {method: percent(verdict.needed) for method, verdict in here_in_every_step.items()},
        "every_step_fails": f": the processor is too slow for {' and '.join(failing)}" if failing else "",
        "every_step_all": [
            name for name, of_part in in_every_step.items() if all(verdict.fits for verdict in of_part.values())
        ],
        "without_fix": {f"robust-{way}": f"{float(share):.2f}" for way, share in between_fixes("position").items()},
        "least_soon": f"{millions(least_speed(costs['robust-givens'], Timing(N, 0, SOON)).speed, HR_HZ):.3g}",
    }


def _inertial(table: CostTable, part: Part) -> Fraction:
    """Seconds of the propagation alone."""
    costs = tables.on(table, part, "robust-closed")
    assert costs is not None
    return Fraction(costs.inertial)


def _heavy(rows: tables.Rows) -> tables.Rows:
    """Rows of the position filter on processors that can time all of it."""
    heading, *body = rows
    kept = [row for row in body if row[0] == "position" and row[3] != "no sqrt"]
    return [heading[1:], *(row[1:] for row in kept)]
