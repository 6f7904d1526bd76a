"""Times of the parts of composed filters are kept as cost tables are."""

from __future__ import annotations

from pathlib import Path

import pytest

from sched_sim.errors import InputError
from studies.machines import __main__ as command
from studies.machines.parts import (
    Micros,
    PartTimes,
    keep_parts,
    kept_parts,
    part_times,
    parts_beside,
    parts_text,
    read_parts,
)
from studies.machines.store import files
from studies.modular import flight_times
from studies.modular.costs import KINDS, PARTS, STATES, Times

ABOUT = {"machine": "Intel Xeon", "date": "2026-11-30", "versions": {"numba": "0.68"}, "protocol": {"rounds": 3}}
KEYS = {(kind, str(states), part) for kind in KINDS for states in STATES for part in PARTS}
FLIGHT_KEYS = {(kind, flight_times.STATES, way) for kind in flight_times.PREDICTORS for way in flight_times.WAYS}


def timed(least: float = 0.2, **about: str) -> PartTimes:
    return PartTimes({**ABOUT, **about}, {("linear", "3", "predict"): Micros(least, 0.5)})


def test_of_the_rounds_the_least_and_the_median_are_known_to_three_digits() -> None:
    found = part_times(Times({("linear", "3", "predict"): [3.00049e-7, 1.23456e-7, 2.0e-7]}, ABOUT))
    assert found.parts == {("linear", "3", "predict"): Micros(0.123, 0.2)}
    assert found.provenance.items() >= ABOUT.items()


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    (tmp_path / "times.toml").write_text(parts_text(timed(busy="load average 9")), encoding="utf-8")
    assert read_parts(tmp_path / "times.toml") == timed(busy="load average 9")


def test_measurements_are_kept_once_the_oldest_first(tmp_path: Path) -> None:
    given = [timed(0.3), timed(date="2026-11-22"), timed(0.4), timed(0.3)]
    paths = [keep_parts(one, tmp_path) for one in given]
    assert paths[0] == paths[3]
    assert kept_parts(tmp_path) == (given[1], given[0], given[2])
    assert parts_beside(given[0], kept_parts(tmp_path)) == (given[1], given[2], given[0])


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[costs.linear-3]\npredict = { minimum = 1, median = 1 }",
        "[costs.linear]\npredict = 1",
        "[costs.linear-3]\npredict = { minimum = 1 }",
        "costs = 3",
    ],
)
def test_what_holds_no_times_of_parts_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "times.toml").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="holds no times of parts"):
        read_parts(tmp_path / "times.toml")


def test_times_of_other_parts_are_refused(tmp_path: Path) -> None:
    keep_parts(timed(), tmp_path)
    with pytest.raises(InputError, match="not times of the parts"):
        keep_parts(PartTimes(ABOUT, {("linear", "6", "predict"): Micros(1.0, 2.0)}), tmp_path)


@pytest.mark.parametrize(("name", "keys"), [("modular-parts", KEYS), ("modular-flight", FLIGHT_KEYS)])
def test_the_repository_has_all_parts_in_every_measurement(
    name: str, keys: set[tuple[str, str, str]], tmp_path: Path
) -> None:
    """And kept anew, one after another, they are the same files."""
    every = kept_parts(name=name)
    assert every
    for path, one in zip(files(name), every, strict=True):
        assert one.parts.keys() == keys
        assert all(micros.least <= micros.median for micros in one.parts.values())
        again = keep_parts(one, tmp_path)
        assert (again.name, again.read_bytes()) == (path.name, path.read_bytes())


def test_flights_are_kept_beside_parts(tmp_path: Path) -> None:
    flown = timed()._replace(name="modular-flight", parts={("unscented", "15", "compiled"): Micros(1.0, 2.0)})
    for one in (timed(), flown):
        keep_parts(one, tmp_path)
    assert kept_parts(tmp_path) == (timed(),)
    assert kept_parts(tmp_path, "modular-flight") == (flown,)


def test_the_command_keeps_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "keep_parts", lambda one: keep_parts(one, tmp_path / "store"))
    (tmp_path / "times.toml").write_text(parts_text(timed()), encoding="utf-8")
    assert command.main([str(tmp_path / "times.toml")]) == 0
    assert kept_parts(tmp_path / "store") == (timed(),)
