"""Whom the explorer's server answers: its own page alone."""

from __future__ import annotations

import pytest

from reports.explorer.answer import Answer
from reports.explorer.guard import HEADERS
from studies.explorer.query import LONGEST
from tests.reports.explorer.serving import HERE, PORT, client

PATHS = ["/", "/explorer.js", "/explorer.css", "/favicon.ico", "/view?N=10", "/nothing"]


@pytest.mark.parametrize("host", [f"127.0.0.1:{PORT}", f"localhost:{PORT}", f"LOCALHOST:{PORT}"])
def test_it_answers_as_this_machine(host: str) -> None:
    assert client().get("/view?N=10", headers={"Host": host}).json() == {"query": "N=10"}


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize(
    "host", ["evil.example", f"evil.example:{PORT}", "127.0.0.1", f"127.0.0.1:{PORT + 1}", "", "[::1]"]
)
def test_another_host_is_refused(path: str, host: str) -> None:
    """A name that someone makes point here, and a forwarded port with another number."""
    answer = client().get(path, headers={"Host": host})
    assert answer.status_code == 400
    assert f"ssh -L {PORT}:127.0.0.1:{PORT}" in answer.text


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "BREW"])
def test_it_is_only_asked(path: str, method: str) -> None:
    answer = client().request(method, path)
    assert answer.status_code == 405
    assert answer.headers["Allow"] == "GET, HEAD"


@pytest.mark.parametrize("path", PATHS)
def test_head_has_the_headers_alone(path: str) -> None:
    head, got = client().request("HEAD", path), client().get(path)
    assert (head.status_code, head.content) == (got.status_code, b"")
    assert head.headers == got.headers


@pytest.mark.parametrize(("path", "host"), [*((path, f"127.0.0.1:{PORT}") for path in PATHS), ("/", "evil.example")])
def test_every_answer_tells_the_browser_what_it_may_do(path: str, host: str) -> None:
    answer = client().get(path, headers={"Host": host})
    assert {name: answer.headers[name] for name in HEADERS} == HEADERS
    assert "server" not in answer.headers


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_a_page_elsewhere_has_nothing_computed(site: str) -> None:
    asked: list[str] = []

    def question(query: str) -> Answer:
        asked.append(query)
        return Answer(b"")

    assert client(question).get("/view", headers={"Sec-Fetch-Site": site}).status_code == 403
    assert asked == []
    assert client().get("/explorer.js", headers={"Sec-Fetch-Site": site}).status_code == 403


@pytest.mark.parametrize(
    "origin", ["https://evil.example", "null", f"http://127.0.0.1:{PORT + 1}", f"https://127.0.0.1:{PORT}"]
)
def test_another_origin_has_nothing_computed(origin: str) -> None:
    assert client().get("/view", headers={"Origin": origin}).status_code == 403


def test_a_link_of_another_site_leads_to_the_page() -> None:
    assert client().get("/?N=10", headers={"Sec-Fetch-Site": "cross-site"}).status_code == 200


@pytest.mark.parametrize("headers", [{}, {"Sec-Fetch-Site": "none"}, {"Sec-Fetch-Site": "same-origin", "Origin": HERE}])
def test_the_page_itself_and_an_address_that_was_typed_are_answered(headers: dict[str, str]) -> None:
    assert client().get("/view?N=10", headers=headers).status_code == 200


def test_a_link_has_a_bound() -> None:
    assert client().get("/view?" + "x" * LONGEST).status_code == 200
    answer = client().get("/view?" + "x" * (LONGEST + 1))
    assert answer.status_code == 414
    assert str(LONGEST) in answer.text
