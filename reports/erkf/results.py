"""What the report on the robust filter asks of the studies that depend on the machine: stored, and read back.

Times do so plainly. Results of a simulation do in their last digits, and how far two ways of solving a system differ is
nothing but last digits. Both are written beside the report with few digits, and the report is made from these files.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.systems.drive import FIX_EVERY, simulate_cargo_drive
from reports.erkf.stability import stability_tables
from reports.pages.stored import Rows, digits, read_tables, rows_of, table_files
from reports.pages.stored import columns as columns_of
from reports.pages.stored import records as records_of
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import costs_text, read_costs
from studies.machines.store import beside, kept
from studies.robust import drive
from studies.robust import singular_values as singular
from studies.robust.costs import SYSTEMS, SystemName, robust_costs

Progress = Callable[[int, int, str], None]

SEED = 0
"""The drive that the figures show; the tables are of all `drive.SEEDS`."""

SHOWN = {"EKF": (drive.EKF, drive.POSITION_EKF), "ERKF": (drive.MORE_ROBUST, drive.POSITION_ROBUST)}
"""For the figures: an attitude and a position method of each."""

AXES = ("north", "east", "up")
ANGLES = ("roll", "pitch", "yaw")
CURVES = (singular.CASES[2], singular.CASES[4])
"""The filters that Figs. 7 and 8 are drawn of: attitude and position, each with a finite mu."""
TABLES = (
    *("attitude", "position", "raw", "agreement", "singular-values", "drive", "close-up"),
    *("linear", "linear-curves", "linear-sample"),
)


class Results(NamedTuple):
    """measured: seconds of the compiled code by system. tables: by name, as in `TABLES`; the first row is a heading.
    stored: what was measured before, or on other machines."""

    measured: Mapping[SystemName, CostTable]
    tables: Mapping[str, Rows]
    stored: Mapping[SystemName, Sequence[CostTable]] = {}

    @property
    def measurements(self) -> dict[SystemName, tuple[CostTable, ...]]:
        """All that there are, by system."""
        return {name: beside(table, self.stored.get(name, ())) for name, table in self.measured.items()}

    def columns(self, name: str) -> dict[str, FloatArray]:
        """A table of numbers; nan where a cell is empty."""
        return columns_of(self.tables[name])

    def records(self, name: str) -> list[dict[str, str]]:
        """The rows of a table by their heading."""
        return records_of(self.tables[name])

    def files(self) -> dict[str, bytes]:
        """What `read` reads."""
        return {
            **{f"measured-{name}.toml": costs_text(table).encode() for name, table in self.measured.items()},
            **table_files(self.tables),
        }


def read(folder: Path) -> Results:
    """The results that a report in `folder` was made from, beside all measurements that are kept."""
    measured: dict[SystemName, CostTable] = {name: read_costs(folder / f"measured-{name}.toml") for name in SYSTEMS}
    return Results(measured, read_tables(folder, TABLES), _stored())


def results(thorough: bool = False, progress: Progress = lambda _done, _total, _what: None) -> Results:
    """Times the code and runs the studies: about ten minutes."""
    measured: dict[SystemName, CostTable] = {}
    for done, name in enumerate(SYSTEMS):
        progress(done, len(SYSTEMS), f"timing, {name}")
        measured[name] = robust_costs(name, "compiled", thorough=thorough)
    return Results(measured, simulated(progress), _stored())


def _stored() -> dict[SystemName, tuple[CostTable, ...]]:
    return {name: kept(f"erkf-{name}") for name in SYSTEMS}


def simulated(progress: Progress = lambda _done, _total, _what: None) -> dict[str, Rows]:
    """All tables: none depends on times."""
    errors = drive.SCALE_ERRORS
    asked = [(method, error) for error in errors for method in drive.ATTITUDE_METHODS]
    asked_position = [(method, scales) for scales in drive.POSITION_ERRORS for method in drive.POSITION_METHODS]
    total = len(asked) + len(asked_position) + len(singular.CASES) + 2
    done = 0

    def tell(what: str) -> None:
        nonlocal done
        progress(done, total, what)
        done += 1

    attitude: Rows = [[*_ATTITUDE]]
    for of_attitude, error in asked:
        tell(f"attitude, {of_attitude.name}")
        attitude.append(_attitude_row(drive.attitude_result(of_attitude, error)))
    position: Rows = [[*_POSITION]]
    for of_position, scales in asked_position:
        tell(f"position, {of_position.name}")
        position.append(_position_row(drive.position_result(of_position, scales)))
    raw = drive.raw_result()
    agreement: Rows = [[*_AGREEMENT]]
    curves: dict[str, FloatArray] = {}
    for case in singular.CASES:
        tell(f"singular values, {case.name}")
        compared = singular.compare(case)
        agreement += [_agreement_row(figures) for figures in compared.agreements]
        if case in CURVES:
            curves |= _curves(case, compared)
    tell("the drive of the figures")
    course, close_up = _drives()
    tell("linear systems")
    linear = stability_tables()
    progress(total, total, "done")
    return {
        "attitude": attitude,
        "position": position,
        "raw": [
            ["imu_yaw_deg", "gps_yaw_deg", *_of("gps", "m"), *_of("held", "m")],
            [digits(value) for value in (raw.imu_yaw_deg, raw.gps_yaw_deg, *raw.gps_m, *raw.held_m)],
        ],
        "agreement": agreement,
        "singular-values": rows_of(curves, "{:.4g}"),
        "drive": rows_of(course, "{:.3f}"),
        "close-up": rows_of(close_up, "{:.4f}"),
        **linear,
    }


# -------------------------------------------------------------------------------------------------------- as tables


def _of(what: str, unit: str) -> list[str]:
    return [f"{what}_{axis}_{unit}" for axis in ("north", "east", "down")]


_OF_ATTITUDE = ("roll_deg", "pitch_deg", "yaw_deg", "gps_deg", "imu_deg", "outage_deg")
_ATTITUDE = ("scale_error", "method", *_OF_ATTITUDE, *(f"{name} se" for name in _OF_ATTITUDE))
_POSITION = (
    *("scale_error", "accelerometer_error", "method"),
    *_of("fix", "m"), *_of("between", "m"), *_of("velocity", "m_s"), *_of("outage", "m"),
    "outage_end_m", *(f"{name} se" for name in (*_of("between", "m"), "outage_end_m")),
)  # fmt: skip
_AGREEMENT = ("case", "way", "largest", "smallest", "relative_largest", "relative_smallest", "state", "fails_in_step")


def _attitude_row(result: drive.AttitudeResult) -> list[Any]:
    others = (result.yaw_from_gps_deg, result.yaw_from_imu_deg, result.outage_yaw_deg)
    return [
        result.scale_error,
        result.method,
        *(digits(value) for value in (*result.errors_deg, *others, *result.standard_errors_deg)),
    ]


def _position_row(result: drive.PositionResult) -> list[Any]:
    errors = (*result.between_standard_error_m, result.outage_end_standard_error_m)
    values = (
        *(*result.after_fix_m, *result.between_m, *result.between_velocity, *result.outage_m),
        *(result.outage_end_m, *errors),
    )
    scales = result.scale_error, result.accelerometer_error
    return [*scales, result.method, *(digits(value) for value in values)]


def _agreement_row(agreement: singular.Agreement) -> list[Any]:
    values = (
        agreement.absolute_largest,
        agreement.absolute_smallest,
        agreement.relative_largest,
        agreement.relative_smallest,
    )
    failure = "" if agreement.first_failure is None else agreement.first_failure
    return [agreement.case.name, agreement.way, *(f"{value:.2g}" for value in (*values, agreement.state)), failure]


def _curves(case: singular.Case, compared: singular.Comparison) -> dict[str, FloatArray]:
    """The inverse's, and what the others differ by."""
    name = case.name.partition(",")[0]
    reference = compared.curves[0]
    columns = {"time_s": reference.time_s, f"{name} largest": reference.largest, f"{name} smallest": reference.smallest}
    for curve in compared.curves[1:]:
        columns[f"{name} largest {curve.way}"] = np.abs(curve.largest - reference.largest)
        columns[f"{name} smallest {curve.way}"] = np.abs(curve.smallest - reference.smallest)
    return columns


def _drives() -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Every 40th step of a drive, at the fixes: measurements, truth and, for each scale error and filter, estimates
    and errors; and one second of it in every step."""
    course: dict[str, FloatArray] = {}
    close_up: dict[str, FloatArray] = {}
    for error, (name, (of_attitude, of_position)) in product(drive.SCALE_ERRORS, SHOWN.items()):
        driven = simulate_cargo_drive(scale_error=error, seed=SEED)
        attitudes = drive.estimate_attitude(driven, of_attitude)
        positions = drive.estimate_position(driven, drive.estimate_attitude(driven, of_position.attitude), of_position)
        figures = drive.figures(driven, attitudes, positions)
        percent = f"{100 * error:g} %"
        at_fix = slice(0, len(figures.time_s) - 1, FIX_EVERY)
        course |= {
            "time_s": figures.time_s[at_fix],
            **_split("true", AXES, figures.true_route_m[at_fix]),
            **_split("gps", AXES, figures.gps_route_m),
            **_split("true", ANGLES, figures.true_attitude_deg[at_fix]),
            **_split("imu", ANGLES, figures.imu_attitude_deg[::FIX_EVERY]),
            "gps yaw": figures.gps_yaw_deg,
            **_split(f"{name} {percent}", AXES, figures.route_m[at_fix]),
            **_split(f"{name} {percent}", ANGLES, figures.attitude_deg[at_fix]),
        }
        shown = figures.close_up
        close_up |= {
            "time_s": figures.time_s[shown],
            **_split("true", AXES, figures.true_route_m[shown]),
            **_split(f"{name} {percent}", AXES, figures.route_m[shown]),
        }
    return course, close_up


def _split(what: str, names: tuple[str, ...], values: FloatArray) -> dict[str, FloatArray]:
    return {f"{what} {name}": values[:, number] for number, name in enumerate(names)}
