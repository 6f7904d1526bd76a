"""Figures 5 and 6 of the paper on a simulated drive, attitude and position; and the errors, which the paper's own drive
could not show."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from filters.arrays import FloatArray
from filters.systems.drive import wrap
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.legend import SWATCH_MM, Entry, draw_legend, legend_height, line_entry
from reports.drawing.style import INK, PALE, TITLE_PT, WIDTH_MM, axes_at, drawing, page
from reports.erkf.styles import FILTERS, GPS, IMU, TRUE, WIDTHS

Columns = Mapping[str, FloatArray]

LEFT_MM, RIGHT_MM, GAP_MM, BETWEEN_MM, ROW_MM = 15.0, 4.0, 14.0, 3.0, 23.0
WINDOW = 50
"""Samples of which an error is the root mean square: 5 s."""
ANGLES, AXES = ("roll", "pitch", "yaw"), ("north", "east", "up")


def attitude_figure(drive: Columns, error: str) -> Figure:
    """Roll, pitch and yaw by both filters, by the inertial unit and, yaw, by GPS; at the foot, how wrong yaw is."""
    with drawing():
        legend = [
            line_entry("true", TRUE),
            line_entry("GPS", GPS, dashes=False),
            line_entry("IMU", IMU),
            *map(filter_entry, FILTERS),
        ]
        figure, rows = _stack(4, legend)
        time_s = drive["time_s"]
        for axes, angle in zip(rows, ANGLES, strict=False):
            truth = drive[f"true {angle}"]
            shown = {name: drive[f"{name} {error} {angle}"] for name in FILTERS}
            of_imu = _near(drive[f"imu {angle}"], truth)
            axes.plot(time_s, of_imu, color=IMU.colour, lw=1.0 if angle == "yaw" else 0.3, label="IMU")
            for name, values in shown.items():
                axes.plot(time_s, _near(values, truth), color=FILTERS[name].colour, lw=WIDTHS[name], label=name)
            axes.plot(time_s, _turned(truth), color=INK, lw=0.6, label="true")
            if angle == "yaw":
                seen = _near(drive["gps yaw"], truth)
                axes.plot(time_s[::20], seen[::20], GPS.marker, color=GPS.colour, ms=6.5, mew=0, label="GPS")
            style_axes(axes, "", "", f"{angle} (deg)")
        _yaw_error(rows[-1], drive, error)
        return figure


def _yaw_error(axes: Axes, drive: Columns, error: str) -> None:
    """What yaw is wrong by, in the measurements and in the estimates."""
    time_s, truth = drive["time_s"], drive["true yaw"]
    seen = wrapped_deg(drive["gps yaw"] - truth)[::2]
    axes.axhline(0.0, color=INK, lw=0.6)
    axes.plot(time_s[::2], seen, GPS.marker, color=GPS.colour, ms=3.4, mew=0)
    axes.plot(time_s, wrapped_deg(drive["imu yaw"] - truth), color=IMU.colour, lw=0.5, label="IMU")
    for name, line in FILTERS.items():
        axes.plot(
            time_s, wrapped_deg(drive[f"{name} {error} yaw"] - truth), color=line.colour, lw=WIDTHS[name], label=name
        )
    style_axes(axes, "", "time (s)", "yaw, error (deg)")


def position_figure(drive: Columns, error: str) -> Figure:
    """North, east and up: the estimates less the truth, with the fixes less the truth behind them."""
    with drawing():
        legend = [
            line_entry("GPS", GPS, dashes=False),
            *map(filter_entry, FILTERS),
        ]
        figure, rows = _stack(3, legend)
        for axes, side in zip(rows, AXES, strict=True):
            truth = drive[f"true {side}"]
            axes.axhline(0.0, color=INK, lw=0.6)
            seen = (drive[f"gps {side}"] - truth)[::2]
            axes.plot(drive["time_s"][::2], seen, GPS.marker, color=GPS.colour, ms=3.4, mew=0)
            for name, line in FILTERS.items():
                off = drive[f"{name} {error} {side}"] - truth
                axes.plot(drive["time_s"], off, color=line.colour, lw=WIDTHS[name], label=name)
            style_axes(axes, "", "time (s)" if axes is rows[-1] else "", f"{side}, error (m)")
        return figure


def errors_figure(drive: Columns, errors: Sequence[str]) -> Figure:
    """Errors of roll, pitch and yaw, root mean squares of 5 s, a column for each scale error."""
    with drawing():
        legend = [line_entry(name, line) for name, line in FILTERS.items()]
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
                for name, line in FILTERS.items():
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
                style_axes(axes, title, "time (s)" if row == 2 else "", f"{angle}, error (deg)" if column == 0 else "")
                axes.tick_params(axis="x", labelbottom=row == 2)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def filter_entry(name: str, text: str = "") -> Entry:
    """Of the legend of a figure in which the filters lie on one another: as wide as they are drawn."""
    width = SWATCH_MM + 2.5

    def draw(axes: Axes, x: float, y: float) -> None:
        axes.plot([x, x + width], [y, y], color=FILTERS[name].colour, lw=WIDTHS[name], solid_capstyle="butt")

    return Entry(text or name, width, draw)


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


def style_axes(axes: Axes, title: str, across: str, up: str) -> None:
    if title:
        axes.set_title(title, loc="left", size=TITLE_PT)
    axes.set_xlabel(across, labelpad=2)
    axes.set_ylabel(up, labelpad=2)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
    axes.grid(axis="y", color=PALE, lw=0.5)
    plain(axes)
