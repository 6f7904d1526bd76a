"""What the explorer's server answers to its page."""

from __future__ import annotations

from threading import Event

import pytest

from reports.explorer import answer as answers
from reports.explorer.answer import NO_MEMORY, UNEXPECTED, Answer
from reports.explorer.compact import compact
from reports.explorer.module import module, stylesheet
from reports.explorer.pages import DESIGNS
from sched_sim.errors import InputError
from tests.reports.explorer.serving import client


def raising(error: BaseException) -> Answer:
    raise error


def test_the_page_its_script_and_its_style() -> None:
    for path, text, media in [
        ("/", DESIGNS.html(), "text/html"),
        ("/explorer.js", compact(module("page")), "text/javascript"),
        ("/explorer.css", compact(stylesheet()), "text/css"),
    ]:
        answer = client().get(path)
        assert (answer.status_code, answer.text) == (200, text)
        assert answer.headers["Content-Type"] == f"{media}; charset=utf-8"


def test_the_query_is_asked_as_it_is() -> None:
    assert client().get("/view?a=1&a=2&b=%2F+x").json() == {"query": "a=1&a=2&b=%2F+x"}
    assert client().get("/view").json() == {"query": ""}


def test_what_is_saved_has_a_name() -> None:
    answer = client(lambda _query: Answer(b"a,b\n", "text/csv", "parts.csv")).get("/view")
    assert answer.headers["Content-Disposition"] == 'attachment; filename="parts.csv"'
    assert answer.headers["Content-Type"] == "text/csv; charset=utf-8"


def test_what_the_user_can_mend_is_said_in_its_own_words() -> None:
    said: list[str] = []
    answer = client(lambda _query: raising(InputError("N is 0: give at least 1")), said.append).get("/view?N=0")
    assert (answer.status_code, answer.json(), said) == (422, {"error": "N is 0: give at least 1"}, [])


def test_memory_that_ran_out_is_said() -> None:
    assert client(lambda _query: raising(MemoryError())).get("/view").json() == {"error": NO_MEMORY}


@pytest.mark.parametrize("error", [ZeroDivisionError("/etc/secret.py"), SystemExit("secret"), RecursionError()])
def test_what_nobody_thought_of_is_shown_at_the_terminal_alone_and_the_server_goes_on(error: BaseException) -> None:
    said: list[str] = []
    asked = client(lambda query: raising(error) if query == "bad" else Answer(b"good"), said.append)
    answer = asked.get("/view?bad")
    assert (answer.status_code, answer.json()) == (500, {"error": UNEXPECTED})
    (words,) = said
    assert words.startswith("Unexpected, at /view?bad:\nTraceback")
    assert type(error).__name__ in words
    assert asked.get("/view?good").content == b"good"


@pytest.mark.parametrize(
    "path", ["/nothing", "/view.py", "/../pyproject.toml", "/%2e%2e/pyproject.toml", "/js/svg.js", "//etc/passwd"]
)
def test_there_is_nothing_else(path: str) -> None:
    answer = client().get(path)
    assert answer.status_code == 404
    assert answer.text == "There is nothing here: the explorer is at /\n"


def test_what_takes_long_is_told_once_with_its_query(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    told = Event()

    def tell(words: str) -> None:
        said.append(words)
        told.set()

    def slow(_query: str) -> Answer:
        assert told.wait(60)
        return Answer(b"")

    monkeypatch.setattr(answers, "SLOW_S", 0.01)
    assert client(slow, tell).get("/view?N=10").status_code == 200
    assert said == ["Slow: computing for 0.01 s so far: /view?N=10"]


def test_what_does_not_is_not_told(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    monkeypatch.setattr(answers, "SLOW_S", 60.0)
    client(tell=said.append).get("/view")
    assert said == []
