"""One question at a time, the latest of those that came meanwhile, and what happens when an answer does not come."""

from __future__ import annotations

from typing import Any

import pytest

from tests.browser import Visit
from tests.reports.explorer.scripts import loaded

START = """() => {
  window.heard = [];
  window.calls = [];
  const hear = (kind) => (...what) => heard.push([kind, ...what]);
  const kinds = ["answered", "refused", "waiting", "gone", "stopped"];
  const told = Object.fromEntries(kinds.map((kind) => [kind, hear(kind)]));
  window.asking = ask.asker((query) => new Promise((resolve, reject) => calls.push({query, resolve, reject})), told);
}"""


@pytest.fixture
def page(visit: Visit) -> Any:
    """A page with `asking`, the `calls` that it has made, each to be answered by the test, and what was `heard`."""
    loaded(visit, "ask")
    visit.page.evaluate(START)
    return visit.page


def do(page: Any, script: str) -> Any:
    """After it has run, all that it makes happen has."""
    page.evaluate(f"async () => {{ {script}; await new Promise((resolve) => setTimeout(resolve)); }}")
    return page.evaluate("heard")


def asked(page: Any) -> list[str]:
    queries: list[str] = page.evaluate("calls.map(({query}) => query)")
    return queries


def test_one_is_under_way_and_only_the_last_is_remembered(page: Any) -> None:
    do(page, 'for (const query of "abcd") asking.want(query)')
    assert asked(page) == ["a"]
    heard = do(page, "calls[0].resolve(1)")
    assert asked(page) == ["a", "d"]
    assert heard == [["answered", 1, "a"]]
    assert do(page, "calls[1].resolve(4)")[-1] == ["answered", 4, "d"]
    assert asked(page) == ["a", "d"]


def test_after_a_refusal_it_goes_on(page: Any) -> None:
    do(page, 'asking.want("a")')
    assert do(page, 'calls[0].reject(new Error("no"))') == [["refused", "no", "a"]]
    do(page, 'asking.want("b")')
    assert asked(page) == ["a", "b"]


def test_a_refusal_of_what_nobody_wants_any_more_is_not_heard(page: Any) -> None:
    do(page, 'asking.want("a"); asking.want("b")')
    assert do(page, 'calls[0].reject(new Error("no"))') == []
    assert asked(page) == ["a", "b"]


def test_a_late_answer_is_not_heard_after_stop(page: Any) -> None:
    do(page, 'asking.want("a"); asking.stop(); asking.want("b")')
    heard = do(page, "calls[1].resolve(2); calls[0].resolve(1)")
    assert heard == [["stopped"], ["answered", 2, "b"]]


def test_nobody_there_is_asked_again_for_the_latest(page: Any) -> None:
    do(page, 'asking.want("a")')
    assert do(page, 'calls[0].reject(Object.assign(new Error("gone"), {gone: true}))') == [["gone", "gone"]]
    do(page, 'asking.want("b")')
    page.wait_for_function("calls.length === 2")
    assert asked(page) == ["a", "b"]


def test_it_says_how_long_it_waits(page: Any) -> None:
    page.clock.install()
    page.evaluate('asking.want("a")')
    page.clock.run_for(2000)
    assert page.evaluate("heard") == [["waiting", 1], ["waiting", 2]]
    page.evaluate("calls[0].resolve(1)")
    page.clock.run_for(2000)
    assert page.evaluate("heard.slice(2)") == [["answered", 1, "a"]]


def test_what_is_asked_beside_waits_for_its_turn(page: Any) -> None:
    do(page, 'asking.aside("x").then((view) => heard.push(["aside", view])); asking.want("a"); asking.want("b")')
    assert asked(page) == ["x"]
    do(page, 'calls[0].resolve(0); asking.aside("y")')
    assert asked(page) == ["x", "b"]
    assert do(page, "calls[1].resolve(2)") == [["aside", 0], ["answered", 2, "b"]]
    assert asked(page) == ["x", "b", "y"]


def test_after_destroy_nothing_is_heard(page: Any) -> None:
    do(page, 'asking.want("a"); asking.want("b"); asking.destroy()')
    assert do(page, "calls[0].resolve(1)") == []
    assert asked(page) == ["a"]
