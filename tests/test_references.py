"""What docstrings and comments name in other files is there: `module.name` in backquotes, and paths of files."""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("filters", "reports", "sched_sim", "studies")
SOURCES = {
    ".".join(file.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): file
    for package in PACKAGES
    for file in (ROOT / package).rglob("*.py")
    if file.name != "__main__.py"
}


def modules(name: str) -> list[str]:
    """All whose dotted name ends so."""
    return [module for module in SOURCES if f".{module}".endswith(f".{name}")]


def is_there(name: str, where: str) -> bool:
    """Whether it is a module, or of one; or of what the file itself calls so. What is of no module of ours may be."""
    head, _, last = name.rpartition(".")
    named = [import_module(module) for module in modules(head)]
    own = getattr(import_module(where), head, None)
    return bool(modules(name)) or not named or any(hasattr(each, last) for each in (*named, own))


def test_names_in_backquotes_exist() -> None:
    quoted = re.compile(r"(?<!`)`([a-z_]\w*(?:\.\w+)+)`")
    missing = [
        (where, name)
        for where, file in SOURCES.items()
        for name in quoted.findall(file.read_text())
        if not is_there(name, where)
    ]
    assert missing == []


def named_files() -> Iterator[tuple[Path, str]]:
    path = re.compile(rf"\b(?:{'|'.join(PACKAGES)})/[\w/-]+\.(?:py|toml|j2)\b")
    texts = [
        file for package in PACKAGES for kind in ("py", "toml", "j2") for file in (ROOT / package).rglob(f"*.{kind}")
    ]
    for file in (*texts, ROOT / "README.md", ROOT / "Makefile", ROOT / "pyproject.toml"):
        yield from ((file, name) for name in path.findall(file.read_text()))


def test_paths_exist() -> None:
    assert [(file, name) for file, name in named_files() if not (ROOT / name).exists()] == []
