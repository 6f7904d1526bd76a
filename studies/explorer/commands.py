"""The command lines, and the lines of Python, that give the figures of a design: to go on from there."""

from __future__ import annotations

import shlex
from dataclasses import dataclass

from studies.explorer import python, shell
from studies.explorer.planned import Planned
from studies.explorer.resolved import Resolved
from studies.explorer.sources import sources_of


@dataclass(frozen=True, slots=True)
class Commands:
    """shell: a command a line, quoted for any POSIX shell. Both are empty where the design has something that was made
    in Python, so that no file and no function is known of it."""

    shell: str = ""
    python: str = ""


def commands(asked: Resolved, plan: Planned) -> Commands:
    """Files and functions of the user's are named as they were given."""
    sources = sources_of(asked)
    if sources is None:
        return Commands()
    words, text = shell.lines(asked, plan, sources), python.lines(asked, plan, sources)
    return Commands("\n".join(map(shlex.join, words)), "\n".join(text))
