"""The flags of the choices that `sched_sim.design.options` declares."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import Field, fields
from fractions import Fraction
from functools import wraps
from typing import Annotated, Any, get_type_hints

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.spelling import flag_of
from sched_sim.design import options
from sched_sim.design.options import Options
from sched_sim.errors import option
from sched_sim.ticks import exact

Command = Callable[..., None]
PANELS = {options.FILTER: opt.DESIGN, options.PROCESSOR: opt.PROCESSOR}
Axes = Mapping[str, "list[str] | None"]
"""Values of each choice, as a user gives them."""


def with_options(command: Command) -> Command:
    """The command, with a flag for each choice in place of its parameter `options`."""

    def chosen(values: Mapping[str, Any]) -> Options:
        return Options(**{choice.name: _value(choice, values[choice.name]) for choice in fields(Options)})

    return _with_flags(command, _flag, chosen)


def with_axes(command: Command) -> Command:
    """The command, with a flag for each choice, of one or several values, in place of its parameter `options`: it is
    given the `Axes`."""
    return _with_flags(command, _axis, dict)


def _with_flags(
    command: Command, flag: Callable[[Field[Any]], inspect.Parameter], joined: Callable[[Mapping[str, Any]], Any]
) -> Command:
    signature = inspect.signature(command, eval_str=True)
    names = [choice.name for choice in fields(Options)]

    @wraps(command)
    def flagged(**values: Any) -> None:
        chosen = joined({name: values.pop(name) for name in names})
        with opt.naming_tasks(values.get("tasks"), _one(values.get("hr_hz"))):
            command(**values, options=chosen)

    parameters: list[inspect.Parameter] = []
    for parameter in signature.parameters.values():
        parameters += map(flag, fields(Options)) if parameter.name == "options" else [parameter]
    flagged.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]  # typer reads it
    flagged.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return flagged


def _one(value: Any) -> str | None:
    """Of an option that a sweep has several of: none."""
    return value if isinstance(value, str) else None


def _flag(choice: Field[Any]) -> inspect.Parameter:
    values = _values(choice)
    if not values:
        return _parameter(choice, str, str(choice.default), choice.metadata["help"])
    if isinstance(choice.default, int):
        more = {"parser": _one_of(values), "metavar": "|".join(map(str, values))}
        return _parameter(choice, int, choice.default, choice.metadata["help"], **more)
    return _parameter(choice, get_type_hints(Options)[choice.name], choice.default, choice.metadata["help"])


def _axis(choice: Field[Any]) -> inspect.Parameter:
    text, values = choice.metadata["help"], _values(choice)
    if values:
        others = ", ".join(str(value) for value in values if value != choice.default)
        text = f"{choice.default} (default), {others} or several: {','.join(map(str, values))}. {text}"
    return _parameter(choice, list[str] | None, None, text, metavar="VALUES")


def _parameter(choice: Field[Any], kind: Any, default: Any, text: str, **more: Any) -> inspect.Parameter:
    panel = PANELS[choice.metadata["of"]]
    info = typer.Option(flag_of(choice.name), help=text, rich_help_panel=panel, **more)
    keyword = inspect.Parameter.POSITIONAL_OR_KEYWORD
    return inspect.Parameter(choice.name, keyword, default=default, annotation=Annotated[kind, info])


def _values(choice: Field[Any]) -> tuple[Any, ...]:
    return options.choices()[choice.name]


def _value(choice: Field[Any], value: Any) -> Any:
    return exact(value, option(choice.name)) if isinstance(choice.default, Fraction) else value


def _one_of(values: tuple[int, ...]) -> Callable[[str], int]:
    def chosen(text: str) -> int:
        number = opt.whole(text)
        if number not in values:
            raise typer.BadParameter(f"{number} is not possible: give {' or '.join(map(str, values))}.")
        return number

    return chosen
