"""What the text of the report on modular filters says of equal gaps: how far sampling rates are apart where as many
measurements get through."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from reports.modular.oscillator import OSCILLATOR_AMPLITUDES, Record
from reports.modular.tables import percent_of_amplitude
from studies.modular.oscillator import BORNE


class Point(NamedTuple):
    """Of `rates.svg`: a sampling rate, and its stored row."""

    rate: int
    row: Record

    @property
    def error(self) -> float:
        """Of position, in percent of the amplitude, of a typical run."""
        return 100 * float(self.row["error m"]) / OSCILLATOR_AMPLITUDES["position"]


def gap_words(by_rate: Mapping[int, Sequence[Record]]) -> dict[str, Any]:
    """by_rate: stored rows by measurements in a period."""
    gaps = points_by_gap(by_rate)
    ends = [edge(gaps[BORNE], key=lambda point: point.error) for edge in (min, max)]
    return {
        "at_the_gap": [
            {
                "error": percent_of_amplitude(point.row, "position"),
                "rate": point.rate,
                "lost": f"{100 * float(point.row['dropout']):g}",
            }
            for point in ends
        ],
        "about_at_the_gap": [f"{point.error:.1f}" for point in ends],
        "apart": f"{max(map(_apart, gaps.values())):.1f}",
    }


def points_by_gap(by_rate: Mapping[int, Sequence[Record]]) -> dict[float, list[Point]]:
    """By the mean time between measurements that get through, in periods, to the digits that are stored."""
    gaps: defaultdict[float, list[Point]] = defaultdict(list)
    for rate, rows in by_rate.items():
        for row in rows:
            gaps[float(row["interval"])].append(Point(rate, row))
    return dict(gaps)


def _apart(points: Sequence[Point]) -> float:
    errors = [point.error for point in points]
    return max(errors) / min(errors)
