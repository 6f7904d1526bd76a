"""The page of a scenario in a browser, answered without a server."""

from __future__ import annotations

from collections.abc import Callable
from urllib.parse import urlsplit

from playwright.sync_api import Page, Route

from reports.explorer.answer import Answer, document
from reports.explorer.guard import HEADERS
from reports.explorer.module import module, stylesheet
from reports.explorer.pages import SCENARIO
from reports.explorer.scenario_routes import scenario_questions
from sched_sim.errors import InputError
from studies.explorer.scenario_runs import Runs

HOST = "http://127.0.0.1:8400"
FILES: dict[str, tuple[Callable[[], str], str]] = {
    "/scenario": (SCENARIO.html, "text/html"),
    "/scenario.js": (lambda: module("scenario"), "text/javascript"),
    "/explorer.css": (stylesheet, "text/css"),
    "/favicon.ico": (lambda: "", "image/x-icon"),
}


def opened(page: Page, runs: Runs, query: str = "") -> Page:
    """Until the answer is drawn."""
    questions = scenario_questions(runs)

    def answer(route: Route) -> None:
        url = urlsplit(route.request.url)
        if url.path in FILES:
            text, media = FILES[url.path]
            route.fulfill(body=text(), headers=HEADERS, content_type=media)
            return
        try:
            found: Answer = questions[url.path](url.query)
        except InputError as error:
            found = document({"error": str(error)}, 422)
        route.fulfill(body=found.content, status=found.status, headers=HEADERS, content_type=found.media)

    page.route("**/*", answer)
    page.goto(f"{HOST}/scenario{query and f'?{query}'}")
    page.wait_for_selector("[data-shown]")
    page.wait_for_selector("[data-first]")
    return page
