"""What is said of shared code is counted from it."""

from __future__ import annotations

from filters.modular import correctors, predictors
from filters.systems import rocket_filter, spring_mass
from studies.modular.shared_code import KINDS, PARTS, _lines, code_lines, systems

SOURCE = '''"""What it is."""

import math  # a line of code


@property
def area(r: float) -> float:
    """A docstring
    of two lines."""
    # a comment

    return (
        math.pi * r * r
    )
LIMIT = """a text that
counts"""
"""What the limit is."""
'''


def test_lines_of_code_are_those_without_blanks_comments_and_docstrings() -> None:
    assert len(_lines(SOURCE)) == 8


def test_the_same_modules_make_the_parts_of_every_system() -> None:
    found = systems()
    made = [spring_mass.tracker(0.1, 1.0, spring_mass.Instrument(1.0), spring_mass.Instrument(1.0))]
    made += [rocket_filter.rocket_filter(), rocket_filter.rocket_filter("extended")]
    for each in made:
        assert each.predictor.predict.__module__ == predictors.__name__
        assert {sensor.corrector.expect.__module__ for sensor in each.sensors} == {correctors.__name__}
    assert {kind for each in found for kind in each.predictors} == set(KINDS)
    assert {kind for each in found for kind in each.correctors} == set(KINDS)
    rocket = next(each for each in found if each.name == "rocket")
    assert (rocket.states, rocket.predictors) == ((15, 15), ("extended", "unscented"))
    assert rocket.correctors == KINDS


def test_a_system_has_fewer_lines_than_the_parts_that_it_shares() -> None:
    assert all(0 < each.lines < code_lines(*PARTS) for each in systems())
