"""What `sched-sim sweep` says of its rows."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sched_sim.cli.output import Format, lines, print_csv, print_json, print_table, say
from sched_sim.cli.parts import HIGHEST_HR_HZ, TASKS_ON_PARTS, WORDS

if TYPE_CHECKING:
    from sched_sim.costs.table import CostTable
    from studies.sweep.accuracy import OutputAccuracy
    from studies.sweep.run import Outcome, Sweep
    from studies.sweep.store import Store

SHOWN = 20
"""Rows of the table of best designs that people see; JSON and CSV have them all."""


def say_of_sizes(states: int, tables: Sequence[CostTable]) -> None:
    """Whether the costs are of a filter of another size than the model."""
    for table in tables:
        counted = table.provenance.get("states")
        if counted not in (None, states):
            say(
                f"Note: the costs of {table.name} are of {counted} states, and --model has {states}: give --costs of "
                f"its size, as `sched-sim measure --backend counted` writes them"
            )


def say_of_no_accuracy(accuracy: OutputAccuracy, methods: Sequence[str]) -> None:
    """Why there are methods whose accuracy is left empty."""
    from studies.selection.methods import by_reason

    for words in by_reason((method, accuracy.lacks(method)) for method in methods):
        say(f"Note: worst_std and rms_std are empty of {words}")


def report(asked: Sweep, store: Store, outcome: Outcome, exports: Sequence[Path], format: Format) -> None:
    from sched_sim.cli.caveats import caveat_note
    from sched_sim.cli.less_work import offsets_note
    from sched_sim.cli.measured_note import busy_row
    from sched_sim.cli.update_form import form_note
    from sched_sim.costs.table import busy_note
    from studies.sweep.summary import best, by_method

    tables = asked.grid.tables
    left = [method for method in asked.grid.methods if method not in asked.grid.refused]
    designs, methods = best(store), by_method(store)
    if format != "table":
        busy = {table.name: busy_row(table.provenance) for table in tables}
        designs, methods = ([row | busy[row["costs"]] for row in rows] for rows in (designs, methods))
    if format == "csv":
        print_csv(designs)
        return
    if format == "json":
        print_json(
            {
                "points": asked.grid.size,
                "left_out": asked.grid.left_out,
                "computed": outcome.computed,
                "results": str(store.path),
                "exports": [str(file) for file in exports],
                "update_form": {table.name: form for table in tables if (form := table.update_form)},
                "structure": {table.name: structure for table in tables if (structure := table.structure)},
                "methods": methods,
                "best": designs,
            }
        )
        return
    left_out = f", {asked.grid.left_out} combinations left out as not legal" if asked.grid.left_out else ""
    before = f" ({outcome.before} of them were there before)" if outcome.before else ""
    several, in_seconds = len(tables) > 1, all(table.unit == "second" for table in tables)
    notes = {lines(form_note(table, left), busy_note(table.provenance)): table.name for table in tables}
    accuracy = asked.grid.accuracy is not None and not exports
    forms = [note if len(notes) == 1 else f"{name}: {note}" for note, name in notes.items() if note]
    print_table(
        f"{asked.grid.size} points{before}{left_out}", [_for_people(row, several, in_seconds) for row in methods]
    )
    more = f"; the first {SHOWN} of {len(designs)} (all: --format json or csv)" if len(designs) > SHOWN else ""
    print_table(
        f"Slowest processor that will do, for each N and M{more}",
        [_for_people(row, several, in_seconds) for row in designs[:SHOWN]],
        note=lines(
            "All rows: " + ", ".join(str(file) for file in (store.path, *exports)),
            "worst_std and rms_std of each design are in these rows; --export FILE.csv writes them" if accuracy else "",
            TASKS_ON_PARTS if asked.grid.tasks and len({table.processor for table in tables}) > 1 else "",
            caveat_note(left),
            offsets_note(left, asked.grid.tasks),
            *forms,
        ),
    )


HEADINGS = {
    "feasible": "meet all deadlines",
    "lowest_min_speed": "least speed from",
    "highest_min_speed": "to",
    "min_speed": "least speed",
    "min_speed_exact": "exactly",
    "highest_hr_hz": f"{HIGHEST_HR_HZ}, same N, M, L",
    "binding": "fixed by",
}


FORMATS = {"highest_hr_hz": WORDS[HIGHEST_HR_HZ][1]}


def _for_people(row: dict[str, Any], several_tables: bool, in_seconds: bool) -> dict[str, Any]:
    """Without what the title or the name of the cost table says; seconds per HR period as microseconds."""
    left_out = {"processor" if several_tables else "costs", *(["min_speed_exact"] if in_seconds else [])}
    shown = {}
    for key, value in row.items():
        heading = HEADINGS.get(key, key.replace("_", " "))
        if in_seconds and key in ("lowest_min_speed", "highest_min_speed", "min_speed"):
            heading, value = f"{heading}, us", 1e6 * value
        if key not in left_out:
            shown[heading] = FORMATS.get(key, "{:.6g}".format)(value) if isinstance(value, float) else value
    return shown
