"""The application: its commands, and what `sched-sim --help` says."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

from sched_sim.cli import accuracy, design, gantt, measure, minimum, processors, report, simulate, sweep
from sched_sim.errors import InputError
from sched_sim.text import visible_lines


@contextmanager
def _shown_safely() -> Iterator[None]:
    """What typer says of wrong arguments repeats them: as `visible` text, without its word for what it caught."""
    try:
        yield
    except Exception as error:
        usage: Any = error
        if hasattr(usage, "format_message"):
            usage.message = visible_lines(usage.message.removeprefix("Value error, "))
        raise


class Command(TyperCommand):
    """A command none of whose values is empty: typer would make the current folder of an empty path."""

    def parse_args(self, context: Any, arguments: list[str]) -> list[str]:
        values, _, _ = self.make_parser(context).parse_args(list(arguments))
        for parameter in self.params:
            value = values.get(parameter.name)
            if value == "" or (isinstance(value, list | tuple) and "" in value):
                option = parameter.opts[0]
                name = option if option.startswith("-") else f"argument {str(parameter.name).upper()}"
                raise InputError(f"{name} is empty: give a value, or leave it out")
        return super().parse_args(context, arguments)


class Commands(TyperGroup):
    """The commands, and what is said of wrong arguments."""

    def make_context(self, *args: Any, **settings: Any) -> Any:
        with _shown_safely():
            return super().make_context(*args, **settings)

    def invoke(self, *args: Any) -> Any:
        with _shown_safely():
            return super().invoke(*args)


app = typer.Typer(
    cls=Commands,
    no_args_is_help=True,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="The measurement of step k = 0, N, 2N, ... arrives M steps late, at m = k + M; the correction must reach "
    "the state by l = k + L. Steps are periods of the high-rate (HR) loop. Start with: "
    "[bold]sched-sim minimum -N 10 -M 4 -L 8[/bold]",
)


def _show_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        print(f"sched-sim {version('sched-sim')}")
        raise typer.Exit


@app.callback()
def sched_sim(
    _version: Annotated[
        bool, typer.Option("--version", help="Show the version.", callback=_show_version, is_eager=True)
    ] = False,
) -> None:
    """Which delayed-measurement Kalman filter fits your processor, how slow a processor will do, and when does the
    correction reach the output?"""


app.command("minimum", cls=Command)(minimum.minimum)
app.command("simulate", cls=Command)(simulate.simulate)
app.command("gantt", cls=Command)(gantt.gantt)
app.command("sweep", cls=Command)(sweep.sweep)
app.command("processors", cls=Command)(processors.processors)
app.command("accuracy", cls=Command)(accuracy.accuracy)
app.command("design", cls=Command)(design.design)
app.command("measure", cls=Command)(measure.measure)
app.command("report", cls=Command)(report.report)
