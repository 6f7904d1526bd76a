"""What is shown: Gantt charts, figures and the rendered reports."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sched_sim.lazy import lazily

if TYPE_CHECKING:
    from reports.charts.chart import gantt
    from reports.charts.panels import method_panel
    from reports.drawing.picture import save
    from reports.explorer.widget import Explorer
    from reports.scenario.panel import scenario_panel

__all__ = [
    "Explorer",
    "gantt",
    "method_panel",
    "save",
    "scenario_panel",
]

__getattr__, __dir__ = lazily(
    __name__,
    {
        "reports.charts.chart": "gantt",
        "reports.charts.panels": "method_panel",
        "reports.drawing.picture": "save",
        "reports.explorer.widget": "Explorer",
        "reports.scenario.panel": "scenario_panel",
    },
)
