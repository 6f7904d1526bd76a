"""The application: its commands, and what `sched-sim --help` says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Annotated, Any

import typer
import typer.main
from typer.core import TyperCommand, TyperGroup

from sched_sim.cli import (
    accuracy,
    code,
    design,
    explore,
    gantt,
    live,
    measure,
    minimum,
    probability,
    processors,
    report,
    simulate,
    sweep,
)
from sched_sim.errors import InputError
from sched_sim.text import did_you_mean, visible_lines


@contextmanager
def _shown_safely() -> Iterator[None]:
    """What typer says of wrong arguments repeats them: as `visible` text, without its word for what it caught."""
    try:
        yield
    except Exception as error:
        usage: Any = error
        if hasattr(usage, "format_message"):
            usage.message = visible_lines(_with_meant(usage.message.removeprefix("Value error, ")))
        raise


def _with_meant(message: str) -> str:
    """The message; where a value is none of an option's choices but close to one, with that one behind."""
    given = re.fullmatch(r"'(.*)' is not one of (.*)", message)
    meant = did_you_mean(given[1], re.findall("'([^']*)'", given[2])).strip() if given else ""
    return f"{message} {meant[0].upper()}{meant[1:]}" if meant else message


def _elsewhere(context: Any, flag: str) -> str:
    """What takes the place of an option that is one of other commands, in words; empty where it is of none."""
    if context.info_name == "sweep" and flag in IN_STEPS:
        return f"a sweep is in HR steps: give {IN_STEPS[flag]}"
    commands = [] if context.parent is None else context.parent.command.commands.items()
    others = [name for name, command in commands if any(flag in parameter.opts for parameter in command.params)]
    return f"it is one of {', '.join(f'`sched-sim {name}`' for name in others)}" if others else ""


IN_STEPS = {
    "--measurement-hz": "-N, the steps from one measurement to the next: 80 for 5 Hz at --hr-hz 400",
    "--delay-ms": "-M, the steps until a measurement arrives, rounded up: 44 for 110 ms at --hr-hz 400",
    "--land-within-ms": "-L, the step by which the correction must land: 48 for 120 ms at --hr-hz 400",
}
"""What a sweep has in place of times."""


class Command(TyperCommand):
    """A command none of whose values is empty: typer would make the current folder of an empty path."""

    def parse_args(self, context: Any, arguments: list[str]) -> list[str]:
        try:
            values, _, _ = self.make_parser(context).parse_args(list(arguments))
        except Exception as error:  # typer does not say where the class of its own error is
            flag = getattr(error, "option_name", "")
            if isinstance(flag, str) and (instead := _elsewhere(context, flag)):
                raise InputError(f"{flag} is no option of `{context.command_path}`: {instead}") from None
            raise
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
app.command("probability", cls=Command)(probability.probability)
app.command("gantt", cls=Command)(gantt.gantt)
app.command("sweep", cls=Command)(sweep.sweep)
app.command("processors", cls=Command)(processors.processors)
app.command("accuracy", cls=Command)(accuracy.accuracy)
app.command("design", cls=Command)(design.design)
app.command("explore", cls=Command)(explore.explore)
app.command("measure", cls=Command)(measure.measure)
app.command("code", cls=Command)(code.code)
app.command("live", cls=Command)(live.live)
app.command("report", cls=Command)(report.report)


@cache
def command() -> Any:
    """The application as typer runs it, built once."""
    return typer.main.get_command(app)
