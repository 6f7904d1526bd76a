"""Tables as the page shows them: fewer columns than in the files, to fit on paper, and formulas with signs."""

from __future__ import annotations

import re
from itertools import groupby

from reports.multirate.tables import CYCLE_NAMES, Rows
from reports.multirate.words import formula_text

MINUS = "\N{MINUS SIGN}"
NO_BREAK = "\N{NO-BREAK SPACE}"


def cases(rows: Rows) -> Rows:
    """A line may not end between a number of seconds and its unit, nor after a sign."""
    return [[re.sub(r"(?<=\d) (?=s\b)|(?<=≥) ", NO_BREAK, str(cell)) for cell in row] for row in rows]


def systems(rows: Rows) -> Rows:
    """What stands below the heading of the first column on one line each, however narrow the page."""
    heading, *body = rows
    return [heading, *([_on_one_line(str(row[0])), *row[1:]] for row in body)]


def _on_one_line(text: str) -> str:
    return text.replace(" ", NO_BREAK)


def terms(rows: Rows) -> Rows:
    """Formulas with signs, each on one line; the cycle where it begins."""
    heading, *body = rows
    shown: Rows = [heading]
    for cycle, of_cycle in groupby(body, key=lambda row: row[0]):
        for number, row in enumerate(of_cycle):
            shown.append([cycle if number == 0 else "", _on_one_line(formula_text(row[1])), *row[2:]])
    assert {row[0] for row in body} == set(CYCLE_NAMES.values())
    return shown


def totals(rows: Rows) -> Rows:
    """With true minus signs."""
    return [[str(cell).replace("-", MINUS) if str(cell)[:1] == "-" else cell for cell in row] for row in rows]


def constancy(rows: Rows) -> Rows:
    """A line may not end between a sign and its number."""
    return systems([[str(cell).replace("< ", f"<{NO_BREAK}") for cell in row] for row in rows])


def steady(rows: Rows) -> Rows:
    """Without the largest n."""
    left_out = rows[0].index("n = 20")
    return systems([[cell for column, cell in enumerate(row) if column != left_out] for row in rows])


def processors(rows: Rows) -> Rows:
    """A row for each: the load of one filter, and of all of them the highest rate."""
    heading, *body = rows
    filters = list(dict.fromkeys((row[heading.index("Filter")], row[heading.index("n")]) for row in body))
    name, n = filters[1]
    heads = [f"n = {each}, Hz" if kind == name else f"{kind}, Hz" for kind, each in filters]
    shown: Rows = [["Processor", "MHz", "precision", "load, %", *heads]]
    for processor, of_processor in groupby(body, key=lambda row: row[0]):
        of = {(row[3], row[4]): row for row in of_processor}
        first = of[filters[0]]
        load = of[name, n][heading.index("load, %")]
        shown.append([processor, first[1], first[2], load, *(of[key][-1] for key in filters)])
    return shown
