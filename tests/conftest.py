"""Settings for every test: no screen, and examples that are the same on every run unless asked otherwise."""

from __future__ import annotations

import asyncio
import gc
import os
import shlex
import signal
import sys
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from sched_sim.cli import main
from tests.command_line import Result, Run
from tests.exhaust import figures

# In the environment, so that child processes inherit it. BLAS is not loaded yet: its threads would be as many as the
# machine has cores, in each process of xdist, and wait for one another.
os.environ["MPLBACKEND"] = "Agg"
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job ignores it, and so would the tests'

ANY_TIME: dict[str, Any] = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}  # of a busy machine
settings.register_profile("ci", max_examples=10, derandomize=True, print_blob=True, **ANY_TIME)
settings.register_profile("thorough", max_examples=2000, print_blob=True, **ANY_TIME)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--shuffle", type=int, metavar="SEED", help="run the tests in a random order")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leaves out the tests marked `exhaust`, unless `-m` names them."""
    if config.option.shuffle is not None:
        Random(config.option.shuffle).shuffle(items)
    if "exhaust" not in config.option.markexpr:
        left_out = [item for item in items if item.get_closest_marker("exhaust")]
        if left_out:
            config.hook.pytest_deselected(items=left_out)
            items[:] = [item for item in items if not item.get_closest_marker("exhaust")]


def pytest_collection_finish() -> None:
    """What is there by now stays: it is not looked through each time that memory is collected."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 100)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> Generator[None, object, object]:
    """Leaves out the backend c where there is no C compiler."""
    from tests.c_compiler import has_c  # it loads BLAS

    callspec = getattr(item, "callspec", None)
    if callspec is not None and callspec.params.get("backend") == "c" and not has_c():
        pytest.skip("there is no C compiler")
    with _loop_of_a_browser_aside(item):
        return (yield)


@contextmanager
def _loop_of_a_browser_aside(item: pytest.Item) -> Iterator[None]:
    """Playwright leaves its event loop running in the thread of all tests, where no other can run beside it."""
    if "browser" in getattr(item, "fixturenames", ()):
        yield
        return
    loop = asyncio._get_running_loop()
    asyncio._set_running_loop(None)
    try:
        yield
    finally:
        asyncio._set_running_loop(loop)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, object, object]:
    with _loop_of_a_browser_aside(item):
        return (yield)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> Generator[None, object, object]:
    """With the last test of all the browser is closed, by its loop."""
    if nextitem is None:
        return (yield)
    with _loop_of_a_browser_aside(item):
        return (yield)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    if "exhaust" in config.option.markexpr:
        ran = [report for name in ("passed", "failed") for report in terminalreporter.stats.get(name, [])]
        terminalreporter.section("figures")
        for line in figures(report for report in ran if report.when == "call"):
            terminalreporter.write_line(line)


@pytest.fixture
def sched_sim(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Runs a command line in an empty folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "1000")  # no table and no message is wider

    def run(line: str) -> Result:
        monkeypatch.setattr(sys, "argv", ["sched-sim", *shlex.split(line)])
        try:
            main()
            code = 0
        except SystemExit as stop:
            code = int(stop.code or 0)
        return Result(code, *capsys.readouterr())

    return run
