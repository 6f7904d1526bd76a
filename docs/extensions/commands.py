"""`.. commands::`, the reference of the command line: what each command's `--help` says, as options to link to."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

import typer
from docutils import nodes
from sphinx.util.docutils import SphinxDirective

from sched_sim.cli.app import app as application

VALUES = {bool: "", int: "COUNT", str: "VALUE", Path: "FILE"}


def text(words: str) -> str:
    """Running text of a help, which has rich's markup, as reStructuredText."""
    words = words.replace("\\[", "[")
    return re.sub(r"`([^`]+)`|(--[a-z][a-z-]+)", r"``\1\2``", re.sub(r"([*|\\]|_\b)", r"\\\1", words))


def value(parameter: Any) -> str:
    """What is written after the option."""
    annotation = parameter.type_descriptor.annotation
    kind = get_args(annotation)[0] if get_origin(annotation) is list else annotation
    if get_origin(kind) is Literal:
        return "|".join(map(str, get_args(kind)))
    if kind is Path and (parameter.help or "").startswith("Folder"):
        return "FOLDER"
    return parameter.metavar or VALUES[kind]


def option(parameter: Any) -> Iterator[str]:
    if parameter.opts[0].startswith("-"):
        after = value(parameter)
        yield f".. option:: {', '.join(f'{name} {after}'.strip() for name in parameter.opts)}"
    else:
        yield f".. option:: {(parameter.metavar or parameter.name).lower()}"
    yield ""
    default = parameter.default
    also = f" Default: ``{default}``." if default not in (None, False) and not callable(default) else ""
    yield f"   {text(parameter.help or '')}{' Required.' if parameter.required else ''}{also}"
    yield ""


def command(name: str, described: Any) -> Iterator[str]:
    summary, _, examples = described.help.partition("\n\n")
    yield from [
        f"sched-sim {name}",
        "-" * 40,
        "",
        f".. program:: sched-sim {name}",
        "",
        text(" ".join(summary.split())),
    ]
    yield from ["", ".. code-block:: sh", "", *(f"   {line}" for line in examples.splitlines()), ""]
    panels: dict[str, list[Any]] = {}
    for parameter in described.params:
        if parameter.name != "help":
            panels.setdefault(parameter.rich_help_panel or "Options", []).append(parameter)
    for panel, parameters in panels.items():
        yield from [f".. rubric:: {panel}", ""]
        for parameter in parameters:
            yield from option(parameter)


class Commands(SphinxDirective):
    def run(self) -> list[nodes.Node]:
        lines = [
            line for name, one in typer.main.get_command(application).commands.items() for line in command(name, one)
        ]
        return self.parse_text_to_nodes("\n".join(lines), allow_section_headings=True)


def setup(app: Any) -> dict[str, bool]:
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
