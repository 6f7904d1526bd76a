"""`sched-sim explore` until its server starts, and what it says when that ends."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import pytest

from sched_sim.cli import explore as command
from sched_sim.cli.explore_shown import ended_words, has_screen, no_screen_words
from tests.command_line import Run, is_refused

pytest.importorskip("uvicorn", reason="the extra explore is not installed")

from reports.explorer import serve
from reports.explorer.answer import Answer, Asked
from reports.explorer.pages import SCENARIO
from tests.reports.explorer.serving import Client
from tests.scenarios import ROCKET

MODEL = """
from filters.accuracy.shipped import SHIPPED_MODELS
def made():
    return SHIPPED_MODELS["camera"].model(400.0)
"""
COSTS = 'name = "mine"\nunit = "operation"\n[operations.larsen]\n'
TASKS = '[[task]]\nname = "control"\nhz = 400\ncost_us = 1\noffset_ms = 0\npriority = 5\n'


@pytest.fixture
def started(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Runs a command line without a browser; the query of its address, and a client of what it would serve."""
    served: list[Client] = []
    monkeypatch.setattr(serve, "serve", lambda app, there: served.append(Client(app, there.getsockname()[1])))

    def start(line: str) -> tuple[str, Client]:
        result = sched_sim(f"explore --no-browser --port 0 {line}")
        assert result.code == 0, result.err
        (query,) = re.findall(r"^The explorer is at http://127\.0\.0\.1:\d+/\??(.*)$", result.out, re.M)
        return query, served.pop()

    return start


@pytest.mark.parametrize(
    ("line", "query"),
    [
        ("", "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps"),
        ("--within 0.4", "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps&within=0.4"),
        ("--method larsen --cpus 2", "hr_hz=400&measurement_hz=5&delay_ms=110&method=larsen&model=ins-gps&cpus=2"),
        ("--model star-tracker", "model=star-tracker"),
        ("-N 10 -M 4", "N=10&M=4"),
        ("-N 10 -M 4 -L 8 --speed 4/5 --cycles 2", "N=10&M=4&L=8&speed=0.8&cycles=2"),
        ("-N 40 -M 4 --hr-hz 400 --processor rp2040", "N=40&M=4&hr_hz=400&processor=rp2040"),
    ],
)  # fmt: skip
def test_the_page_begins_with_what_was_given(started: Any, line: str, query: str) -> None:
    first, client = started(line)
    assert first == query
    begun = client.get("/view").json()
    assert begun["query"] == client.get(f"/view?{query}").json()["query"]


def test_ones_own_are_offered_by_name_and_no_link_names_a_file(
    started: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from sched_sim.costs.table_file import TABLES
    from sched_sim.processors.part_file import SHIPPED

    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "secret").mkdir()
    costs = (
        (TABLES / "counted-9-3-3.toml").read_text(encoding="utf-8").replace('name = "counted-9-3-3"', 'name = "mine"')
    )
    (tmp_path / "secret/costs.toml").write_text(costs, encoding="utf-8")
    (tmp_path / "secret/part.toml").write_text((SHIPPED / "rp2040.toml").read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "secret/tasks.toml").write_text(TASKS, encoding="utf-8")
    (tmp_path / "explored.py").write_text(MODEL, encoding="utf-8")
    files = "--costs secret/costs.toml --processor secret/part.toml --tasks secret/tasks.toml"
    query, client = started(f"-N 10 -M 4 --hr-hz 400 {files} --model explored:made --output 0")
    view = client.get(f"/view?{query}").json()
    assert query == "N=10&M=4&hr_hz=400&costs=mine&processor=rp2040&model=explored:made&output=0"
    assert view["choices"]["costs"][0] == "mine"
    assert "control" in [row["name"] for row in view["schedule"]["rows"]]
    assert "--costs secret/costs.toml" in view.pop("commands")["shell"]  # as it was given, to go on from there
    assert "secret" not in str(view)
    refused = client.get("/view?N=10&M=4").json()["error"]
    assert "'tasks.toml'" in refused
    assert "secret" not in refused


def test_a_scenario_has_a_page_beside_that_of_designs(started: Any) -> None:
    page, client = started(f"--scenario {ROCKET}")
    assert page == "scenario"
    view = client.get("/scenario/view").json()
    steps = client.get("/scenario/schedule?first=0&until=10").json()
    assert steps["steps"] == view["steps"]
    assert client.get("/scenario").text == SCENARIO.html()
    assert client.get("/scenario.js").status_code == client.get("/view").status_code == 200


def test_without_a_scenario_there_is_no_page_of_it(started: Any) -> None:
    _, client = started("-N 10 -M 4")
    assert [client.get(path).status_code for path in ("/scenario", "/scenario.js", "/scenario/view")] == [404] * 3


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("--scenario none.toml", ["--scenario 'none.toml'"]),
        (f"--scenario {ROCKET} -N 10 --cpus 2", ["-N, --cpus and --scenario", "exclude each other"]),
        (f"--scenario {ROCKET} --model ins-gps", ["--model"]),
    ],
)
def test_a_scenario_that_cannot_be_is_refused(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(f"explore --no-browser {line}"), said)


@pytest.mark.parametrize(
    "query",
    [
        "N=10&M=4&costs=secret.toml",
        "N=10&M=4&costs=./secret",
        "N=10&M=4&hr_hz=400&processor=secret.toml",
        "N=10&M=4&model=secret:made",
        "N=10&M=4&tasks=secret.toml",
    ],
)
def test_a_link_reads_and_runs_nothing(started: Any, tmp_path: Path, query: str) -> None:
    """Not even what is there."""
    (tmp_path / "secret.toml").write_text("broken", encoding="utf-8")
    (tmp_path / "secret.py").write_text("raise SystemExit(7)", encoding="utf-8")
    _, client = started("")
    answer = client.get(f"/view?{query}")
    assert answer.status_code == 422
    assert "unknown" in answer.json()["error"]
    assert "broken" not in answer.text


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("-N 0 -M 4", ["-N is 0"]),
        ("-N 10", ["-M is missing"]),
        ("-N 10 -M 4 --hr-hz 0", ["--hr-hz"]),
        ("--delay-ms 110", ["--delay-ms", "--hr-hz 400"]),
        ("--method multirate", ["--method 'multirate'", "choose from"]),
        ("--costs none.toml", ["--costs", "'none.toml' not found"]),
        ("--processor none.toml", ["--processor 'none.toml'"]),
        ("--tasks none.toml", ["--tasks 'none.toml'"]),
        ("--model nothing:made", ["--model 'nothing:made'"]),
        ("-N 10 -M 4 --within 0.4", ["--within", "--model"]),
        ("--port 70000", ["70000 is no port"]),
        ("--port -1", ["-1 is too small"]),
    ],
)
def test_what_cannot_be_is_refused_before_anything_is_served(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(f"explore --no-browser {line}"), said)


def test_a_port_in_use_is_refused_where_it_was_asked_for(sched_sim: Run) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        is_refused(sched_sim(f"explore --no-browser --port {port}"), [f"--port {port}", "leave --port out"])


@pytest.mark.parametrize("package", ["starlette", "uvicorn"])
def test_without_the_extra_it_says_how_to_get_it(sched_sim: Run, monkeypatch: pytest.MonkeyPatch, package: str) -> None:
    monkeypatch.setattr(command, "find_spec", lambda name: None if name == package else find_spec(name))
    is_refused(sched_sim("explore"), [f"needs {package}", 'pip install "sched-sim[explore]"'])


@pytest.mark.parametrize(
    ("environment", "seen"),
    [
        ({"DISPLAY": ":0"}, True),
        ({"WAYLAND_DISPLAY": "wayland-0"}, True),
        ({"SSH_CONNECTION": "a 1 b 2", "DISPLAY": "localhost:10.0"}, True),
        ({"SSH_CONNECTION": "a 1 b 2"}, False),
        ({"SSH_CONNECTION": "a 1 b 2", "BROWSER": "opens-where-i-sit"}, True),
        ({}, False),
    ],
)
def test_a_browser_is_opened_where_it_is_seen(
    monkeypatch: pytest.MonkeyPatch, environment: dict[str, str], seen: bool
) -> None:
    monkeypatch.setattr("sys.platform", "linux")
    assert has_screen(environment) is seen


def test_it_opens_the_browser_and_ends_by_ctrl_c(tmp_path: Path) -> None:
    browser, opened = tmp_path / "browser", tmp_path / "opened"
    os.mkfifo(opened)
    browser.write_text(f'#!/bin/sh\necho "$1" > {opened}\n', encoding="utf-8")
    browser.chmod(0o755)
    environment = {**os.environ, "BROWSER": str(browser), "PYTHONUNBUFFERED": "1"}
    run = [sys.executable, "-m", "sched_sim", "explore", "--port", "0", "-N", "10", "-M", "4"]
    with subprocess.Popen(
        run, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stdout is not None
        address = process.stdout.readline().split()[-1]
        with urlopen(address.replace("/?", "/view?")) as answer:
            assert answer.status == 200
        assert opened.read_text(encoding="utf-8") == f"{address}\n"
        os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (0, "")
    assert err.splitlines()[0] == "It answers this machine alone, until Ctrl-C"
    assert re.fullmatch("Ended after .* s: 1 answered, the slowest in .* s", err.splitlines()[1])
    assert err.splitlines()[2].strip() == f"The last design was {address}"


def test_over_ssh_it_says_how_to_forward_the_port() -> None:
    assert "ssh -L 8400:127.0.0.1:8400" in no_screen_words(8400, {"SSH_CONNECTION": "a 1 b 2"})
    assert "ssh" not in no_screen_words(8400, {})


def test_at_the_end_it_says_what_was() -> None:
    asked = Asked(print)
    assert re.fullmatch("Ended after 3 s: 0 answered", ended_words(asked, "http://here/", 3.2))
    asked.answer("/view", lambda _query: Answer(b""), "N=10")
    asked.answer("/view", lambda _query: 1 / 0, "N=11")  # type: ignore[arg-type, return-value]
    words, last = ended_words(asked, "http://here/", 600).split("\n")
    assert re.fullmatch("Ended after 10 min: 1 answered, 1 failed, the slowest in .* s", words)
    assert last == "The last design was http://here/?N=10"
