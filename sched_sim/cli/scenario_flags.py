"""Options of `simulate --scenario` that ask for the accuracy along the simulation."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import typer

from sched_sim.cli import options as opt
from sched_sim.cli.accuracy_flags import ACCURACY
from sched_sim.errors import InputError
from sched_sim.ticks import exact, positive

ScenarioModel = Annotated[
    str | None,
    typer.Option(
        "--model",
        help="With --scenario: also the accuracy of the output, exactly, for what landed when: package.module:function "
        "that returns a filters.accuracy.SensorsModel (Phi, Q, H and R of each sensor), a ModularFilter, or for one "
        "sensor a System or LinearModel; or ins-gps, ins-rtk, star-tracker, camera. By default the scenario's filter.",
        rich_help_panel=ACCURACY,
    ),
]
ScenarioOutput = Annotated[
    str | None,
    typer.Option(
        "--output",
        help="The states whose accuracy is asked for, together: position=0:3 (0, 1 and 2), 0,2,5, or the name of an "
        "output of a shipped model, by default its first.",
        rich_help_panel=ACCURACY,
    ),
]
ScenarioUnit = Annotated[
    str | None,
    typer.Option(
        "--unit", help="Of these outputs, such as m; that of a shipped model is known.", rich_help_panel=ACCURACY
    ),
]
StartStd = Annotated[
    str | None,
    typer.Option(
        "--initial-std",
        help="Standard deviation of each state in step 0; by default what they settle to without delay. The figures "
        "are from the step on in which it no longer matters.",
        metavar="NUMBERS",
        rich_help_panel=ACCURACY,
    ),
]
TimesSlower = Annotated[
    list[str] | None,
    typer.Option(
        "--times-slower",
        help="Also on a processor so many times as slow, its tasks too: what that costs of the accuracy. Repeatable.",
        metavar="NUMBER",
        rich_help_panel=ACCURACY,
    ),
]


Rare = Annotated[
    bool,
    typer.Option(
        "--rare",
        help="With --scenario: also the probability of misses too rare for a simulation, of each kind of job of which "
        "none missed, by 200 runs that are split near the deadlines.",
        rich_help_panel=opt.OUTPUT,
    ),
]


class Asked(NamedTuple):
    """As it was given; None: the scenario's file says it."""

    model: str | None
    output: str | None
    unit: str | None
    initial_std: str | None
    times_slower: list[str] | None

    @property
    def anything(self) -> bool:
        return any(given is not None for given in self)

    @property
    def start(self) -> list[float] | None:
        """Raises InputError for what is no number."""
        if self.initial_std is None:
            return None
        return [float(exact(part.strip(), "--initial-std")) for part in self.initial_std.split(",")]

    @property
    def slower(self) -> list[tuple[str, float]]:
        """As it was given, and the number. Raises InputError for what is none above 0."""
        if len(self.times_slower or ()) > MOST_SLOWER:
            raise InputError(
                f"--times-slower is given {len(self.times_slower or ())} times: give at most {MOST_SLOWER}"
            )
        return [(text, float(positive(text, "--times-slower"))) for text in self.times_slower or ()]


MOST_SLOWER = 20
NOTHING_ASKED = Asked(None, None, None, None, None)
