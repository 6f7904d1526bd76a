"""`sched-sim explore`: designs drawn in a browser while they are changed."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Annotated, Any

import typer

from sched_sim.cli import accuracy_flags as flags
from sched_sim.cli import options as opt
from sched_sim.cli.design import Within
from sched_sim.cli.design_flags import with_options
from sched_sim.cli.explore_shown import ended_words, has_screen, no_screen_words, open_browser
from sched_sim.cli.output import say
from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.design.options import Options
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from reports.explorer.answer import Question

PAGE = "Page"

FirstMethod = Annotated[
    str | None,
    typer.Option(
        "--method",
        help=f"The filter that the page begins with, beside all others: {', '.join(DELAYED_METHODS)}; by default "
        "dual-rate.",
        rich_help_panel=opt.DESIGN,
    ),
]
FirstCosts = Annotated[
    str | None,
    typer.Option(
        "--costs",
        help="Cost table: a shipped one by name, or your own TOML file by path; by default operations of filters of "
        "the model's size are counted, without a model steffes2014, with --processor counted-9-3-3.",
        rich_help_panel=opt.DESIGN,
    ),
]
OneScenario = Annotated[
    Path | None,
    typer.Option(
        "--scenario",
        help="TOML file of a predictor and several sensors: a page on its simulation, instead of designs. With --model "
        "and --output of the accuracy, if its file does not state them; without other options of designs.",
        rich_help_panel=PAGE,
    ),
]
Port = Annotated[
    int | None,
    typer.Option(
        "--port",
        help="Port of this machine at which the page is; by default 8400, or the next that is free; 0: any.",
        parser=lambda text: port_number(text),
        metavar="NUMBER",
        rich_help_panel=PAGE,
    ),
]
NoBrowser = Annotated[
    bool, typer.Option("--no-browser", help="Say the address, and open no browser.", rich_help_panel=PAGE)
]


def port_number(text: str) -> int:
    number = opt.none_or_more(text)
    if number > 65_535:
        raise typer.BadParameter(f"{number} is no port: give at most 65535.")
    return number


@with_options
def explore(
    context: typer.Context,
    N: opt.StepsOrNone = None,
    M: opt.AnyDelay = None,
    L: opt.FeedbackStep = None,
    hr_hz: opt.HrHz = None,
    measurement_hz: opt.MeasurementHz = None,
    delay_ms: opt.DelayMs = None,
    land_within_ms: opt.LandWithinMs = None,
    method: FirstMethod = None,
    model: flags.AnyModel = None,
    output: flags.Output = None,
    within: Within = None,
    metric: flags.Metric = "worst",
    costs: FirstCosts = None,
    statistic: opt.WhichCost = "minimum",
    processor: opt.OnProcessor = None,
    speed: opt.Speed = None,
    options: Options = Options(),
    tasks: opt.Tasks = None,
    cycles: opt.Cycles = 1,
    scenario: OneScenario = None,
    port: Port = None,
    no_browser: NoBrowser = False,
) -> None:
    """Explore designs in a browser: move a slider, and see the schedule, what each method needs, when its correction
    lands, how accurate the output is then, and which parts will do. What is given here is the design that the page
    begins with; your own cost table, part, model and tasks can be chosen in the page, too. It is served to this machine
    alone, and ends with the command, by Ctrl-C.

    sched-sim explore
    sched-sim explore --hr-hz 400 --measurement-hz 5 --delay-ms 110 --model ins-gps --within 0.4
    sched-sim explore -N 10 -M 4 --costs my-costs.toml --tasks tasks.toml
    sched-sim explore --hr-hz 200 --measurement-hz 10 --delay-ms 60 --processor my-part.toml --port 8500 --no-browser
    sched-sim explore --scenario rocket.toml
    """
    _check_extra()
    from reports.explorer.exports import questions

    if scenario is not None:
        if given := opt.given_options(context, lambda name: name not in OF_SCENARIOS):
            raise InputError(
                f"{', '.join(given)} and --scenario {scenario} exclude each other: the file says what is simulated"
            )
        from reports.explorer.scenario_routes import scenario_questions
        from sched_sim.cli.explore_start import begun
        from studies.explorer.given import Given

        _serve(port, "scenario", questions(Given()) | scenario_questions(begun(scenario, model, output)), no_browser)
        return
    from sched_sim.cli.explore_start import started
    from studies.explorer.query import query_of
    from studies.explorer.view import explore

    values: dict[str, Any] = {
        "N": N,
        "M": M,
        "L": L,
        "hr_hz": hr_hz,
        "measurement_hz": measurement_hz,
        "delay_ms": delay_ms,
        "land_within_ms": land_within_ms,
        "method": method,
        "model": model,
        "output": output,
        "within": within,
        "metric": metric,
        "statistic": statistic,
        "speed": speed,
        "options": options,
        "cycles": cycles,
    }
    said = {name: value for name, value in values.items() if value is not None}
    own = started(said, costs, processor, tasks)
    explore(own.start, own)
    _serve(port, f"?{query_of(own.start)}", questions(own), no_browser)


OF_SCENARIOS = ("scenario", "model", "output", "port", "no_browser")


def _serve(port: int | None, page: str, questions: Mapping[str, Question], no_browser: bool) -> None:
    """Until Ctrl-C. page: the address that is said and opened, behind that of the server."""
    from reports.explorer.answer import Asked
    from reports.explorer.port import HOST, USUAL, listening
    from reports.explorer.serve import serve
    from reports.explorer.server import application

    with listening(port) as there:
        number = there.getsockname()[1]
        address = f"http://{HOST}:{number}/"
        asked = Asked(say)
        app = application(number, questions, asked)
        print(f"The explorer is at {address}{page}", flush=True)
        if port is None and number != USUAL:
            say(f"Port {USUAL} is in use, so it is at {number}")
        say("It answers this machine alone, until Ctrl-C")
        if not no_browser and has_screen():
            open_browser(f"{address}{page}")
        elif not no_browser:
            say(no_screen_words(number))
        start = monotonic()
        serve(app, there)
    say(ended_words(asked, address, monotonic() - start))


def _check_extra() -> None:
    missing = [package for package in ("starlette", "uvicorn") if find_spec(package) is None]
    if missing:
        raise InputError(f'`sched-sim explore` needs {" and ".join(missing)}: pip install "sched-sim[explore]"')
