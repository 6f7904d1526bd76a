"""The published pages with the script and the style sheet of today: python -m tests.reports.scripted.

What else they say is left as it is: where a change of those is all there is, no report need be made anew.
"""

from __future__ import annotations

import re
import sys

from reports.pages import alive
from tests.reports.published import FOLDER

SCRIPT = re.compile(r'(?<=<script type="module">\n).*?(?=</script>)', re.DOTALL)
STYLE = re.compile(r'(?<=<style class="ss">\n).*?(?=</style>)', re.DOTALL)


def scripted(page: str) -> str:
    """A page of a report, with both as they are now."""
    for part, text in ((SCRIPT, alive.script()), (STYLE, alive.style())):
        page, count = part.subn(lambda _, text=text: text, page)
        if count != 1:
            raise ValueError(f"a page has {count} of {part.pattern}")
    return page


if __name__ == "__main__":
    for path in sorted(FOLDER.glob("*/index.html")):
        before = path.read_text(encoding="utf-8")
        after = scripted(before)
        path.write_text(after, encoding="utf-8")
        print(path, "is as it was" if after == before else "has the script of today", file=sys.stderr)
