"""All that a view says is what the library says of the same design, in exact numbers."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import COUNTED, PAPERS, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.fit import busy_share, fit
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part, shipped_parts
from sched_sim.schedule.tasks import Task
from studies.explorer.design import Design
from studies.explorer.given import Given
from studies.explorer.query import design_of, query_of
from studies.explorer.view import explore
from studies.selection.compare import compare_accuracy
from tests.studies.explorer.drawn import designs_in_steps, designs_in_time


@given(designs_in_steps())
def test_the_current_design_is_what_the_library_makes_of_it(design: Design) -> None:
    view = explore(design)
    current = view.current
    costs = select(load_costs(design.costs or PAPERS), design.method, design.options)
    timing = Timing(**_steps(view.design, design.method))
    least = least_speed(costs, timing, design.options)
    speed = least.speed if design.speed is None else Fraction(design.speed)
    schedule = simulate(costs, timing, speed, design.cycles, design.options, keep_slices=True)
    assert (current.least, current.speed) == (least.speed, speed)
    assert current.achieved_l == achieved_l(costs, timing, speed, design.options)
    assert current.misses == view.schedule.misses == schedule.misses
    assert current.load == busy_share(costs, timing, speed, design.options, ())
    assert current.fits == (None if design.speed is None else least.speed <= speed)
    assert (current.power, current.pace) == (float(least.speed), float(speed))


@given(designs_in_steps())
def test_every_method_beside_it_is_what_the_library_makes_of_it(design: Design) -> None:
    view = explore(design)
    table = load_costs(design.costs or PAPERS)
    assert [of.method for of in view.methods] == [name for name in DELAYED_METHODS if name in table.costs]
    for of in view.methods:
        assert of.query == query_of(replace(design, method=of.method))
        if of.reason:
            with pytest.raises(InputError) as refused:
                explore(design_of(of.query))
            assert str(refused.value) == of.reason
            continue
        assert of.staircase is not None
        costs = select(table, of.method, design.options)
        timing = Timing(design.N or 0, 0 if of.method == "standard" else design.M or 0, of.L or 0)
        stairs = staircase(costs, timing.N, timing.M, design.options)
        least = least_speed(costs, timing, design.options)
        assert of.least == least.speed
        assert [stair.L for stair in stairs] == of.staircase.L
        assert of.staircase.power == [float(stair.speed) for stair in stairs]
        assert of.staircase.achieved == [stair.achieved for stair in stairs]
        speed = least.speed if design.speed is None else Fraction(design.speed)
        assert of.achieved_l == achieved_l(costs, timing, speed, design.options)


@settings(max_examples=5)
@given(designs_in_time())
def test_parts_are_those_of_fit_and_powers_shares_of_the_part(design: Design) -> None:
    view = explore(design)
    asked = view.design
    rate, table = Fraction(asked["hr_hz"]), load_costs(COUNTED)
    timing = Timing.at(rate, asked["measurement_hz"], asked["delay_ms"], asked["land_within_ms"])
    assert (asked["N"], asked["M"], asked["L"]) == (timing.N, timing.M, timing.L)
    assert sorted(part.name for part in view.parts) == sorted(shipped_parts())
    for part in view.parts:
        on = on_part(table, load_part(part.name))
        if part.needed is None:
            assert design.method in on.lacking
            continue
        verdict = fit(select(on, design.method), timing, rate)
        assert (part.needed, part.load, part.fits, part.landed) == (
            verdict.needed,
            verdict.load,
            verdict.fits,
            verdict.landed,
        )
    if design.processor:
        own = next(part for part in view.parts if part.name == design.processor)
        assert view.current.power == pytest.approx(100 * float(own.needed or 0), rel=1e-12)
        assert (view.current.pace, view.current.fits, view.current.std) == (100, own.fits, own.std)
    else:
        assert view.current.power == float(view.current.least)


@settings(max_examples=5)
@given(designs_in_time())
def test_accuracies_are_those_of_the_comparison(design: Design) -> None:
    view = explore(design)
    times = {name: view.design[name] for name in ("hr_hz", "measurement_hz", "delay_ms")}
    row = compare_accuracy("ins-gps", **times, L=view.design["L"], methods=[design.method], metric=design.metric).rows[
        0
    ]
    assert row.accuracy is not None
    expected = row.accuracy.total if design.metric == "worst" else row.accuracy.rms
    assert view.current.std_at_L == pytest.approx(expected, rel=1e-9)
    for of in view.methods:
        assert (of.within is None) == (design.within is None or bool(of.reason))
        if of.within is not None and of.within.std is not None:
            assert of.within.std <= float(design.within or 0)


@settings(max_examples=3)
@given(designs_in_time())
def test_every_link_of_a_view_is_a_design_that_can_be_explored(design: Design) -> None:
    view = explore(design)
    links = [of.query for of in view.methods if not of.reason]
    links += [of.within.query for of in view.methods if of.within]
    links += [part.query for part in view.parts if not part.reason]
    for link in dict.fromkeys(links):
        assert explore(design_of(link)).query == link


@given(designs_in_steps() | designs_in_time())
def test_the_whole_design_says_the_same_as_its_link(design: Design) -> None:
    view = explore(design)
    said = {key: str(value) for key, value in view.design.items() if value is not None}
    again = explore(design_of("&".join(f"{key}={value}" for key, value in said.items())))
    assert again.design == view.design
    assert again.current == view.current


@given(designs_in_steps() | designs_in_time())
def test_a_view_is_json_and_the_same_every_time(design: Design) -> None:
    document = explore(design).document()
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert explore(design).document() == document


def test_numbers_are_exact_text_beside_their_value() -> None:
    document = explore(Design(N=10, M=4, L=8)).document()
    assert document["current"]["least"] == {"value": 0.77, "exact": "77/100"}
    assert document["power"] == {"unit": "standard steps per HR period", "short": "speed"}
    assert document["current"]["runs_at"] == "least speed"
    assert document["current"]["binding"] == "LR update, m to l"


def _steps(said: dict[str, int], method: str) -> dict[str, int]:
    return {name: 0 if method == "standard" and name != "N" else said[name] for name in "NML"}


def test_own_names_are_those_that_the_explorer_was_started_with() -> None:
    table, part = load_costs("counted-9-3-3-short"), load_part("desktop")
    own = Given({"mine": table}, {"my-board": part})
    view = explore(Design(N=10, M=4, hr_hz=400, costs="mine", processor="my-board"), own)
    assert view.current.least == least_speed(select(on_part(table, part), "dual-rate"), Timing(10, 4, 10)).speed
    assert view.choices["costs"][0] == "mine"
    assert view.choices["processor"][0] == {"name": "my-board", "title": part.title}
    with pytest.raises(InputError, match=r"costs 'mine' is unknown: .*your own are given when the explorer is started"):
        explore(Design(N=10, M=4, costs="mine"))


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("M=4", "N is missing: give the HR steps from one measurement to the next"),
        ("N=10", "M is missing"),
        ("N=10&M=4&L=4", r"L=4 must be > M=4: the dual-rate correction cannot land"),
        ("N=10&M=4&delay_ms=5", "delay_ms without hr_hz: give the rate of the HR loop, such as hr_hz 400"),
        ("N=10&M=4&hr_hz=400&delay_ms=5", "M 4 and delay_ms 5 do not agree: at 400 Hz that is M 2; leave out the one"),
        ("N=10&M=4&processor=rp2040", "processor rp2040 without hr_hz: give the rate"),
        ("N=10&M=4&hr_hz=9&processor=rp2040&speed=0.5", "speed 0.5 and processor rp2040 exclude each other"),
        ("N=10&M=4&within=1", "within without model: give the model whose output it is, such as model ins-gps"),
        ("N=10&M=4&costs=/etc/passwd", "costs '/etc/passwd' is unknown: choose from counted-9-3-3,"),
        ("N=10&M=4&hr_hz=9&processor=../x.toml", r"processor '\.\./x.toml' is unknown: choose from cortex-a53,"),
        ("N=10&M=4&model=os:getcwd", "model 'os:getcwd' is unknown: choose from ins-gps,"),
        ("N=10&M=4&costs=patent-multirate", "costs 'patent-multirate' is unknown"),
        ("N=10&M=4&method=clone", "has no entry"),
        ("model=ins-gps&output=heat", "output heat"),
    ],
)
def test_what_cannot_be_explored_is_refused_by_its_name_and_with_a_remedy(query: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        explore(design_of(query))


def test_tasks_run_beside_the_filter_and_are_searched_for() -> None:
    task = Task("control", Fraction(2), Fraction(1, 10), 5)
    view = explore(Design(N=10, M=4, L=8), Given(tasks=[task]))
    costs = select(load_costs(PAPERS), "dual-rate")
    assert view.current.least == least_speed(costs, Timing(10, 4, 8), tasks=[task]).speed
    assert {"label": "task:control", "meaning": "task control"} in view.document()["schedule"]["styles"]


def test_other_methods_and_parts_that_take_long_searches_say_so() -> None:
    view = explore(design_of("N=400&M=40&hr_hz=400&model=ins-gps&policy=edf"))
    clone = next(of for of in view.methods if of.method == "clone")
    assert clone.reason == "it takes a search by simulation over 800 HR periods: choose it to see its least speed"
    assert view.parts == ()
    assert "no parts: on each the least speed takes a search by simulation: choose a processor" in view.notes
    with pytest.raises(InputError, match=r"takes a search by simulation over 6,000 HR periods, .* at most 5,000"):
        explore(design_of("N=3000&M=40&policy=edf"))


def test_beside_tasks_the_machine_of_the_costs_is_judged_and_the_landings_lead_to_its_own() -> None:
    """As least speeds are searched for then, not all landings are known."""
    kinds = {"hr_propagate": 290, "hr_restart": 20, "hr_update": 20, "lr_propagate": 200, "lr_update": 260}
    mine = CostTable("mine", "us", {"dual-rate": kinds})
    tasks = [
        Task("control", Fraction(7), Fraction(300), priority=5),
        Task("telemetry", Fraction(20), Fraction(800), priority=30, preemptive=False),
    ]
    own = Given(costs={"mine": mine}, tasks=tasks)
    times = "hr_hz=400&measurement_hz=5&delay_ms=100&land_within_ms=150"
    design = design_of(f"{times}&costs=mine&model=ins-gps&within=0.4", own)
    view = explore(design, own)
    (machine,) = view.parts
    assert (machine.fits, machine.needed) == (True, Fraction(view.current.least, 2500))
    (method,) = view.methods
    assert method.landing is not None
    at = max(index for index, power in enumerate(method.landing.power) if power <= 100)
    assert method.landing.L[at] == view.current.achieved_l == machine.landed
    assert method.within is not None
    assert method.within.landed == machine.landed


def test_a_search_that_does_not_come_to_its_end_is_given_up() -> None:
    """Where work piles up slowly each of its simulations visits many points in time."""
    query = "N=1&M=1&costs=counted-9-3-3&lr_propagate_by=l&feedback=same-step"
    beside = next(of for of in explore(design_of(f"{query}&method=larsen")).methods if of.method == "dual-rate")
    assert "simulations of more than 40,000 points in time, as work piles up slowly" in beside.reason
    switching = "N=4&M=4&feedback=same-step&lr_propagate_by=l&context_switch=0.01"
    with pytest.raises(InputError, match=r"more than 200,000 points in time, .*: ask `sched-sim minimum`, or take one"):
        explore(design_of(f"{switching}&speed=7/3&model=ins-gps&within=0.01"))


def test_the_more_tasks_of_any_phase_the_less_is_searched_beside_a_design() -> None:
    one, two = (Task(name, Fraction(20), Fraction(1, 10), 5) for name in ("control", "telemetry"))
    other = [
        next(of for of in explore(Design(N=40, M=20), Given(tasks=tasks)).methods if of.method == "larsen")
        for tasks in ([one], [one, two])
    ]
    assert [of.reason for of in other] == [
        "",
        "it takes a search by simulation over 160 HR periods: choose it to see its least speed",
    ]


def test_what_is_beside_a_design_takes_short_searches_or_says_why_not() -> None:
    """For a needed accuracy its correction may land later than is asked of the design."""
    view = explore(
        design_of("N=10&M=15&L=16&model=star-tracker&within=0.5&feedback=same-step&context_switch=10&policy=edf")
    )
    within = next(of.within for of in view.methods if of.method == "dual-rate")
    assert within is not None
    assert within.least is None
    assert "more than 40,000 points in time" in within.reason
