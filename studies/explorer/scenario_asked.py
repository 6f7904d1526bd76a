"""What a link to a scenario's page says, as one record, and as its query."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from typing import Any
from urllib.parse import quote, urlencode

from sched_sim.bounds import at_least_one, short, whole
from sched_sim.errors import InputError, option
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.workload import kinds_of_jobs
from sched_sim.text import visible
from sched_sim.ticks import Number, positive
from studies.explorer.query import number_text, pairs_of, whole_number

MOST_JOBS = 1_000_000
"""Of one run: some ten seconds, and a hundred megabytes."""
MOST_SPAN = 500
"""HR steps shown at once."""
LEAST_TIMES, MOST_TIMES = Fraction(1, 1000), Fraction(1000)


@dataclass(frozen=True, slots=True)
class ScenarioAsked:
    """seed, steps: instead of the scenario's own. times_slower: the processor is so many times as slow, kept exactly.

    exact, accuracy: whether what may take long is asked for. shown: of which kind of job the distribution is, its name
    as it is or made `visible`. at, span: the first step of the trace that is shown, and how many.
    Raises InputError that names the argument, its value and the remedy.
    """

    seed: int | None = None
    steps: int | None = None
    times_slower: Number = Fraction(1)
    exact: bool = False
    accuracy: bool = False
    shown: str | None = None
    at: int | None = None
    span: int | None = None

    def __post_init__(self) -> None:
        for name, least, most in (("seed", 0, 2**63), ("steps", 1, MOST_JOBS), ("at", 0, MOST_JOBS)):
            value = getattr(self, name)
            if value is not None and whole(value, option(name), most) < least:
                raise InputError(f"{option(name)} is {short(value)}: give at least {least}")
        if self.span is not None:
            at_least_one(whole(self.span, option("span"), MOST_SPAN), option("span"))
        times = positive(self.times_slower, option("times_slower"))
        if not LEAST_TIMES <= times <= MOST_TIMES:
            raise InputError(
                f"{option('times_slower')} is {short(self.times_slower)}: give a number from {float(LEAST_TIMES):g} to "
                f"{float(MOST_TIMES):g}"
            )
        object.__setattr__(self, "times_slower", times)

    def of(self, scenario: Scenario) -> Scenario:
        """The scenario that is meant. Raises InputError for more steps than are simulated here, for a kind of job that
        it does not have, and as `Scenario`."""
        most = most_steps(scenario)
        if self.steps is not None and self.steps > most:
            raise InputError(
                f"{option('steps')} is {short(self.steps)}: give at most {most:,}, which are a million jobs; "
                f"`sched-sim simulate --scenario` simulates more"
            )
        kinds = [visible(kind) for kind in kinds_of_jobs(scenario)]
        if self.shown is not None and visible(self.shown) not in kinds:
            raise InputError(f"{option('shown')} is {short(repr(self.shown))}: choose from {', '.join(kinds)}")
        return replace(
            scenario,
            seed=scenario.seed if self.seed is None else self.seed,
            steps=min(scenario.steps, most) if self.steps is None else self.steps,
            speed=scenario.speed / Fraction(self.times_slower),
        )


def most_steps(scenario: Scenario) -> int:
    """So many HR steps have about as many jobs as are simulated for a page."""
    per_measurement = 2 if scenario.late == "dual-rate" else 1
    of_sensors = sum(Fraction(per_measurement) / sensor.every for sensor in scenario.sensors)
    return int(MOST_JOBS / (1 + of_sensors + sum(1 / task.period for task in scenario.tasks)))


AS_IT_IS = ScenarioAsked()
KEYS = tuple(field.name for field in fields(ScenarioAsked))
WHOLE = ("seed", "steps", "at", "span")
SWITCHES = ("exact", "accuracy")


def asked_of(query: str, more: tuple[str, ...] = ()) -> tuple[ScenarioAsked, Mapping[str, str]]:
    """What a query says, and the texts of further keys that it may have.

    Raises InputError for a key that is unknown or there twice, and for a value that cannot be.
    """
    texts = pairs_of(query.removeprefix("?"), (*KEYS, *more))
    values: dict[str, Any] = {}
    for key in [key for key in KEYS if key in texts]:
        values[key] = _value(key, texts[key])
    return ScenarioAsked(**values), {key: text for key, text in texts.items() if key in more}


def query_of_asked(asked: ScenarioAsked) -> str:
    """The query that `asked_of` makes this of: only what is not as by default, always in the same order."""
    said = {key: _text(getattr(asked, key)) for key in KEYS if getattr(asked, key) != getattr(AS_IT_IS, key)}
    return urlencode(said, quote_via=quote, safe="/,:")


def _value(key: str, text: str) -> int | bool | str:
    if key in WHOLE:
        return whole_number(key, text)
    if key not in SWITCHES:
        return text
    if text not in ("yes", "no"):
        raise InputError(f"{option(key)} is {short(repr(text))}: choose from yes, no")
    return text == "yes"


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return number_text(value) if isinstance(value, Fraction) else str(value)
