"""Figures 1 and 2 of the paper, drawn: the vehicle and what its inertial unit reads, and the scheme of the filters."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from reports.drawing.style import INK, PALE, SMALL_PT, TITLE_PT, drawing
from reports.erkf.boxes import Box, Point, draw_arrow, draw_box, draw_sign, sheet

FILTER, SENSOR = "#dfe8f0", "#f1f1f1"


def imu_figure() -> Figure:
    """Left, the vehicle and its axes; right, what the inertial unit makes of turn rates and accelerations."""
    with drawing():
        figure, axes = sheet(66.0)
        _vehicle(axes, 4.0, 16.0)
        axes.text(4, 4, "The vehicle, its axes and angles", size=TITLE_PT, va="center")
        axes.text(66, 4, "What its inertial unit reads", size=TITLE_PT, va="center")
        _channel(
            axes, 18.0, "turn rates\n$p$, $q$, $r$", "$\\delta_g$", "$b_g$", "$\\eta_g$", "gyros read\n$\\omega_m$"
        )
        _channel(
            axes, 40.0, "acceleration\nless gravity", "$\\delta_a$", "$b_a$", "$\\eta_a$",
            "accelerometers\nread $f_m$",
        )  # fmt: skip
        angles = Box(80, 58, 24, 9, "roll, pitch, yaw\n$\\phi$, $\\theta$, $\\psi$", SENSOR)
        seen = Box(153, 58, 29, 9, "unit's own angles\n400 Hz", SENSOR)
        for box in (angles, seen):
            draw_box(axes, box)
        draw_sign(axes, (116, 58), "+")
        draw_arrow(axes, [angles.right, (113.8, 58)])
        draw_arrow(axes, [(118.2, 58), seen.left])
        draw_arrow(axes, [(116, 50.5), (116, 55.8)])
        axes.text(116, 49.8, "noise; yaw drifts", size=SMALL_PT, ha="center", va="bottom")
        return figure


def _channel(axes: Axes, y: float, true: str, wrong: str, bias: str, noise: str, read: str) -> None:
    """True values times 1 + wrong, plus a bias and noise."""
    source, sink = Box(80, y, 24, 9, true, SENSOR), Box(153, y, 29, 9, read, SENSOR)
    for box in (source, sink):
        draw_box(axes, box)
    signs = ((101.0, "×", f"$1 + $scale {wrong}"), (116.0, "+", f"bias {bias}"), (130.0, "+", f"noise {noise}"))
    last = source.right
    for x, sign, text in signs:
        draw_sign(axes, (x, y), sign)
        draw_arrow(axes, [last, (x - 2.2, y)])
        draw_arrow(axes, [(x, y - 7.5), (x, y - 2.2)])
        axes.text(x, y - 8.2, text, size=SMALL_PT, ha="center", va="bottom")
        last = (x + 2.2, y)
    draw_arrow(axes, [last, sink.left])


def _vehicle(axes: Axes, left: float, top: float) -> None:
    """From the side, driving to the right, with x ahead, y towards the right side and z down."""
    ground = top + 25.0
    axes.plot([left, left + 52], [ground, ground], color=PALE, lw=1.0)
    axes.add_patch(Rectangle((left + 2, top + 4), 29, 15, facecolor=SENSOR, edgecolor=INK, lw=0.9))
    cab = [(31.5, 19), (31.5, 7), (38, 7), (42, 13), (42, 19)]
    axes.add_patch(
        Polygon([(left + x, top + y) for x, y in cab], closed=True, facecolor="white", edgecolor=INK, lw=0.9)
    )
    axes.plot([left + 2, left + 42], [top + 20.4] * 2, color=INK, lw=1.6)
    for x in (8.0, 14.5, 36.5):
        axes.add_patch(Circle((left + x, ground - 3.0), 3.0, facecolor="white", edgecolor=INK, lw=0.9, zorder=3))
    unit: Point = (left + 17, top + 11.5)
    axes.add_patch(Rectangle((unit[0] - 2, unit[1] - 2), 4, 4, facecolor=INK, edgecolor=INK, zorder=4))
    axes.text(unit[0] - 3.2, unit[1], "IMU", size=SMALL_PT, ha="right", va="center")
    draw_arrow(axes, [unit, (left + 52, unit[1])])
    draw_arrow(axes, [unit, (unit[0], ground + 8)])
    axes.add_patch(Circle((unit[0], unit[1] - 6.6), 1.3, facecolor="white", edgecolor=INK, lw=0.8, zorder=4))
    axes.text(*(unit[0], unit[1] - 6.6), "×", size=SMALL_PT, ha="center", va="center_baseline", zorder=5)
    axes.plot([unit[0]] * 2, [unit[1] - 2, unit[1] - 5.3], color=INK, lw=0.8)
    axes.text(unit[0] + 5, unit[1] - 9.6, "$y$: pitch $\\theta$, rate $q$", size=SMALL_PT, ha="right", va="bottom")
    axes.text(left + 53, unit[1] - 1.5, "$x$: roll $\\phi$,\nrate $p$", size=SMALL_PT, ha="right", va="bottom")
    axes.text(unit[0] + 2, ground + 6, "$z$: yaw $\\psi$, rate $r$", size=SMALL_PT, va="center")
    axes.add_patch(Circle((left + 27, top + 3.0), 1.0, facecolor=INK, edgecolor=INK))
    axes.text(left + 29, top + 1.2, "GPS", size=SMALL_PT, va="center")


def filters_figure() -> Figure:
    """What the two filters take from the sensors and from one another."""
    with drawing():
        figure, axes = sheet(70.0)
        imu = Box(17, 20, 28, 22, "IMU, 400 Hz\nturn rates,\naccelerations,\nangles", SENSOR)
        gps = Box(17, 54, 28, 18, "GPS, 10 Hz\nyaw, position,\nvelocity", SENSOR)
        yaw = Box(64, 54 - 5, 26, 8, "$\\psi_e = \\psi_{GPS} - \\psi_{IMU}$")
        attitude = Box(105, 16, 46, 16, "attitude filter\n(6 states, 3 measurements)\nin each step", FILTER)
        position = Box(
            121, 51, 48, 18, "position filter\n(9 states, 6 measurements)\nwithout a fix: propagates", FILTER
        )
        for box in (imu, gps, yaw, attitude, position):
            draw_box(axes, box)
        draw_arrow(axes, [(31, 13), (82, 13)], "turn rates $\\omega_m$; roll and pitch")
        draw_arrow(axes, [(31, 24), (58, 24), (58, 45)], "yaw $\\psi_{IMU}$")
        draw_arrow(axes, [(31, 49), yaw.left], "yaw")
        draw_arrow(axes, [(70, 45), (70, 20), (82, 20)], "held until\nthe next fix", at=0)
        draw_arrow(axes, [(31, 57), (97, 57)], "position and velocity, at fixes", below=True)
        draw_arrow(axes, [(31, 29), (45, 29), (45, 38), (124, 38), (124, 42)], "accelerations $f_m$", below=True, at=2)
        draw_arrow(axes, [(128, 16), (134, 16), (134, 42)], "roll, pitch, yaw", at=1)
        draw_arrow(axes, [(134, 16), (168, 16)], "attitude, 400 Hz", at=0)
        draw_arrow(axes, [position.right, (168, 51)], "position and\nvelocity, 400 Hz", at=0)
        return figure
