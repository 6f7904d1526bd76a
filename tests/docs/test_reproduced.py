"""The commands of the page on what is reproduced run as it says: tests and scenarios."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "reproduced.md").read_text(encoding="utf-8")
TESTS = re.findall(r"`([^`]*\btests/[\w/]+\.py[^`]*)`", PAGE)


def is_slow(test: ast.FunctionDef) -> bool:
    return "pytest.mark.exhaust" in map(ast.unparse, test.decorator_list)


@pytest.mark.parametrize("command", TESTS)
def test_a_test_that_is_named_runs_some_test(command: str) -> None:
    """By `python -m pytest FILE`; with -m exhaust only those that are marked so."""
    for path in re.findall(r"tests/[\w/]+\.py", command):
        tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
        tests = [node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")]
        assert any(is_slow(test) == ("-m exhaust" in command) for test in tests), command


def test_a_scenario_that_is_named_is_there() -> None:
    found = re.findall(r"simulate --scenario ([^ `]+)", PAGE)
    assert found
    assert all((ROOT / path).is_file() for path in found)
