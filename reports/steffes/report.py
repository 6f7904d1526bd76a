"""The report on Steffes (2014): its tables, figures, equations and claims, printed, analysed, counted and measured."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from reports.charts.bar_rows import bar_rows
from reports.charts.panels import Panel
from reports.pages.machine import legend, marked, timed_on
from reports.pages.measurements import who_measured
from reports.pages.pictures import Annotated, Sliding, files, pictures
from reports.pages.render import csv_bytes, render
from reports.pages.stored import Rows
from reports.steffes import rows, said
from reports.steffes.advantage import about_advantage, heavier_rows, needed_rows
from reports.steffes.agreement import agreement_figure
from reports.steffes.answer import answer_figure, answer_rows
from reports.steffes.comparisons import cost_figure, cost_rows
from reports.steffes.figures import achieved_figure, least_speed_figure
from reports.steffes.noise import noise_figure
from reports.steffes.processors import landings, processors_figure, switched, switches_figure, variants
from reports.steffes.products import products_figure
from reports.steffes.said import FIGURE_3
from reports.steffes.sliding import SPEEDS, frames_over_l, frames_over_speed
from reports.steffes.table4 import Speeds, table4_figure
from reports.steffes.timelines import dual_rate_panel, dual_rate_timeline, serial_costs, serial_panel, serial_timeline
from reports.steffes.waiting import waited, waiting_figure
from sched_sim.costs.methods import PAPER_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import costs_text, load_costs
from sched_sim.design.least_speed import least_speed
from studies.machines.store import beside
from studies.steffes import tables as steffes
from studies.steffes.advantage import by_rate, heavier, needed
from studies.steffes.agreement import agreement
from studies.steffes.memory import memory
from studies.steffes.noise import approximations
from studies.steffes.products import multiplies

TITLE = "Steffes 2014, regenerated: which processor a delayed-measurement Kalman filter needs"

AT_L, AT_SPEED = FIGURE_3.L - FIGURE_3.M - 1, SPEEDS.index(Fraction(4, 5))
"""Which schedules are shown first: that of Fig. 3, and the slowest of several that lands as early."""
UPDATED_BY = (FIGURE_3.M + 1, FIGURE_3.L, FIGURE_3.N)


def build(measured: CostTable, stored: Sequence[CostTable] = ()) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of a measured cost table, and of those measured before or on
    other machines."""
    paper = load_costs("steffes2014")
    tables = {"printed": paper, "counted": load_costs("counted-9-3-3").normalised(), "measured": measured.normalised()}
    every = [table.normalised() for table in beside(measured, stored)]
    cells, waits = steffes.cells(paper), waited(paper)
    agreed, noises, counted = agreement(FIGURE_3), approximations(), multiplies()
    kept = [memory(method) for method in ("larsen", "dual-rate")]
    others, updates = needed(tables["counted"], FIGURE_3), heavier(paper, FIGURE_3, UPDATED_BY)
    on, switches = variants(tables["counted"], FIGURE_3), switched(paper, FIGURE_3)
    panels, (N, M) = _panels(paper), rows.STAIRS[0]
    over_l = frames_over_l(paper, FIGURE_3.N, FIGURE_3.M)
    speeds: dict[str, Fraction] = {method: rows.least(paper, method, FIGURE_3) for method in PAPER_METHODS}
    landed = landings(tables["counted"], FIGURE_3)
    shown: dict[str, Rows] = {
        "tables-1-3": rows.entries(tables["counted"], every),
        "table-4": rows.table4(tables["counted"], every, tables["measured"], cells),
        "answer": answer_rows(speeds, FIGURE_3),
        "costs": cost_rows(tables, every),
        "measurements": rows.measurements(every, FIGURE_3),
        "simulated": rows.simulated(paper),
        "propagate-by": rows.propagate_by(paper),
        "stairs": rows.stairs(paper),
        "agreement": rows.agreement(agreed),
        "products": rows.products(counted),
        "memory": rows.memory(kept),
        "waiting": rows.waiting(waits),
        "other-methods": needed_rows(others),
        "heavier-updates": heavier_rows(updates),
        "processors": rows.processors(on),
        "landings": rows.landings(landed),
        "switches": rows.switches(switches),
        "noise": rows.noise(noises),
        **{name: bar_rows(of) for name, of in {**panels, "fig3": over_l[AT_L].panels}.items()},
    }
    figures = pictures(
        {
            "answer.svg": answer_figure(speeds, FIGURE_3),
            "fig3.svg": Sliding("L asked for", over_l, at=AT_L),
            "costs.svg": cost_figure(tables, every),
            "table4.svg": table4_figure(_speeds(tables, every, cells)),
            "fig1.svg": Annotated(serial_timeline(paper, FIGURE_3, _serial_speed(paper)), panels["fig1"]),
            "fig2.svg": Annotated(
                dual_rate_timeline(paper, FIGURE_3, rows.least(paper, "dual-rate", FIGURE_3)), panels["fig2"]
            ),
            "agreement.svg": agreement_figure(agreed),
            "products.svg": products_figure(counted),
            "waiting.svg": waiting_figure(paper),
            "least-speed.svg": least_speed_figure(paper, rows.STAIRS),
            "achieved-l.svg": Sliding(
                "speed", frames_over_speed(paper, N, M), at=AT_SPEED, figure=achieved_figure(paper, rows.STAIRS)
            ),
            "processors.svg": processors_figure(landed, FIGURE_3),
            "switches.svg": switches_figure(switches),
            "noise.svg": noise_figure(noises),
        }
    )
    pages = render(
        "steffes2014",
        TITLE,
        figures,
        legend=legend(timed_on(measured.provenance)),
        who_measured=who_measured(every),
        form=measured.provenance["update_form"],
        table=said.about_tables(tables, every, cells),
        not_reached=said.not_reached(paper, cells),
        serial=said.about_serial(paper),
        wait=said.about_waiting(paper, waits),
        agreed=said.about_agreement(agreed),
        product=said.about_products(counted, kept),
        work=said.about_work(tables),
        advantage=about_advantage(others, updates, by_rate(paper, FIGURE_3), FIGURE_3.L),
        on=said.about_processors(on, landed, switches),
        noise=said.about_noise(noises, tables),
        by=said.about_deadlines(paper),
        equations=said.equations(),
        rows={
            name.replace("-", "_"): rows.on_page(of)
            for name, of in {**shown, "table-4": rows.without(shown["table-4"], "exactly", marked(rows.HERE))}.items()
        },
    )
    return {
        **pages,
        **files(figures),
        "measured.toml": costs_text(measured).encode(),
        **{f"{name}.csv": csv_bytes(of) for name, of in shown.items()},
    }


def _serial_speed(paper: CostTable) -> Fraction:
    return least_speed(serial_costs(paper), FIGURE_3).speed


def _panels(paper: CostTable) -> dict[str, list[Panel]]:
    """Figs 1 and 2, each filter at its own least speed."""
    return {
        "fig1": [serial_panel(paper, FIGURE_3, _serial_speed(paper))],
        "fig2": [dual_rate_panel(paper, FIGURE_3, rows.least(paper, "dual-rate", FIGURE_3))],
    }


def _speeds(tables: dict[str, CostTable], measured: Sequence[CostTable], cells: Sequence[steffes.Cell]) -> list[Speeds]:
    """Table 4 with what each number is uncertain by."""
    found = []
    for cell in cells:
        low, high = rows.over(measured, cell.method, cell.timing)
        found.append(
            Speeds(
                cell.timing,
                cell.method,
                {
                    "printed": float(cell.printed),
                    "analysis": float(cell.computed.speed),
                    **{
                        name: float(rows.least(tables[name], cell.method, cell.timing))
                        for name in ("counted", "measured")
                    },
                },
                {
                    "printed": (float(cell.printed - steffes.HALF_UNIT), float(cell.printed + steffes.HALF_UNIT)),
                    "analysis": (float(cell.lowest), float(cell.highest)),
                    "measured": (float(low), float(high)),
                },
                "" if cell.reached else "not reached",
            )
        )
    return found
