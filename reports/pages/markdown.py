"""The text of a report: a template's Markdown, with its tables, and its figures numbered as they come."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from reports.pages.minus import true_minus

Row = Sequence[Any]


def markdown_of(template: str, **values: Any) -> str:
    """templates/TEMPLATE.md.j2 with these values. In it are

    {{ rows | table }}, see `markdown_table`;
    {{ figure("late.svg", "what is seen, for who does not see it", "The caption.", data=["late.csv"]) }};
    {{ number("late.svg") }}, such as "Figure 3": of any figure of the report, before or behind it.

    Numbers that are negative have a true minus sign on the page, whatever they have in the values.

    Below a figure stand links to its data and to itself, and the command that makes both; command: by default that of
    the report.
    """
    figures = Figures(f"sched-sim report {template}")
    environment = Environment(
        loader=PackageLoader("reports"), undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["table"] = markdown_table
    environment.globals.update(figure=figures.figure, number=figures.number)
    page = environment.get_template(f"{template}.md.j2")
    page.render(**values)  # by then all figures have their numbers
    return true_minus(page.render(**values))


class Figures:
    """command: that makes those of which no other is said."""

    def __init__(self, command: str) -> None:
        self._command = command
        self._numbers: dict[str, int] = {}

    def figure(self, file: str, alt: str, caption: str, data: Sequence[str] = (), command: str = "") -> str:
        number = self._numbers.setdefault(file, len(self._numbers) + 1)
        links = ", ".join(f"[{name}]({name})" for name in [*data, file])
        return f"![{alt}]({file})\n\n**Figure {number}.** {caption} *{links}; `{command or self._command}`*"

    def number(self, file: str) -> str:
        return f"Figure {self._numbers.get(file, 0)}"


def markdown_table(rows: Sequence[Row]) -> str:
    """The first row is the heading; columns of numbers are aligned right."""
    heading, *body = rows
    numeric = [all(_is_number(row[column]) for row in body) for column in range(len(heading))]
    lines = [heading, ["---:" if right else "---" for right in numeric], *body]
    return "\n".join("| " + " | ".join(_unbroken(str(cell)) for cell in line) + " |" for line in lines)


def _unbroken(cell: str) -> str:
    """A line may end before an interval, not in it."""
    return re.sub(r"(?<=[\d.%]) (to|±) (?=[-−\d])", "\N{NO-BREAK SPACE}\\1\N{NO-BREAK SPACE}", cell)


NUMBER = r"(?:[<>≤≥]\s)?[-+−]?[\d., ]+(?:\s×\s10[⁻⁰¹²³⁴-⁹]+)?(?:\s?%)?"
IS_NUMBER = re.compile(rf"{NUMBER}(?:\sto\s{NUMBER})?|[-–]")


def _is_number(cell: Any) -> bool:
    return IS_NUMBER.fullmatch(str(cell)) is not None
