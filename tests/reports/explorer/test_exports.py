"""What the page asks for: views as JSON, the schedule as a picture, tables to save."""

from __future__ import annotations

import csv
import io
import json
from contextlib import suppress
from fractions import Fraction
from typing import Any
from urllib.parse import quote, urlencode
from xml.etree import ElementTree

import pytest
from hypothesis import given as drawn
from hypothesis import settings
from hypothesis import strategies as st

from reports.explorer.answer import Answer
from reports.explorer.exports import flat, questions
from sched_sim.errors import InputError
from studies.explorer.given import Given
from studies.explorer.query import KEYS
from tests.fuzz.words import HOSTILE_TEXT, NUMBERS

ASKED = questions(Given())
QUERY = "N=10&M=4&L=8&hr_hz=400&processor=rp2040"
FILES = [path for path in ASKED if path != "/view"]


def view(query: str = QUERY) -> Any:
    return json.loads(ASKED["/view"](query).content)


def rows(path: str, query: str = QUERY) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(ASKED[path](query).content.decode())))


@pytest.mark.parametrize("path", FILES)
def test_a_file_has_its_name_and_is_the_same_every_time(path: str) -> None:
    answer = ASKED[path](QUERY)
    assert answer.file == path.removeprefix("/")
    assert answer.media == {"svg": "image/svg+xml", "csv": "text/csv"}[path.partition(".")[2]]
    assert ASKED[path](QUERY) == answer


@pytest.mark.parametrize("query", [QUERY, "", "N=10&M=4&cycles=3&method=larsen&speed=1.2"])
def test_the_picture_is_of_the_schedule_that_is_shown(query: str) -> None:
    drawing = ASKED["/schedule.svg"](query).content
    ElementTree.fromstring(drawing)
    misses = view(query)["schedule"]["misses"]
    assert (f"{misses} of" in drawing.decode()) == bool(misses)


def test_methods_and_parts_are_those_of_the_view() -> None:
    shown = view()
    methods, parts = rows("/methods.csv"), rows("/parts.csv")
    assert [row["method"] for row in methods] == [method["method"] for method in shown["methods"]]
    assert [row["name"] for row in parts] == [part["name"] for part in shown["parts"]]
    least = next(method for method in shown["methods"] if method["method"] == "dual-rate")["least"]
    (dual,) = (row for row in methods if row["method"] == "dual-rate")
    assert (float(dual["least"]), dual["least_exact"]) == (least["value"], least["exact"])
    assert dual["power_unit"] == shown["power"]["unit"]


def test_methods_that_are_refused_are_rows_with_the_reason() -> None:
    """Also the first, which then has fewer figures than others."""
    first, *_, last = rows("/methods.csv", "N=400&M=40&policy=edf")
    assert (first["method"], first["least"], first["least_exact"]) == ("standard", "", "")
    assert "choose it" in first["reason"]
    assert (last["method"], last["reason"]) == ("dual-rate", "")
    assert Fraction(last["least_exact"]) > 0


def test_jobs_are_in_periods_and_in_ms() -> None:
    shown = view()["schedule"]
    jobs = rows("/jobs.csv")
    assert [int(job["step"]) for job in jobs] == shown["jobs"]["step"]
    assert {job["row"] for job in jobs} <= {row["name"] for row in shown["rows"]}
    assert all(float(job["release_ms"]) == 2.5 * float(job["release"]) for job in jobs)
    assert "release_ms" not in rows("/jobs.csv", "N=10&M=4")[0]


def test_of_a_schedule_that_is_cut_every_job_says_so() -> None:
    long = "N=20000&M=4&L=8&method=larsen&speed=2"
    shown = view(long)["schedule"]
    assert shown["cut"]
    assert {job["cut"] for job in rows("/jobs.csv", long)} == {shown["cut"]}
    assert "cut" not in rows("/jobs.csv")[0]


def test_what_is_within_is_a_column_of_its_own() -> None:
    row = {
        "least": {"value": 0.5, "exact": "1/2"},
        "within": {"L": 3, "least": {"value": 1.0, "exact": "1"}},
        "std": None,
    }
    assert flat(row, ("std",)) == {
        "least": 0.5,
        "least_exact": "1/2",
        "within_L": 3,
        "within_least": 1.0,
        "within_least_exact": "1",
    }


PATHS = st.sampled_from(list(ASKED))
VALUES = st.sampled_from([*NUMBERS, *HOSTILE_TEXT, "m", "dual-rate", "larsen", "rp2040", "counted-9-3-3", "camera"])
PAIRS = st.lists(st.tuples(st.sampled_from([*KEYS, "tasks", "=", ""]), VALUES), max_size=3)


@settings(max_examples=40)
@drawn(path=PATHS, pairs=PAIRS, begun=st.booleans())
def test_any_query_is_answered_or_refused(path: str, pairs: list[tuple[str, str]], begun: bool) -> None:
    query = urlencode([*([("N", "10"), ("M", "4")] if begun else []), *pairs], errors="surrogatepass")
    with suppress(InputError):
        assert isinstance(ASKED[path](query), Answer)


@settings(max_examples=40)
@drawn(st.binary(max_size=30) | st.text(max_size=30).map(lambda text: quote(text, safe="=&").encode()))
def test_any_bytes_are_a_query_or_refused(query: bytes) -> None:
    with suppress(InputError):
        ASKED["/view"](query.decode("latin-1"))
