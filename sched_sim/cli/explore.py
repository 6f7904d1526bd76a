"""`sched-sim explore`: designs drawn in a browser while they are changed."""

from __future__ import annotations

from importlib.util import find_spec
from time import monotonic
from typing import Annotated, Any

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
    """
    _check_extra()
    from reports.explorer.answer import Asked
    from reports.explorer.exports import questions
    from reports.explorer.port import HOST, USUAL, listening
    from reports.explorer.serve import serve
    from reports.explorer.server import application
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
    given = started(said, costs, processor, tasks)
    explore(given.start, given)
    with listening(port) as there:
        number = there.getsockname()[1]
        address = f"http://{HOST}:{number}/"
        first = f"{address}?{query_of(given.start)}"
        asked = Asked(say)
        app = application(number, questions(given), asked)
        print(f"The explorer is at {first}", flush=True)
        if port is None and number != USUAL:
            say(f"Port {USUAL} is in use, so it is at {number}")
        say("It answers this machine alone, until Ctrl-C")
        if not no_browser and has_screen():
            open_browser(first)
        elif not no_browser:
            say(no_screen_words(number))
        start = monotonic()
        serve(app, there)
    say(ended_words(asked, address, monotonic() - start))


def _check_extra() -> None:
    missing = [package for package in ("starlette", "uvicorn") if find_spec(package) is None]
    if missing:
        raise InputError(f'`sched-sim explore` needs {" and ".join(missing)}: pip install "sched-sim[explore]"')
