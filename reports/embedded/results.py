"""What the report on boards asks of compilers and of the emulator: stored, and read back.

What emulated cores give is the same wherever compiler and emulator are of the same versions. It is shipped too, so that
a machine without them has it; and a record of live runs, for one without the right to them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib.resources import as_file, files
from pathlib import Path
from typing import NamedTuple

from filters.backends.c_compiler import compiler
from filters.covariance_forms import CovarianceFormName
from filters.translation.library import Precision
from reports.embedded.live import TABLES as LIVE
from reports.embedded.live import live_tables
from reports.pages.stored import Rows, Tables, as_stored, read_tables, records, table_files
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import costs_text, read_costs
from sched_sim.errors import InputError
from studies.embedded.folders import FOLDERS, folder
from studies.embedded.known_loop import check
from studies.embedded.published import instructions
from studies.embedded.sources import EMULATED, FORMS, NATIVE, Source, table_of
from studies.embedded.stairs import record
from studies.machines.store import beside, kept
from studies.measurement.emulation.targets import TARGETS
from studies.measurement.emulation.toolchain import PACKAGES, missing
from studies.measurement.published_timings import published_timings

Progress = Callable[[int, int, str], None]

Costs = Mapping[tuple[str, CovarianceFormName], CostTable]
"""By the source's name and the form of the covariance update."""

PRECISIONS: tuple[Precision, ...] = ("single", "double")
OF_CORES = ("checks", "boards", "folders")
"""Tables of emulated cores beside their costs."""
SHIPPED = (*OF_CORES, *LIVE)
TABLES = (*SHIPPED, "said")


class Results(NamedTuple):
    """costs: of each source that there is. tables: by name, as in `TABLES`; the first row is a heading. stored: timed
    before, or on other machines."""

    costs: Costs
    tables: Mapping[str, Rows]
    stored: Mapping[tuple[str, CovarianceFormName], Sequence[CostTable]] = {}

    def measurements(self, source: str, form: CovarianceFormName) -> tuple[CostTable, ...]:
        """All that there are of a source that is timed."""
        return beside(self.costs[source, form], self.stored.get((source, form), ()))

    def records(self, name: str) -> list[dict[str, str]]:
        """The rows of a table by their heading."""
        return records(self.tables[name])

    @property
    def said(self) -> dict[str, str]:
        """What could not be run, by what it would have been: empty words where it was."""
        return {row["of"]: row["said"] for row in self.records("said")}

    def has(self, source: Source) -> bool:
        """Whether it could be run, or is shipped."""
        return (source.name, FORMS[0]) in self.costs

    def files(self) -> dict[str, bytes]:
        """What `read` reads."""
        return {f"{name}-{form}.toml": costs_text(table).encode() for (name, form), table in self.costs.items()} | (
            table_files(self.tables)
        )


def read(folder: Path) -> Results:
    """The results that a report in `folder` was made from, beside all measurements that are kept."""
    costs = {
        (source.name, form): read_costs(path)
        for source in (*EMULATED, *NATIVE)
        for form in FORMS
        if (path := folder / f"{source.name}-{form}.toml").exists()
    }
    return Results(costs, read_tables(folder, TABLES), _stored())


def _stored() -> dict[tuple[str, CovarianceFormName], tuple[CostTable, ...]]:
    return {(source.name, form): kept(f"{source.name}-{form}") for source in NATIVE for form in FORMS}


def results(thorough: bool = False, progress: Progress = lambda _done, _total, _what: None) -> Results:
    """Emulates and runs live, or reads what is shipped, and times the code here: seven minutes, and two more if nothing
    was compiled before.

    thorough: ten times as many rounds of what is timed, five times as many cycles of live runs.
    """
    lacking = missing()
    no_compiler = _no_compiler()
    native = [source for source in NATIVE if source.backend != "c" or not no_compiler]
    asked = [(source, form) for source in ([] if lacking else EMULATED) for form in FORMS]
    asked += [(source, form) for source in native for form in FORMS]
    live = len(asked) + len(TARGETS) + 1
    total = live + 1
    costs: dict[tuple[str, CovarianceFormName], CostTable] = {}
    for done, (source, form) in enumerate(asked):
        progress(done, total, f"{source.name}, {form}")
        timed = thorough and source.backend != "emulated"
        costs[source.name, form] = table_of(source, form, thorough=timed)
    emulated, record_kept = shipped()
    if lacking:
        costs = {**emulated, **costs}
        tables = {name: record_kept[name] for name in OF_CORES}
    else:
        tables = as_stored(_checked(costs, lambda done, what: progress(len(asked) + done, total, what)))
    runs, not_live = _live(record_kept, thorough, lambda _done, _total, what: progress(live, total, what))
    progress(total, total, "done")
    said: Rows = [["of", "said"], ["emulated", _not_emulated(lacking)], ["c", no_compiler], ["live", not_live]]
    return Results(costs, {**tables, **runs, "said": said}, _stored())


def _live(kept: Tables, thorough: bool, progress: Progress) -> tuple[dict[str, Rows], str]:
    """Live runs, or those that are shipped and why there are no others."""
    try:
        return as_stored(live_tables(record(thorough, progress))), ""
    except InputError as error:
        return {name: kept[name] for name in LIVE}, str(error)


def shipped() -> tuple[dict[tuple[str, CovarianceFormName], CostTable], dict[str, Rows]]:
    """Costs and tables of emulated cores that come with the project."""
    with as_file(files("studies") / "data" / "embedded") as folder:
        costs = {
            (source.name, form): read_costs(folder / f"{source.name}-{form}.toml")
            for source in EMULATED
            for form in FORMS
        }
        return costs, read_tables(folder, SHIPPED)


def _checked(costs: Costs, tell: Callable[[int, str], None]) -> dict[str, Rows]:
    checks: Rows = [["target", "loop", "loop_again", "jobs", "differing"]]
    for done, target in enumerate(TARGETS.values()):
        tell(done, f"{target.name}, again")
        of = check(target, costs[target.name, FORMS[0]])
        checks.append([of.target, *of.read, of.jobs, of.differing])
    tell(len(TARGETS), "published timings")
    boards: Rows = [["source", "job", "states", "instructions"]]
    for timing in published_timings():
        number = instructions(timing)
        boards.append([timing.source, timing.job, timing.states, "" if number is None else number])
    folders: Rows = [["method", "precision", "core", "code", "ram"]]
    folders += [[*folder(method, precision)] for method in FOLDERS for precision in PRECISIONS]
    return {"checks": checks, "boards": boards, "folders": folders}


def _not_emulated(lacking: list[str]) -> str:
    return f"{', '.join(lacking)} not found: install the packages {PACKAGES} (Debian's names)" if lacking else ""


def _no_compiler() -> str:
    try:
        compiler()
    except ValueError:
        return "no C compiler found: install gcc or clang, or name one in CC"
    return ""
