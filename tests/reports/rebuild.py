"""Published reports anew from what is stored beside them: python -m tests.reports.rebuild [NAME...].

For a change of how reports look, or of what they say. Nothing is measured: what says when a report was made stays what
it is, if it is there. The page of all reports is written anew, too.
"""

from __future__ import annotations

import sys
from importlib import import_module

from reports.pages.made import made_here, made_of, with_made
from reports.pages.overview import overview
from sched_sim.cli.report import REPORTS
from tests.reports.published import FOLDER

PACKAGES = {"steffes2014": "steffes", "patent-multirate": "multirate"}
"""Where it is not the report's name."""


def rebuild(report: str) -> list[str]:
    """The files that differ from those that were there, which are deleted if they are no more."""
    test = import_module(f"tests.reports.{PACKAGES.get(report, report)}.test_report")
    folder = FOLDER / report
    new = with_made(test.rebuilt(), made_of(folder) or made_here(None))
    old = {path.name: path.read_bytes() for path in folder.iterdir()}
    for name, content in new.items():
        (folder / name).write_bytes(content)
    for name in old.keys() - new.keys():
        (folder / name).unlink()
    return sorted(name for name in old.keys() | new.keys() if old.get(name) != new.get(name))


if __name__ == "__main__":
    for report in sys.argv[1:] or REPORTS:
        print(f"{report}: {', '.join(rebuild(report)) or 'as it was'}", file=sys.stderr)
    for name, content in overview(FOLDER, REPORTS).items():
        (FOLDER / name).write_bytes(content)
