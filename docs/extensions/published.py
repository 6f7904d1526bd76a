"""Links to published reports: to their Markdown, as it is read in the repository; on the site to their page."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.addnodes import download_reference

PUBLISHED = Path(__file__).parents[2] / "reports" / "published"
BACK = '<p><a href="{root}index.html">sched_sim</a> / <a href="{root}reproduced.html">what is reproduced</a></p>'


def link_as_file(_app: Any, _name: str, source: list[str]) -> None:
    """MyST takes Markdown that is none of the site's pages for an error."""
    source[0] = re.sub(r"(reports/published/(?:[\w-]+/)?index)\.md", r"\1.html", source[0])


def to_page(app: Any, doctree: nodes.document) -> None:
    here = Path(app.env.doc2path(app.env.docname)).parent
    for link in list(doctree.findall(download_reference)):
        target = (here / link["reftarget"]).resolve()
        if target.is_relative_to(PUBLISHED) and target.name == "index.html":
            page = Path(app.srcdir, "published", target.relative_to(PUBLISHED))
            made = nodes.reference("", "", *link.children, refuri=os.path.relpath(page, here), internal=True)
            link.replace_self(made)


def copy(app: Any, _failed: Exception | None) -> None:
    """Each page with a way back to the site above it."""
    markdown = shutil.ignore_patterns("*.md")  # it says what the page says
    copied = Path(shutil.copytree(PUBLISHED, Path(app.outdir, "published"), ignore=markdown, dirs_exist_ok=True))
    for page in copied.rglob("index.html"):
        back = BACK.format(root="../" * len(page.relative_to(copied).parts))
        text = page.read_text(encoding="utf-8")
        page.write_text(text.replace("<body>", f"<body>\n{back}", 1), encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    app.connect("source-read", link_as_file)
    app.connect("doctree-read", to_page, priority=100)  # before files to download are collected
    app.connect("build-finished", copy)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
