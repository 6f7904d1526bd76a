"""What the report says of the poster's code: its lines, the systems that share it, and what compiling gains."""

from __future__ import annotations

from reports.pages.numbers import significant, span
from studies.machines.parts import Micros
from studies.modular.shared_code import PARTS, POINTS, code_lines, systems
from tests.reports.modular.page import rows, stored, text


def test_lines_of_code_are_counted_from_it() -> None:
    assert f'**"Few lines of code": {code_lines(*PARTS)}** have these two' in text()
    assert f"sigma points {code_lines(*POINTS)} more" in text()
    assert [(row["System"], int(row["its own lines"])) for row in rows("systems.csv")] == [
        (each.name, each.lines) for each in systems()
    ]
    assert f"yes**, of {len(systems())} models of ours" in text()


def test_what_compiling_gains_is_a_ratio_of_two_times_of_one_measurement() -> None:
    """Over all measurements, of which the last is the one beside the page."""
    flights = stored().flights
    assert flights[-1] == stored().flown

    def gain(kind: str, way: str) -> str:
        def least(times: dict[tuple[str, str, str], Micros], which: str) -> float:
            return times[kind, "15", which].least

        ratios = [least(dict(one.parts), way) / least(dict(one.parts), "compiled") for one in flights]
        return span(significant(min(ratios), 2), significant(max(ratios), 2))

    for row in rows("compiled.csv"):
        assert row["times faster than Python †"] == gain(row["Predictor"], "reference")
        assert row["than NumPy †"] == gain(row["Predictor"], "numpy")
    assert f"by numba it runs {gain('unscented', 'reference')} times † as fast as in Python" in text()
    assert f"{gain('unscented', 'numpy')} times † as fast as with NumPy calls" in text()


def test_compiled_is_much_faster_than_python_and_than_numpy_calls() -> None:
    for one in stored().flights:
        for kind in ("unscented", "extended"):
            python, numpy, compiled = (one.parts[kind, "15", way].least for way in ("reference", "numpy", "compiled"))
            assert python > numpy > 50 * compiled
