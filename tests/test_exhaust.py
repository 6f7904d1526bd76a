"""The size and the figures of `make exhaust`, and that `make test` leaves its tests out."""

from __future__ import annotations

import pytest

from tests.exhaust import figures, share_of


@pytest.mark.parametrize(("share", "cases"), [(None, 1000), ("1", 1000), ("0.01", 10), ("1e-9", 1)])
def test_the_share_is_of_the_whole_and_at_least_one(monkeypatch, share, cases):
    monkeypatch.delenv("EXHAUST_SHARE", raising=False)
    if share is not None:
        monkeypatch.setenv("EXHAUST_SHARE", share)
    assert share_of(1000) == cases


def test_figures_are_summed_over_the_parts_of_a_test():
    def report(test: str, **properties: int) -> pytest.TestReport:
        return pytest.TestReport(
            test, (test, 0, test), {}, "passed", None, "call", duration=2, user_properties=[*properties.items()]
        )

    parts = [report("t.py::a[0]", kills=700), report("t.py::b"), report("t.py::a[1]", kills=600)]
    assert figures(parts) == ["t.py::a: 4 s, 1,300 kills", "t.py::b: 2 s"]


def test_only_make_exhaust_runs_what_is_marked(request):
    marked = [item for item in request.session.items if item.get_closest_marker("exhaust")]
    assert not marked or "exhaust" in request.config.option.markexpr
