"""The colours of what is drawn in a browser."""

from __future__ import annotations

import re

import pytest
from matplotlib.colors import to_hex, to_rgb

from reports.drawing.style import FILLS, INK, METHOD_LINES, SOURCES, TASK_FILLS, Fill
from reports.explorer.module import asset

COLOURS = {
    name: (light, dark)
    for name, light, dark in re.findall(r"--ss-([\w-]+): light-dark\((#\w{6}), (#\w{6})\);", asset("palette.css"))
}
LIGHT, DARK = range(2)
WORK: dict[str, Fill] = {**FILLS, **{f"task{number}": fill for number, fill in enumerate(TASK_FILLS)}}
TEXTS = ("ink", "grey", "accent", "red", "warn", "ok")


def luminance(colour: str) -> float:
    """As the Web Content Accessibility Guidelines define it."""
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in to_rgb(colour))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    dark, light = sorted(map(luminance, (one, other)))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("label", WORK)
def test_in_the_light_work_looks_as_in_print(label: str) -> None:
    fill, ink = WORK[label].colour, to_hex(WORK[label].ink)
    readable = WORK[label].hatch or contrast(fill, ink) >= 4.5
    assert COLOURS[f"fill-{label}"][LIGHT] == fill
    assert COLOURS[f"ink-{label}"][LIGHT] == (ink if readable else INK)


@pytest.mark.parametrize("method", METHOD_LINES)
def test_in_the_light_methods_look_as_in_print(method: str) -> None:
    assert COLOURS[f"method-{method}"][LIGHT] == METHOD_LINES[method].colour


@pytest.mark.parametrize("label", WORK)
def test_in_the_light_work_stands_out_from_the_page_by_itself_or_by_its_outline(label: str) -> None:
    fill = WORK[label]
    assert max(contrast(fill.colour, "white"), contrast(fill.ink, "white") if fill.edge_pt else 1) >= 3


@pytest.mark.parametrize("source", SOURCES)
def test_sources_stand_out_from_the_page(source: str) -> None:
    assert contrast(SOURCES[source].colour, "white") >= 3


def test_lines_differ_without_colour() -> None:
    for lines in (METHOD_LINES, SOURCES):
        assert len({line.marker for line in lines.values()}) == len(lines)
        assert len({line.dashes for line in lines.values()}) == len(lines)


def test_it_has_no_other_work_and_no_other_methods() -> None:
    named = {f"{kind}-{label}" for label in WORK for kind in ("fill", "ink")}
    named |= {f"method-{method}" for method in METHOD_LINES}
    assert {name for name in COLOURS if "-" in name} == named


@pytest.mark.parametrize("label", WORK)
def test_in_the_dark_work_stands_out_from_the_ground_and_its_label_from_it(label: str) -> None:
    fill, ink = COLOURS[f"fill-{label}"][DARK], COLOURS[f"ink-{label}"][DARK]
    assert contrast(fill, COLOURS["ground"][DARK]) >= 3
    if WORK[label].hatch:
        assert contrast(COLOURS["ink"][DARK], fill) >= 4.5
        assert contrast(ink, fill) >= 2.5
    else:
        assert contrast(ink, fill) >= 4.5


@pytest.mark.parametrize("theme", [LIGHT, DARK])
@pytest.mark.parametrize("method", METHOD_LINES)
def test_methods_stand_out_from_the_ground(method: str, theme: int) -> None:
    assert contrast(COLOURS[f"method-{method}"][theme], COLOURS["ground"][theme]) >= 3


@pytest.mark.parametrize("theme", [LIGHT, DARK])
@pytest.mark.parametrize("ground", ["ground", "raised"])
def test_texts_can_be_read_and_controls_seen(ground: str, theme: int) -> None:
    under = COLOURS[ground][theme]
    assert {
        name: contrast(COLOURS[name][theme], under) for name in TEXTS if contrast(COLOURS[name][theme], under) < 4.5
    } == {}
    assert contrast(COLOURS["line"][theme], under) >= 3
