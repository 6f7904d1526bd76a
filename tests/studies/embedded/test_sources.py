"""Costs by every source stand side by side: the same jobs, in the same units."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from filters.systems.example import example_system
from reports.embedded.results import shipped
from sched_sim.costs.table import Cost
from studies.embedded.sources import DESIGNS, EMULATED, FIRST, FORMS, METHODS, NATIVE, counted, relative_speed, table_of
from studies.measurement.methods import measure
from studies.steffes.tables import least_speeds


def test_relative_speeds_are_those_of_table_4() -> None:
    table = counted("textbook")
    for method, least in least_speeds(table, FIRST).items():
        assert relative_speed(table, method, FIRST) == least.speed


def test_a_faster_core_has_the_same_relative_speeds() -> None:
    table = counted("short")
    costs = {
        method: {kind: Cost(cost.minimum / 4, cost.median / 3, cost.p95 / 2) for kind, cost in kinds.items()}
        for method, kinds in table.costs.items()
    }
    faster = replace(table, costs=costs)
    for timing in DESIGNS:
        speeds = {relative_speed(faster, "larsen", timing, of) for of in ("minimum", "median", "p95")}
        assert speeds == {relative_speed(table, "larsen", timing)}


def test_every_source_has_the_jobs_of_every_method() -> None:
    emulated, _ = shipped()
    assert set(emulated) == {(source.name, form) for source in EMULATED for form in FORMS}
    for (name, form), table in emulated.items():
        assert {method: set(kinds) for method, kinds in table.costs.items()} == {
            method: set(counted(form).costs[method]) for method in METHODS
        }
        assert (table.name, table.unit, table.update_form) == (f"{name}-{form}", "instruction", form)


def test_counts_that_ship_are_of_the_same_system() -> None:
    for form in FORMS:
        anew = measure(example_system(9, 3, 3), "counted", form, name="anew", methods=["standard", "clone"])
        assert anew.costs == {method: counted(form).costs[method] for method in ("standard", "clone")}


def test_a_native_table_is_named_after_its_source(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    monkeypatch.setattr("studies.embedded.sources.measure", lambda *of, **more: asked.append((*of[1:], more["name"])))
    for source in NATIVE:
        table_of(source, "short")
    assert asked == [("c", "short", "c-short"), ("compiled", "short", "numba-short"), ("numpy", "short", "numpy-short")]


def test_the_first_design_is_one_of_them() -> None:
    assert FIRST in DESIGNS
    assert relative_speed(counted("textbook"), "dual-rate", FIRST) < Fraction(83, 100)
