"""Small ES modules, joined into one."""

from __future__ import annotations

import re
from collections import Counter
from importlib.resources import files

import pytest

from reports.explorer.module import IMPORT, PALETTE, asset, module, stylesheet
from tests.browser import Visit

NAMES = sorted(path.name.removesuffix(".js") for path in (files("reports.explorer") / "js").iterdir()
               if path.name.endswith(".js"))  # fmt: skip
ENTRIES = sorted({*NAMES} - {other for name in NAMES for other in IMPORT.findall(asset(f"{name}.js"))})
TOP = re.compile(r"^(?:export )?(?:const|let|class|(?:async )?function\*?) (\w+)", re.MULTILINE)


@pytest.mark.parametrize("name", NAMES)
def test_it_imports_nothing_but_files_beside_it(name: str) -> None:
    assert "import" not in IMPORT.sub("", module(name))
    assert "http" not in re.sub(r"http://www\.w3\.org/\S+", "", asset(f"{name}.js"))


def test_no_name_is_declared_twice() -> None:
    declared = Counter(name for file in NAMES for name in TOP.findall(asset(f"{file}.js")))
    assert [name for name, count in declared.items() if count > 1] == []


@pytest.mark.parametrize("name", ENTRIES)
def test_it_runs(name: str, visit: Visit) -> None:
    visit.page.set_content("<!doctype html><title>empty</title>")
    visit.page.add_script_tag(content=module(name), type="module")


def test_the_style_sheets_are_one_which_begins_with_the_palette() -> None:
    sheets = [path.name for path in (files("reports.explorer") / "js").iterdir() if path.name.endswith(".css")]
    assert len(stylesheet()) == sum(len(asset(name)) for name in sheets)
    assert all(asset(name) in stylesheet() for name in sheets)
    assert PALETTE not in sheets or stylesheet().startswith(asset(PALETTE))
