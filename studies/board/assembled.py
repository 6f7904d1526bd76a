"""The files of any filter, from its jobs in C and what is around them."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from filters.jobs import Job
from filters.translation.prototype import WIDTH, wrapped
from studies.board.bits import test_c
from studies.board.compiled import CLOCK_HZ, Compiled, compiled
from studies.board.jobs import Jobs
from studies.board.readme import About, readme


class Around(NamedTuple):
    """What is around the jobs. sources: what is compiled for a board. sizes: of the arrays in RAM. tested: words of
    test.c. timed: kinds of the cost table, and the job that each is. late(on_core): files that depend on sizes.
    costs: the head of the cost table and the format of a line, if they are not those of a method."""

    files: dict[str, str]
    sources: Sequence[str]
    sizes: Mapping[str, int]
    tested: Mapping[str, str]
    timed: Mapping[str, str]
    late: Callable[[Compiled | None], dict[str, str]] = lambda _: {}
    costs: tuple[str, str] | None = None


USUAL, NUMERIC = "1000.0", "1e6"
"""Units of the last place by which numbers may be off: usually, and where differences are taken."""


def words_of_run(name: str, functions: str, tolerance: str = USUAL) -> dict[str, str]:
    """Words of test.c for what is run on the record, in `name`.c."""
    return {
        "tolerance": tolerance,
        "sources": f"filter.c {name}.c test.c",
        "includes": f'\n#include "record.h"\n#include "{name}.h"',
        "functions": functions,
        "run": f"\n    {name}_test();",
    }


def assembled(about: About, jobs: Mapping[str, Job], in_c: Jobs, around: Around) -> dict[str, str]:
    """All files, by name. jobs: with all products, see `test_c`."""
    files = {
        "filter.h": _banner(about) + in_c.unit.header("FILTER_H"),
        "filter.c": _banner(about) + in_c.unit.source("filter.h"),
        **around.files,
        "test.c": test_c(jobs, around.timed, in_c, {**_costs(about, around), **around.tested}),
    }
    on_core = compiled(files, around.sources, about.precision)
    files |= around.late(on_core)
    files["README.md"] = readme(about, in_c, around.sizes, {name: files[name] for name in around.sources}, on_core)
    return {name: _readable(text) if name.endswith((".c", ".h")) else text for name, text in files.items()}


def _costs(about: About, around: Around) -> dict[str, str]:
    head, line = around.costs or (f"[costs.{about.method}]", "%s = %.4f")
    structure = f'structure = \\"{about.structure}\\"\\n' if about.structure else ""
    return {"clock_hz": CLOCK_HZ[about.precision], "structure": structure, "costs": head, "cost": line}


def _readable(text: str) -> str:
    """With no line that is too long."""
    lines, in_comment = [], False
    for line in text.splitlines():
        lines.append(_filled(line) if in_comment else wrapped(line))
        opened, closed = line.rfind("/*"), line.rfind("*/")
        in_comment = opened > closed or (in_comment and closed < 0)
    return "\n".join(lines) + "\n"


def _filled(line: str) -> str:
    """A line of a comment."""
    indent = " " * (len(line) - len(line.lstrip()))
    return textwrap.fill(line, WIDTH, subsequent_indent=indent) if len(line) > WIDTH else line


def _banner(about: About) -> str:
    said = f"{about.method}: {about.described}."
    made = "Translated from Python by sched_sim, from the functions that are counted, timed and scheduled."
    where = f"{made} {about.source}".strip()
    lines = (textwrap.fill(part.replace("*/", "* /"), WIDTH, subsequent_indent="   ") for part in (said, f"   {where}"))
    return "/* {}\n\n{} */\n".format(*lines)
