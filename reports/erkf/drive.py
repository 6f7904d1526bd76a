"""Figures 3 to 6 of the paper on a simulated drive: the route, the time between fixes, attitude and position; and the
errors, which the paper's own drive could not show."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from filters.arrays import FloatArray
from filters.systems.drive import wrap
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.legend import Entry, draw_legend, legend_height, line_entry
from reports.drawing.style import INK, PALE, SOURCE_LINES, TITLE_PT, WIDTH_MM, Line, axes_at, drawing, page

Columns = Mapping[str, FloatArray]

LEFT_MM, RIGHT_MM, GAP_MM, BETWEEN_MM, ROW_MM = 15.0, 4.0, 14.0, 4.0, 34.0
TRUE = Line(INK, "-", "")
GPS = Line("#9bb8cf", (0, (1.0, 1.2)), ".", 3.0)
IMU = Line("#2e7d4f", "-", "")
FILTERS = {"EKF": SOURCE_LINES[2]._replace(marker=""), "ERKF": SOURCE_LINES[1]._replace(marker="")}
WIDTHS = {"EKF": 2.4, "ERKF": 1.0}
"""The EKF lies under the ERKF, which it often cannot be told apart from, and is to be seen at both sides of it."""
MARKED = {"EKF": SOURCE_LINES[2], "ERKF": SOURCE_LINES[1]}
WINDOW = 50
"""Samples of which an error is the root mean square: 5 s."""
ANGLES, AXES = ("roll", "pitch", "yaw"), ("north", "east", "up")


def route_figure(drive: Columns, close_up: Columns, error: str) -> Figure:
    """Left, the route from above with its fixes; right, one second of it: along the way and across it.

    error: which scale error, as in the columns' names.
    """
    with drawing():
        width = (WIDTH_MM - LEFT_MM - RIGHT_MM - GAP_MM) / 2
        height = 2 * ROW_MM + BETWEEN_MM
        legend = [
            line_entry("true", TRUE),
            line_entry("GPS fixes, 10 Hz, held until the next", GPS._replace(size=5.0, dashes="-")),
            *(line_entry(f"{name}, 400 Hz", line) for name, line in FILTERS.items()),
        ]
        legend_top = EDGE_MM + TITLE_MM + height + AXIS_MM
        figure = page(legend_top + legend_height(legend, WIDTH_MM - LEFT_MM - RIGHT_MM) + EDGE_MM)
        route = axes_at(figure, LEFT_MM, EDGE_MM + TITLE_MM, width, height)
        route.plot(drive["gps east"], drive["gps north"], GPS.marker, color=GPS.colour, ms=2.0, mew=0)
        for name, line in FILTERS.items():
            route.plot(
                drive[f"{name} {error} east"], drive[f"{name} {error} north"], color=line.colour, lw=WIDTHS[name],
                label=name,
            )  # fmt: skip
        route.set_aspect("equal", adjustable="datalim")
        route.plot([drive["true east"][0]], [drive["true north"][0]], "o", ms=5, mfc="none", mec=INK, mew=0.9)
        _style(route, "The route", "east (m)", "north (m)")
        _close_up(figure, drive, close_up, error, LEFT_MM + width + GAP_MM, width)
        draw_legend(figure, legend, LEFT_MM, legend_top, WIDTH_MM - LEFT_MM - RIGHT_MM)
        return figure


def _close_up(figure: Figure, drive: Columns, close_up: Columns, error: str, left: float, width: float) -> None:
    time_s = close_up["time_s"]
    start = np.array([close_up["true north"][0], close_up["true east"][0]])
    way = np.array([close_up["true north"][-1], close_up["true east"][-1]]) - start
    way /= np.linalg.norm(way)
    sides = {"along the way (m)": way, "right of it (m)": np.array([-way[1], way[0]])}
    fixes = (drive["time_s"] >= time_s[0]) & (drive["time_s"] <= time_s[-1])

    def along(columns: Columns, what: str, side: FloatArray) -> FloatArray:
        there: FloatArray = (np.array([columns[f"{what} north"], columns[f"{what} east"]]).T - start) @ side
        return there

    for row, (name, side) in enumerate(sides.items()):
        axes = axes_at(figure, left, EDGE_MM + TITLE_MM + row * (ROW_MM + BETWEEN_MM), width, ROW_MM)
        axes.plot(time_s, along(close_up, "true", side), color=INK, lw=0.7, label="true")
        for of_filter, line in FILTERS.items():
            axes.plot(
                time_s, along(close_up, f"{of_filter} {error}", side), color=line.colour, lw=WIDTHS[of_filter],
                label=of_filter,
            )  # fmt: skip
        at, seen = drive["time_s"][fixes], along(drive, "gps", side)[fixes]
        axes.step(at, seen, where="post", color=GPS.colour, lw=0.7, zorder=1)
        axes.plot(at, seen, GPS.marker, color=GPS.colour, ms=6.0, mew=0)
        _style(axes, "One second, every 400 Hz step" if row == 0 else "", "time (s)" if row else "", name)
        axes.tick_params(axis="x", labelbottom=row == 1)


def attitude_figure(drive: Columns, error: str) -> Figure:
    """Roll, pitch and yaw of both filters; at the foot, how wrong yaw is in them, by GPS and by the inertial unit."""
    with drawing():
        legend = [
            line_entry("true", TRUE),
            line_entry("every second GPS yaw", GPS._replace(size=5.0), dashes=False),
            line_entry("IMU", IMU),
            *(line_entry(name, line) for name, line in FILTERS.items()),
        ]
        figure, rows = _stack(4, legend)
        time_s = drive["time_s"]
        for axes, angle in zip(rows, ANGLES, strict=False):
            truth = drive[f"true {angle}"]
            shown = {name: drive[f"{name} {error} {angle}"] for name in FILTERS}
            if angle != "yaw":
                axes.plot(time_s, drive[f"imu {angle}"], color="#b7cfbc", lw=0.4)
            for name, values in shown.items():
                axes.plot(time_s, _near(values, truth), color=FILTERS[name].colour, lw=WIDTHS[name], label=name)
            axes.plot(time_s, _turned(truth), color=INK, lw=0.6, label="true")
            _style(axes, "", "", f"{angle} (deg)")
        _yaw_error(rows[-1], drive, error)
        return figure


def _yaw_error(axes: Axes, drive: Columns, error: str) -> None:
    """What yaw is wrong by, in the measurements and in the estimates."""
    time_s, truth = drive["time_s"], drive["true yaw"]
    seen = wrapped_deg(drive["gps yaw"] - truth)[::2]
    axes.axhline(0.0, color=INK, lw=0.6)
    axes.plot(time_s[::2], seen, GPS.marker, color=GPS.colour, ms=2.6, mew=0)
    axes.plot(time_s, wrapped_deg(drive["imu yaw"] - truth), color=IMU.colour, lw=0.5)
    for name, line in FILTERS.items():
        axes.plot(time_s, wrapped_deg(drive[f"{name} {error} yaw"] - truth), color=line.colour, lw=0.8, label=name)
    _style(axes, "", "time (s)", "yaw, error (deg)")


def position_figure(drive: Columns, error: str) -> Figure:
    """North, east and up: the estimates less the truth, with the fixes less the truth behind them."""
    with drawing():
        legend = [
            line_entry("every second GPS fix", GPS._replace(size=5.0), dashes=False),
            *(line_entry(name, line) for name, line in FILTERS.items()),
        ]
        figure, rows = _stack(3, legend)
        for axes, side in zip(rows, AXES, strict=True):
            truth = drive[f"true {side}"]
            axes.axhline(0.0, color=INK, lw=0.6)
            seen = (drive[f"gps {side}"] - truth)[::2]
            axes.plot(drive["time_s"][::2], seen, GPS.marker, color=GPS.colour, ms=2.6, mew=0)
            for name, line in FILTERS.items():
                off = drive[f"{name} {error} {side}"] - truth
                axes.plot(drive["time_s"], off, color=line.colour, lw=WIDTHS[name], label=name)
            _style(axes, "", "time (s)" if axes is rows[-1] else "", f"{side}, error (m)")
        return figure


def errors_figure(drive: Columns, errors: Sequence[str]) -> Figure:
    """Errors of roll, pitch and yaw, root mean squares of 5 s, a column for each scale error."""
    with drawing():
        legend = [line_entry(name, line) for name, line in MARKED.items()]
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        width = (across - GAP_MM * (len(errors) - 1)) / len(errors)
        legend_top = EDGE_MM + TITLE_MM + 3 * ROW_MM + 2 * BETWEEN_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        time_s = drive["time_s"][WINDOW // 2 :: WINDOW]
        for row, angle in enumerate(ANGLES):
            rms = {
                (error, name): windowed_rms(wrapped_deg(drive[f"{name} {error} {angle}"] - drive[f"true {angle}"]))
                for error in errors
                for name in FILTERS
            }
            limit = 1.15 * max(float(values[1:].max()) for values in rms.values())
            for column, error in enumerate(errors):
                top = EDGE_MM + TITLE_MM + row * (ROW_MM + BETWEEN_MM)
                axes = axes_at(figure, LEFT_MM + column * (width + GAP_MM), top, width, ROW_MM)
                for name, line in MARKED.items():
                    shown = rms[error, name][1:]
                    axes.plot(
                        time_s[1:],
                        shown,
                        line.marker,
                        color=line.colour,
                        ms=line.size,
                        mew=0,
                        ls="-",
                        lw=0.8,
                        label=name,
                    )
                axes.set(xlim=(0, time_s[-1] + time_s[0]), ylim=(0, limit))
                title = f"Gyro scale wrong by {error}" if row == 0 else ""
                _style(axes, title, "time (s)" if row == 2 else "", f"{angle}, error (deg)" if column == 0 else "")
                axes.tick_params(axis="x", labelbottom=row == 2)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def windowed_rms(values: FloatArray) -> FloatArray:
    """One for each whole window of `WINDOW` samples."""
    whole = values[: len(values) // WINDOW * WINDOW].reshape(-1, WINDOW)
    root: FloatArray = np.sqrt((whole**2).mean(axis=1))
    return root


def wrapped_deg(angles: FloatArray) -> FloatArray:
    """In (-180, 180]."""
    return np.degrees(wrap(np.radians(angles)))


def _stack(count: int, legend: Sequence[Entry]) -> tuple[Figure, list[Axes]]:
    """Plots below one another, the same time across, and a legend."""
    across = WIDTH_MM - LEFT_MM - RIGHT_MM
    legend_top = EDGE_MM + count * ROW_MM + (count - 1) * BETWEEN_MM + AXIS_MM
    figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
    rows = [
        axes_at(figure, LEFT_MM, EDGE_MM + number * (ROW_MM + BETWEEN_MM), across, ROW_MM) for number in range(count)
    ]
    for axes in rows[:-1]:
        axes.tick_params(axis="x", labelbottom=False)
    draw_legend(figure, legend, LEFT_MM, legend_top, across)
    return figure, rows


def _turned(angles: FloatArray) -> FloatArray:
    return np.unwrap(angles, period=360.0)


def _near(angles: FloatArray, truth: FloatArray) -> FloatArray:
    """The same angles, without jumps where the truth has none."""
    return _turned(truth) + wrapped_deg(angles - truth)


def _style(axes: Axes, title: str, across: str, up: str) -> None:
    if title:
        axes.set_title(title, loc="left", size=TITLE_PT)
    axes.set_xlabel(across, labelpad=2)
    axes.set_ylabel(up, labelpad=2)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
    axes.grid(axis="y", color=PALE, lw=0.5)
    plain(axes)
