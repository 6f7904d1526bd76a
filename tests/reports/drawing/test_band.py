"""A band is seen by its edges, however pale its shade is."""

from __future__ import annotations

from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from reports.drawing.band import SHADE, band
from tests.reports.explorer.test_palette import contrast


def test_its_edges_are_where_it_ends_and_stand_out_from_page_and_shade() -> None:
    axes = Figure().add_subplot()
    band(axes, -2, 3)
    assert [line.get_xdata()[0] for line in axes.lines] == [-2, 3]
    (span,) = axes.patches
    assert (span.get_x(), span.get_x() + span.get_width()) == (-2, 3)
    for line in axes.lines:
        assert contrast(to_hex(line.get_color()), "white") >= 3
        assert contrast(to_hex(line.get_color()), SHADE) >= 3
