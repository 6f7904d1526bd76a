"""Scripts without comments and indentation are the same scripts."""

from __future__ import annotations

import re
from importlib.resources import files

import pytest

from reports.explorer.compact import compact
from reports.explorer.module import asset
from tests.browser import Visit

OTHER_QUOTES = re.compile(r'"(?:\\.|[^"\\])*"|\\.')
FILES = sorted(
    path.name for path in (files("reports.explorer") / "js").iterdir() if path.name.endswith((".js", ".css"))
)


@pytest.mark.parametrize("name", FILES)
def test_a_text_goes_over_no_line_end(name: str) -> None:
    """So that no indentation is part of one."""
    for line in compact(asset(name)).splitlines():
        assert OTHER_QUOTES.sub("", line).count("`") % 2 == 0, line


@pytest.mark.parametrize("name", FILES)
def test_it_has_lines_of_the_text_in_their_order_and_fewer(name: str) -> None:
    lines, small = [line.strip() for line in asset(name).splitlines()], compact(asset(name))
    following = iter(lines)
    assert all(line in following for line in small.splitlines())
    assert len(small) < len(asset(name))
    assert compact(small) == small


def test_what_is_no_comment_stays(visit: Visit) -> None:
    script = 'const at = "http://a";\n  /* one\n two */\n  // three\n\nconst half = 1 / 2; // four\nat + half;\n'
    assert compact(script) == 'const at = "http://a";\nconst half = 1 / 2; // four\nat + half;\n'
    visit.page.set_content("<title>empty</title>")
    assert visit.page.evaluate(compact(script)) == "http://a0.5"
