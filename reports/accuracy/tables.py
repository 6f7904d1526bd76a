"""Tables of the report on accuracy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import ceil

from filters.accuracy import Accuracy, lossless
from reports.accuracy.results import EXAMPLE, Results
from reports.accuracy.words import MODELS, deviation, ordinal, percents, plain_name, verdict
from reports.pages.numbers import significant
from reports.pages.stored import Rows
from sched_sim.costs.table import COUNTED
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from studies.accuracy.given import MOTIONS, Given, given
from studies.accuracy.landing import EVERY, SEARCHED, Landing
from studies.accuracy.scale import SUMMED, Placed, cheapest, earliest
from studies.accuracy.slow_processor import Choice, at_speeds

SPEEDS = tuple(map(Fraction, (2, 3, 4, 5, 6, 7, 8, 11, 21)))
"""Of the table on the slow processor."""


def models(results: Results) -> Rows:
    """What each is, in steps and in ms."""
    rows: Rows = [["Model", "loop, Hz", "a fix every, ms", "late, ms", "N", "M", "sizes"]]
    for name, found in results.landings.items():
        of = found.given
        row = [f"{of.hr_hz:g}", f"{of.ms(of.N):g}", f"{of.ms(of.M):g}", str(of.N), str(of.M), _sizes(results, name)]
        rows.append([MODELS[name].name, *row])
    return rows


def landings(results: Results) -> Rows:
    """What the output is worth by where corrections land, and with fewer of them."""
    rows: Rows = [
        ["Model", "no delay", "on arrival, L = M", "at the next fix, L = N", *(ordinal(n) for n in EVERY[1:]), "jump"]
    ]
    for name, found in results.landings.items():
        fewer = [deviation(name, found.skipping[n].worst) for n in EVERY[1:]]
        prompt = found.at_arrival
        row = [deviation(name, value) for value in (found.no_delay, prompt.worst, found.at_next.worst)]
        rows.append([MODELS[name].name, *row, *fewer, deviation(name, prompt.jump)])
    return rows


def costs(results: Results) -> Rows:
    """The same as percentages over landing on arrival, the screening rule, and how late is still better than fewer."""
    rows: Rows = [
        [
            "Model",
            "at the next fix, %",
            "rule, %",
            *(f"{ordinal(n)}, %" for n in EVERY[1:]),
            "better until, ms",
            "intervals",
        ]
    ]
    for name, found in results.landings.items():
        fewer = [percents(found.leaving_out(n)) for n in EVERY[1:]]
        rows.append([MODELS[name].name, percents(found.waiting), percents(found.rule), *fewer, *_until(found)])
    return rows


def _until(found: Landing) -> tuple[str, str]:
    of = found.given
    if found.as_late is None:
        return f"> {of.ms(SEARCHED * of.N):,.0f}", f"> {SEARCHED}"
    return f"{of.ms(found.as_late):g}", f"{found.as_late / of.N:.1f}"


def methods(results: Results) -> Rows:
    """All of them in the example, by least power."""
    rows: Rows = [
        [
            "Method", "lands at L", "after, ms", "worst, m", "least power", "over standard", "verdict",
            "textbook update", "first at L", "for that",
        ]
    ]  # fmt: skip
    of, approximated = given(EXAMPLE), results.approximations[EXAMPLE]
    least, first = cheapest(results.placed[EXAMPLE]), earliest(results.placed[EXAMPLE])
    textbook = textbook_powers(of)
    standard = least["standard"].speed
    for method, place in sorted(least.items(), key=lambda item: item[1].speed):
        accuracy, early = place.accuracy, first[method]
        row = [plain_name(method), str(place.lands), f"{of.ms(place.lands):g}", significant(accuracy.total, 4)]
        row += [operations(place.speed), significant(place.speed / standard)]
        row += [verdict(method, accuracy, exact_at(of, place.lands)), operations(textbook[method])]
        rows.append([*row, str(early.lands), operations(early.speed)])
    nothing = approximated.discarded
    rows.append(["Discard what is late", *"-----", f"{nothing.verdict}: no bound", *"---"])
    return rows


def shown_methods(rows: Rows) -> tuple[Rows, Rows]:
    """The table of methods in two that fit on paper: at the least power, and by the other update and landing first."""
    first = rows[0].index("textbook update")
    power = rows[0].index("least power")
    named = [row for row in rows if row[power] != "-"]
    return [row[:first] for row in rows], [[row[0], row[power], *row[first:]] for row in named]


def exact_at(of: Given, L: int) -> Accuracy:
    """Of a method that loses nothing."""
    return lossless(of.model, of.states, of.N, L)


def textbook_powers(of: Given) -> Mapping[str, Fraction]:
    """The least power of each method with the textbook covariance update, as counted in the table that ships."""
    table, found = load_costs(COUNTED), {}
    for method in [*table.costs, SUMMED]:
        name = method.removesuffix(", Q'")
        if name in METHODS:
            options = Options(low_rate_noise="sum" if method == SUMMED else "exact")
            law = METHODS[name].law(options.feedback)
            M = 0 if law.undelayed else of.M
            timing = Timing(of.N, M, max(law.legal(of.N, M)))
            found[method] = least_speed(select(table, name, options), timing, options).speed
    return found


def powers(results: Results) -> Rows:
    """The least power of each method for each model, and where it lands."""
    rows: Rows = [["Method", *(f"{MODELS[name].name}, {_sizes(results, name)}" for name in results.placed)]]
    by_model = {name: cheapest(placed) for name, placed in results.placed.items()}
    for method in sorted(by_model[EXAMPLE], key=lambda method: by_model[EXAMPLE][method].speed):
        cells = [f"{operations(of[method].speed)} ({of[method].lands})" for of in by_model.values()]
        rows.append([plain_name(method), *cells])
    return rows


def _sizes(results: Results, name: str) -> str:
    return "/".join(map(str, results.landings[name].given.sizes))


def operations(power: Fraction) -> str:
    """Rounded up, for it is the least: whole numbers from 100 on, else one decimal where there is one."""
    if power >= 100 or power.denominator == 1:
        return f"{ceil(power):,}"
    return f"{ceil(10 * power) / 10:.1f}"


def approximate(results: Results) -> Rows:
    rows: Rows = [
        ["Model", "Q′, %", "Q″, %", "PX4, worst, %", "PX4, rms, %", "fresh: motion", "fresh: bias", "fresh: worst"]
    ]
    for name, found in results.approximations.items():
        late = found.exact_late.worst
        row = [percents(found.summed.worst / late - 1), percents(found.halved.worst / late - 1)]
        row += [percents(found.px4.worst / found.exact.worst - 1), percents(found.px4.rms / found.exact.rms - 1)]
        motion = MOTIONS[name]
        row += [
            motion.what.partition(",")[0],
            *(deviation(name, value) for value in (found.fresh.bias, found.fresh.total)),
        ]
        rows.append([MODELS[name].name, *row])
    return rows


def in_flight(results: Results) -> Rows:
    """Landing at L = N + M, with what is under way taken out of innovations, and without."""
    rows: Rows = [["Model", "L", "compensated", "uncompensated", "spectral radius", "verdict"]]
    for name, found in results.approximations.items():
        wrong = found.uncompensated
        assert wrong.radius is not None
        stds = [deviation(name, accuracy.worst) for accuracy in (found.exact_in_flight, wrong)]
        rows.append([MODELS[name].name, wrong.L, *stds, f"{wrong.radius:.4f}", wrong.verdict])
    return rows


def camera_rates(results: Results) -> Rows:
    return [
        ["Camera, Hz", *results.noise_by_rate],
        ["Q′ costs, %", *(percents(share) for share in results.noise_by_rate.values())],
    ]


def slow_processor(results: Results) -> Rows:
    """At some speeds, the best with one frame in flight and with several."""
    rows: Rows = [
        [
            "Speed",
            *(f"{flight}: {what}" for flight in ("one", "several") for what in ("n", "L", "std, mm")),
            "better by, %",
        ]
    ]
    for speed, (alone, several) in at_speeds_of(results.choices).items():
        assert alone is not None
        gained = 1 - several.worst / alone.worst
        rows.append(
            [f"{float(speed):g}", *_choice(alone), *_choice(several), percents(gained) if several != alone else "-"]
        )
    return rows


def _choice(choice: Choice) -> list[str]:
    return [str(choice.every), str(choice.L), significant(1000 * choice.worst)]


def at_speeds_of(choices: Sequence[Choice]) -> Mapping[Fraction, tuple[Choice | None, Choice]]:
    """The pairs of `SPEEDS`."""
    every = at_speeds(choices)
    return {speed: every[max(known for known in every if known <= speed)] for speed in SPEEDS}


def all_landings(results: Results) -> Rows:
    """The curves, for a spreadsheet."""
    rows: Rows = [["model", "every", "L", "after_ms", "worst", "over_no_delay"]]
    for name, found in results.landings.items():
        for n, curve in found.curves.items():
            for L, std in zip(curve.landings, curve.worst, strict=True):
                over = std / found.no_delay - 1
                rows.append([name, n, L, f"{found.given.ms(L):g}", f"{std:.6g}", f"{over:.6g}"])
    return rows


def all_designs(results: Results) -> Rows:
    """The front, for a spreadsheet."""
    rows: Rows = [
        ["model", "method", "every", "lands_at", "after_ms", "least_power", "worst", "rms", "bias", "total", "on_front"]
    ]
    for name, placed in results.placed.items():
        rows += [_design(name, results.landings[name].given, place) for place in placed]
    return rows


def _design(name: str, of: Given, place: Placed) -> list[str | int]:
    accuracy = place.accuracy
    stds = [f"{value:.6g}" for value in (accuracy.worst, accuracy.rms, accuracy.bias, accuracy.total)]
    row: list[str | int] = [name, place.method, place.every, place.lands, f"{of.ms(place.lands):g}"]
    return [*row, f"{float(place.speed):.6g}", *stds, "yes" if place.on_front else "no"]


def all_choices(results: Results) -> Rows:
    rows: Rows = [["every", "L", "speed", "worst_m", "several_in_flight"]]
    for choice in results.choices:
        row = [choice.every, choice.L, str(choice.speed), f"{choice.worst:.6g}"]
        rows.append([*row, "yes" if choice.several else "no"])
    return rows
