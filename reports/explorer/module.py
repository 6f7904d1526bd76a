"""The script that draws, as one ES module: a page loads it, a notebook is given it, a report holds it.

It is written as small modules in `js`, each of which imports others by name; joined, they are one, with no build step.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

IMPORT = re.compile(r'^import \{[^}]*\} from "\./([a-z]+)\.js";\n', re.MULTILINE)
EXPORT = re.compile(r"^export (?=const|function|class|async function)", re.MULTILINE)

PALETTE = "palette.css"


@cache
def module(entry: str) -> str:
    """`entry`, such as "page", with all that it imports before it. What the entry exports it still exports."""
    parts: dict[str, str] = {}
    _join(entry, parts, ())
    return "".join(parts.values())


def _join(name: str, parts: dict[str, str], importing: tuple[str, ...]) -> None:
    if name in importing:
        raise ValueError(f"{' -> '.join((*importing, name))}: modules import each other in a circle")
    if name in parts:
        return
    text = asset(f"{name}.js")
    for other in IMPORT.findall(text):
        _join(other, parts, (*importing, name))
    text = IMPORT.sub("", text)
    parts[name] = EXPORT.sub("", text) if importing else text


@cache
def stylesheet() -> str:
    """All style sheets of `js` as one, the palette before those that use its colours."""
    names = sorted(path.name for path in (files("reports.explorer") / "js").iterdir() if path.name.endswith(".css"))
    return "".join(map(asset, sorted(names, key=lambda name: name != PALETTE)))


@cache
def asset(name: str) -> str:
    """A file of `js`: a script, a style sheet or the frame of a page."""
    return (files("reports.explorer") / "js" / name).read_text(encoding="utf-8")
