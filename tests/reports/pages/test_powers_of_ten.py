"""Very small numbers are written in one way in all reports: as 3 × 10⁻¹⁶, not as programs print them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.pages.machine import residue
from reports.pages.numbers import power, raised

TEMPLATES = sorted((Path(__file__).parents[3] / "reports" / "templates").glob("*.md.j2"))
LOWERED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_it_is_the_number_that_is_printed_and_does_not_break(value: float) -> None:
    printed = residue(value)
    digits, times, exponent = power(printed).rpartition("\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}")
    digits = digits if times else "1"
    assert " " not in exponent
    assert float(f"{digits}e{exponent.removeprefix('10').translate(LOWERED)}") == float(printed)
    assert exponent == raised(printed.partition("e")[2])


@pytest.mark.parametrize("text", ["-", "step 1", "0.25", "3 to 1e-5", "attitude", ""])
def test_other_texts_stay(text: str) -> None:
    assert power(text) == text


@pytest.mark.parametrize("template", TEMPLATES, ids=lambda path: path.name)
def test_no_template_writes_one_as_programs_do(template: Path) -> None:
    assert not re.findall(r"\b\d+e[-−]?\d+\b", template.read_text(encoding="utf-8"))
