"""Texts that are the same but for a few words: the files in `templates`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from string import Template
from typing import Any

TEMPLATES = Path(__file__).parent / "templates"


def filled(name: str, values: Mapping[str, Any]) -> str:
    """The template of this name, with a value for each of its $words."""
    return Template((TEMPLATES / name).read_text(encoding="utf-8")).substitute(values)
