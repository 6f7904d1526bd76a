"""The table that the page on boards shows is what was emulated: part of the shipped one."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from reports.embedded.results import shipped

PAGE = Path(__file__).parents[2] / "docs" / "howto" / "board.md"


def test_its_costs_and_memory_are_those_that_are_shipped() -> None:
    shown = re.search(r"^# m4f\.toml\n.*?^```", PAGE.read_text(encoding="utf-8"), re.S | re.M)
    assert shown is not None
    table = tomllib.loads(shown[0].removesuffix("```"))
    emulated = shipped()[0]["cortex-m4f", "textbook"]
    assert table["precision"] == emulated.provenance["precision"]
    for method, costs in table["costs"].items():
        assert costs == {kind: emulated.entry(method, kind).median for kind in costs}
        assert table["memory"][method] == emulated.provenance["memory"][method]
