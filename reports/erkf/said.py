"""The numbers of the text of the report on the robust filter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from reports.erkf import counts as ways
from reports.erkf import tables
from reports.erkf.counts import Parallel, all_counts
from reports.erkf.drive import ANGLES, windowed_rms, wrapped_deg
from reports.erkf.results import CURVES, Results
from reports.erkf.schedule import millions, one_period
from reports.erkf.sliding import DRAWN
from reports.erkf.styles import FILTERS
from reports.pages.machine import residue
from reports.pages.numbers import power, significant, span
from sched_sim.costs.methods import ROBUST_METHODS, RobustMethod
from sched_sim.costs.table import CostTable
from sched_sim.design.fit import Fit, fit
from sched_sim.design.least_speed import least_speed
from sched_sim.design.timing import Timing
from sched_sim.processors.part import Part
from studies.machines.ranges import range_of
from studies.robust import drive
from studies.robust.costs import HR_HZ, SYSTEMS, N, SystemName, between_fixes, robust_case
from studies.robust.counts import PENALTIES, filled, product_share


def cost_said(results: Results) -> dict[str, Any]:
    counts = all_counts()

    def both(way: str, reference: str, digits: int = 1) -> list[str]:
        return [f"{counts.ratio(way, reference, system):.{digits}f}" for system in SYSTEMS]

    def by_system_and_penalty(way: str, reference: str) -> str:
        ratios = [counts.ratio(way, reference, s, penalty) for s in SYSTEMS for penalty in ("infinite", "finite")]
        return f"{min(ratios):.2f} to {max(ratios):.2f}"

    position_times = tables.seconds(results.measurements["position"], "robust-inverse")
    position = {way: f"{numbers['position', 'finite']:,}" for way, numbers in counts.operations.items()}
    shares = [filled(system, penalty) for system in SYSTEMS for penalty in PENALTIES]
    states = [len(robust_case(system).start.x) for system in SYSTEMS]
    products = [product_share(counts.unknowns[s], n) for s, n in zip(SYSTEMS, states, strict=True)]
    return {
        "unknowns": counts.unknowns,
        "filled": span(f"{100 * min(shares):.0f}", f"{100 * max(shares):.0f}"),
        "inversion": f"{100 * (1 - max(products)):.0f}",
        "symmetric": [str(n * (n - 1)) for n in states],
        "repeated": position[ways.REPEATED],
        "inverse": position[ways.INVERSE],
        "givens": position[ways.GIVENS_ORDERED],
        "lu": position[ways.LU_ORDERED],
        "closed": position[ways.CLOSED],
        "householder": position[ways.HOUSEHOLDER_ORDERED],
        "faddeev": position[ways.FADDEEV_ORDERED],
        "paper": both(ways.REPEATED, ways.PER_COLUMN, 2),
        "against_one": both(ways.GIVENS, ways.INVERSE, 2),
        "columns_against_one": both(ways.PER_COLUMN, ways.INVERSE),
        "natural": by_system_and_penalty(ways.GIVENS_NATURAL, ways.INVERSE_SKIPPING),
        "order": both(ways.GIVENS_NATURAL, ways.GIVENS_ORDERED),
        "householder_dense": both(ways.HOUSEHOLDER, ways.GIVENS, 2),
        "householder_ordered": both(ways.HOUSEHOLDER_ORDERED, ways.GIVENS_ORDERED, 2),
        "householder_natural": {
            penalty: [
                f"{counts.ratio(ways.HOUSEHOLDER_NATURAL, ways.GIVENS_NATURAL, system, penalty):.2f}"
                for system in SYSTEMS
            ]
            for penalty in PENALTIES
        },
        "faddeev_dense": both(ways.FADDEEV, ways.LU, 2),
        "faddeev_ordered": both(ways.FADDEEV_ORDERED, ways.LU_ORDERED, 2),
        "over_faddeev": both(ways.GIVENS_ORDERED, ways.FADDEEV_ORDERED),
        "over_lu": both(ways.GIVENS_ORDERED, ways.LU_ORDERED),
        "over_closed": both(ways.GIVENS_ORDERED, ways.CLOSED),
        "over_kalman": both(ways.CLOSED, ways.KALMAN, 2),
        "inverse_over_givens": both(ways.INVERSE, ways.GIVENS_ORDERED),
        "slowest": tables.micros(results.measurements["position"], "robust-inverse"),
        "slowest_share": span(*(f"{100 * time * HR_HZ:.1f}" for time in position_times)),
        "time_ratio": {
            "inverse": _ratios(results, "robust-inverse", "robust-givens"),
            "lu": _ratios(results, "robust-givens", "robust-lu"),
            "closed": _ratios(results, "robust-givens", "robust-closed"),
        },
    }


def _ratios(results: Results, first: RobustMethod, second: RobustMethod) -> list[str]:
    """For each system how many times as long `first` takes by the least times, over all measurements."""

    def ratio(table: CostTable) -> Fraction:
        return table.entry(first, "robust_step").minimum / table.entry(second, "robust_step").minimum

    ranges = [range_of(ratio, results.measurements[system]) for system in SYSTEMS]
    return [span(f"{float(least):.1f}", f"{float(most):.1f}") for least, most in ranges]


def parallel_said(devices: Mapping[SystemName, Parallel]) -> dict[str, Any]:
    first, last = ways.PROCESSORS[0], ways.PROCESSORS[-1]
    dense, _, ordered = ways.SCHEDULES

    def gain(name: str) -> list[str]:
        return [f"{devices[s].times[name][first] / devices[s].times[name][last]:.0f}" for s in SYSTEMS]

    return {
        "dense": gain(dense),
        "ordered": gain(ordered),
        "last": last,
        "by_sparsity": [f"{devices[s].times[dense][first] / devices[s].times[ordered][first]:.0f}" for s in SYSTEMS],
        "one": [f"{devices[s].times[ordered][first]:,}" for s in SYSTEMS],
        "ordered_at_16": [f"{devices[s].times[ordered][16]:,}" for s in SYSTEMS],
        "dense_last": [f"{devices[s].times[dense][last]:,}" for s in SYSTEMS],
        "dense_16": [f"{devices[s].times[dense][16]:,}" for s in SYSTEMS],
        "stages": [(devices[s].stages[dense], devices[s].stages[ordered]) for s in SYSTEMS],
    }


def rounding_said(results: Results) -> dict[str, Any]:
    """How far each way is from the inverse. Residues, but for what fails."""
    records = results.records("agreement")
    scaled = [record for record in records if "radians" not in record["case"]]

    drawn = [case.name for case in CURVES]

    def worst(rows: Sequence[Mapping[str, str]], *keys: str) -> str:
        return power(residue(max(float(row[key]) for row in rows for key in keys)))

    by_way = {way: [record for record in scaled if record["way"] == way] for way in ("givens", "lu")}
    radians = [r for r in records if "radians" in r["case"] and r["way"] in by_way]
    unpivoted = [r for r in records if r["way"] == "lu without pivoting"]
    kept, failing = ([r for r in unpivoted if bool(r["fails_in_step"]) == fails] for fails in (False, True))
    limits = [record for record in unpivoted if "mu=inf" in record["case"]]
    return {
        "absolute": worst(by_way["givens"], "largest", "smallest"),
        "drawn": worst([r for r in by_way["givens"] if r["case"] in drawn], "largest", "smallest"),
        "relative": worst(by_way["givens"], "relative_largest", "relative_smallest"),
        "lu_absolute": worst(by_way["lu"], "largest", "smallest"),
        "lu_relative": worst(by_way["lu"], "relative_largest", "relative_smallest"),
        "radians_absolute": worst(radians, "largest", "smallest"),
        "radians_percent": f"{100 * float(residue(max(float(r['relative_smallest']) for r in radians))):.0f}",
        "failing": len(failing),
        "of": len(unpivoted),
        "the_limits_fail": failing == limits,
        "step": max(int(record["fails_in_step"]) for record in failing),
        "unpivoted": worst(kept, "relative_largest"),
        "pivoted": worst([r for r in by_way["lu"] if _same(r, kept)], "relative_largest"),
    }


def _same(record: Mapping[str, str], others: list[dict[str, str]]) -> bool:
    return record["case"] in [candidate["case"] for candidate in others]


def drive_said(results: Results) -> dict[str, Any]:
    """Errors with twice their standard errors."""
    attitude = {(float(r["scale_error"]), r["method"]): r for r in results.records("attitude")}
    at = {
        ((float(r["scale_error"]), float(r["accelerometer_error"])), r["method"]): r
        for r in results.records("position")
    }
    small, large = drive.SCALE_ERRORS
    (raw,) = results.records("raw")
    mild, strong = drive.POSITION_EKF.name, drive.POSITION_ROBUST.name

    def error(scale: float, method: drive.AttitudeMethod, angle: str = "yaw") -> str:
        return tables.unbroken(tables.with_error(attitude[scale, method.name], f"{angle}_deg"))

    def both(method: drive.AttitudeMethod) -> list[str]:
        return [error(scale, method) for scale in (small, large)]

    def worse(scale: float, method: drive.AttitudeMethod, angle: str) -> str:
        """Than the EKF, in percent; negative if it is better."""
        robust, plain = (float(attitude[scale, candidate.name][f"{angle}_deg"]) for candidate in (method, drive.EKF))
        return f"{100 * (robust / plain - 1):.0f}"

    def sides(record: Mapping[str, str], what: str) -> str:
        return ", ".join(record[f"{what}_{axis}_m"] for axis in ("north", "east", "down"))

    first = drive.POSITION_ERRORS[0]
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
        "fix": sides(at[first, strong], "fix"),
        "between": sides(at[first, strong], "between"),
        "ekf_between": sides(at[first, mild], "between"),
        "gps": sides(raw, "gps"),
        "held": sides(raw, "held"),
        "accelerometer": f"{100 * drive.ACCELEROMETER_ERROR:g}",
        "stated": error(large, drive.STATED),
        "position_differs": any(
            tables.differ(at[scales, mild], at[scales, drive.POSITION_SCALE.name], name)
            for scales in drive.POSITION_ERRORS
            for name in tables.OF_POSITION
        ),
        "outage": {
            of: tables.unbroken(tables.with_error(at[drive.POSITION_ERRORS[-1], method.name], "outage_end_m"))
            for of, method in {
                "ekf": drive.POSITION_EKF,
                "scale": drive.POSITION_SCALE,
                "inflated": drive.POSITION_INFLATED,
                "bias": drive.POSITION_ROBUST,
                "stated": drive.POSITION_STATED,
            }.items()
        },
    }


def shown_drive_said(results: Results) -> dict[str, Any]:
    """What the figures of one drive show, at the large scale error; degrees."""
    course, large = results.columns("drive"), f"{100 * drive.SCALE_ERRORS[-1]:g} %"
    settled = course["time_s"] >= drive.SETTLED_S

    def off(what: str, angle: str) -> FloatArray:
        return wrapped_deg(course[f"{what} {angle}"] - course[f"true {angle}"])

    rms = {(name, angle): windowed_rms(off(f"{name} {large}", angle))[1:] for name in FILTERS for angle in ANGLES}
    worse = float(np.mean(rms["ERKF", "pitch"] > rms["EKF", "pitch"]))
    return {
        "robust_yaw": f"{rms['ERKF', 'yaw'].max():.2f}",
        "ekf_yaw": f"{rms['EKF', 'yaw'].max():.2f}",
        "pitch_worse": "throughout" if worse == 1 else f"in {100 * worse:.0f} % of them",
        "yaw_off": f"{max(np.abs(off(f'{name} {large}', 'yaw')[settled]).max() for name in FILTERS):.1f}",
        "drift": f"{np.abs(off('imu', 'yaw')).max():.0f}",
    }


def schedule_said(counted: Mapping[SystemName, CostTable], parts: list[Part], slowest: Part) -> dict[str, Any]:
    position = counted["position"]
    costs = {method: tables.robust_costs_of(position, method) for method in ROBUST_METHODS}
    least = {method: least_speed(work, Timing(N, 0, N)).speed for method, work in costs.items()}
    givens, soon = costs["robust-givens"], least_speed(costs["robust-givens"], Timing(N, 0, DRAWN)).speed
    serial = {method: work.inertial + work.robust_step for method, work in costs.items()}
    able: dict[str, dict[RobustMethod, Fit]] = {}
    in_every_step: dict[str, dict[RobustMethod, Fit]] = {}
    for part in parts:
        on = {method: tables.on(position, part, method) for method in ROBUST_METHODS}
        if all(work is not None for work in on.values()):
            for fits, timing in ((able, Timing(N, 0, N)), (in_every_step, Timing(1, 0, 1))):
                fits[part.name] = {m: fit(work, timing, Fraction(HR_HZ)) for m, work in on.items() if work is not None}
    here, here_in_every_step = able[slowest.name], in_every_step[slowest.name]
    every_way = [name for name, of_part in able.items() if all(verdict.fits for verdict in of_part.values())]
    lacking = [part.name for part in parts if part.name not in able]
    failing = [tables.WAYS[method] for method, verdict in here_in_every_step.items() if not verdict.fits]
    return {
        "serial": {method: f"{millions(speed, HR_HZ):.3g}" for method, speed in serial.items()},
        "least": {method: f"{millions(speed, HR_HZ):.2g}" for method, speed in least.items()},
        "gain": {method: f"{float(serial[method] / least[method]):.0f}" for method in costs},
        "landed": {method: verdict.landed for method, verdict in here.items()},
        "inertial": f"{float(100 * HR_HZ * _inertial(position, slowest)):.2f}",
        "able": len(able),
        "every_way": every_way,
        "not_every_way": f", not {' and '.join(name for name in able if name not in every_way)}"
        * (every_way != list(able)),
        "single": [part.name for part in parts if part.precision == "single"],
        "lacking": lacking,
        "every_step": {method: share_of(verdict.needed) for method, verdict in here_in_every_step.items()},
        "every_step_fails": f": the processor is too slow for {' and '.join(failing)}" if failing else "",
        "every_step_all": [
            name for name, of_part in in_every_step.items() if all(verdict.fits for verdict in of_part.values())
        ],
        "without_fix": {f"robust-{way}": f"{float(share):.2f}" for way, share in between_fixes("position").items()},
        "least_soon": f"{millions(soon, HR_HZ):.3g}",
        "propagation": significant(100 * givens.inertial / soon, 2),
        "late": one_period(givens, N, soon, "", "").schedule.misses,
    }


def share_of(needed: Fraction) -> str:
    """How much of a speed, such as "23.7 % of" or "19.6 times"."""
    return f"{significant(needed)} times" if needed > 1 else f"{significant(100 * needed)} % of"


def _inertial(table: CostTable, part: Part) -> Fraction:
    """Seconds of the propagation alone."""
    costs = tables.on(table, part, "robust-closed")
    assert costs is not None
    return Fraction(costs.inertial)
