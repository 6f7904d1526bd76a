"""```{drawn}` of a command that writes a picture: the command is shown, run, and its picture put below it."""

from __future__ import annotations

import os
import shlex
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective
from typer.testing import CliRunner

from sched_sim.cli.app import app as application


class Drawn(SphinxDirective):
    has_content = True
    option_spec: ClassVar = {"alt": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        (line,) = self.content
        words = shlex.split(line)[1:]
        pictures = Path(self.env.app.doctreedir, "drawn", self.env.docname)
        pictures.mkdir(parents=True, exist_ok=True)
        picture = pictures / words[-1]
        done = CliRunner().invoke(application, [*words[:-1], str(picture)])
        if done.exit_code:
            raise self.error(done.output)
        shown = nodes.literal_block(line, line, language="sh")
        place = os.path.relpath(picture, Path(self.env.doc2path(self.env.docname)).parent)
        return [shown, nodes.image(uri=place, alt=self.options["alt"])]


def setup(app: Any) -> dict[str, bool]:
    app.add_directive("drawn", Drawn)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
