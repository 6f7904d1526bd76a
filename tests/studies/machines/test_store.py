"""The store gives back what was kept, once each, the oldest first; and takes only times of the jobs that it has."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from sched_sim.costs.methods import PAPER_METHODS, ROBUST_METHODS
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import costs_text, load_costs, write_costs
from sched_sim.errors import InputError
from studies.machines import __main__ as command
from studies.machines.parts import NAME as PARTS
from studies.machines.store import FOLDER, beside, files, keep, kept
from studies.modular.costs import Times
from studies.modular.flight_times import NAME as FLIGHTS

TABLES = sorted({path.name for path in FOLDER.iterdir()} - {PARTS, FLIGHTS})
XEON, EPYC = "Intel(R) Xeon(R) CPU @ 2.20GHz", "AMD EPYC"


def timed(seconds: str = "2e-7", *, jobs: tuple[str, ...] = ("propagate", "update"), **about: Any) -> CostTable:
    said = {"update_form": "textbook", "machine": XEON, "date": "2026-11-30", "protocol": {"rounds": 61}}
    return CostTable("t", "second", {"standard": {job: Cost.of(Fraction(seconds)) for job in jobs}}, {**said, **about})


def test_what_is_kept_is_given_back_the_oldest_first(tmp_path: Path) -> None:
    later, first, other = timed("3e-7"), timed(date="2026-11-22"), timed("4e-7")
    for table in (later, first, other):
        keep(table, tmp_path)
    assert [table.costs for table in kept("t", tmp_path)] == [first.costs, later.costs, other.costs]
    assert [path.name for path in files("t", tmp_path)] == [
        "intel-r-xeon-r-cpu-2-20ghz-2026-11-22.toml",
        "intel-r-xeon-r-cpu-2-20ghz-2026-11-30.toml",
        "intel-r-xeon-r-cpu-2-20ghz-2026-11-30-2.toml",
    ]
    assert kept("another", tmp_path) == ()


def test_the_tenth_measurement_of_a_day_is_the_last(tmp_path: Path) -> None:
    given = [timed(f"{number}e-7") for number in range(1, 12)]
    for table in given:
        keep(table, tmp_path)
    assert [table.costs for table in kept("t", tmp_path)] == [table.costs for table in given]


def test_one_measurement_is_kept_once(tmp_path: Path) -> None:
    paths = [keep(timed(), tmp_path), keep(timed("3e-7"), tmp_path), keep(timed(), tmp_path)]
    assert paths[0] == paths[2]
    assert len(files("t", tmp_path)) == 2


def test_a_measurement_stands_last_beside_the_others_whether_it_is_stored_or_not() -> None:
    one, two = timed(), timed("3e-7")
    assert beside(two, [one]) == beside(two, [one, two]) == (one, two)
    assert beside(one, [one, two]) == (two, one)


@pytest.mark.parametrize(
    ("table", "said"),
    [
        (timed(update_form="short"), "update_form = 'short' where .* has 'textbook'"),
        (timed(structure="sparse"), "structure = 'sparse' where .* has 'dense'"),
        (replace(timed(), unit="ms"), "unit = 'ms' where .* has 'second'"),
        (timed(compiler="cc 14, -O1"), "compiler = '-O1' where .* has None"),
        (timed(jobs=("propagate",)), "lacks jobs that .* has: standard update"),
        (replace(load_costs("counted-9-3-3"), name="t"), "does not say on which machine"),
    ],
)
def test_times_of_other_jobs_are_refused(table: CostTable, said: str, tmp_path: Path) -> None:
    keep(timed(machine=EPYC), tmp_path)
    with pytest.raises(InputError, match=said):
        keep(table, tmp_path)
    assert len(files("t", tmp_path)) == 1


def test_further_jobs_other_versions_and_a_busy_machine_are_taken(tmp_path: Path) -> None:
    keep(timed(machine=EPYC, compiler="cc 12, -O3"), tmp_path)
    more = timed(
        jobs=("propagate", "update", "replay"), compiler="cc 14, -O3", busy="load average 9", structure="dense"
    )
    assert keep(more, tmp_path).exists()


@pytest.mark.parametrize("name", TABLES)
def test_the_repository_has_each_measurement_where_its_machine_and_date_say(name: str, tmp_path: Path) -> None:
    """And kept anew, one after another, they are the same files."""
    for path, table in zip(files(name), kept(name), strict=True):
        assert table.name == name
        again = keep(table, tmp_path)
        assert again.name == path.name
        assert again.read_bytes() == path.read_bytes() == costs_text(table).encode()


def test_the_repository_has_the_jobs_of_the_reports() -> None:
    for table in kept("measured-9-3-3"):
        assert set(table.costs) == set(PAPER_METHODS)
    for name in ("erkf-attitude", "erkf-position"):
        assert kept(name)
        assert all(set(table.costs) == set(ROBUST_METHODS) for table in kept(name))


def test_the_command_keeps_tables_and_says_where_and_ends_with_2_where_it_cannot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(command, "keep", lambda table: keep(table, tmp_path / "store"))
    given, counted = tmp_path / "t.toml", tmp_path / "counted.toml"
    write_costs(timed(busy="load average 9"), given)
    write_costs(load_costs("counted-9-3-3"), counted)
    assert command.main([str(given)]) == 0
    out, err = capsys.readouterr()
    assert Path(out.strip()).read_bytes() == given.read_bytes()
    assert "measured on a busy machine: load average 9" in err
    assert command.main([str(counted)]) == 2
    assert re.search("does not say on which machine", capsys.readouterr().err)


def test_without_paths_it_measures_the_tables_that_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "measure", lambda _system, name, **_: replace(timed(), name=name))
    monkeypatch.setattr(command, "robust_costs", lambda system, _backend: replace(timed(), name=f"erkf-{system}"))
    for timed_parts in ("times", "flight_times"):
        monkeypatch.setattr(command, timed_parts, lambda: Times({}, {}))
    tables = [one.name for one in command.measured_here() if isinstance(one, CostTable)]
    assert set(tables) <= set(TABLES)
    assert len(tables) == 3
