"""`sched-sim measure --filter`: what it writes, and what it says to a filter that cannot be measured."""

from __future__ import annotations

import csv
import io
import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numba
import numpy as np
import pytest

from sched_sim.cli.measure_filter import noise
from sched_sim.cli.own_note import parts_note
from sched_sim.costs.autocorrelation import rank_autocorrelation
from sched_sim.costs.sample_file import SampledCosts, read_sampled_costs
from sched_sim.errors import InputError
from studies.measurement import samples
from studies.measurement.executions import Wanted
from studies.measurement.samples import measure_filter
from studies.measurement.user_filter import load_filter
from tests.command_line import Run, is_refused

OWN_FILTER = """
import numpy as np
from filters.modular import *

def move(x, u, dt, out):
    out[0] = x[0] + dt * x[1]
    out[1] = x[1]

def distance(x, out):
    out[0] = np.log(x[0])

Q, R = 0.1 * np.eye(2), [[1.0]]
GPS = Sensor("gps", linear_corrector([[1.0, 0.0]], R), delay=2)
LINEAR = linear_predictor([[1.0, 0.1], [0.0, 1.0]], Q)

def cart():
    return ModularFilter(LINEAR, [GPS], dt=0.1)

def radar():
    return ModularFilter(unscented_predictor(move, Q), [GPS, Sensor("radar", unscented_corrector(distance, R))], 0.1)

def distant_radar():
    return radar(), [100.0, 2.0]

def far_off_radar():
    return radar(), [-100.0, 2.0]

def short_start():
    return cart(), [1.0]

def negative_start():
    return cart(), [1.0, 2.0], -np.eye(2)

def blind():
    return ModularFilter(unscented_predictor(move, Q), [], 0.1)

def pushed():
    return moving(lambda x, u, dt, out: move(x, u[0] * dt, dt, out)), [0.0, 0.0], np.eye(2), [1.0]

def moving(f, jacobian=None):
    return ModularFilter(extended_predictor(f, Q, jacobian), [GPS], 0.1)

def without_input():
    return pushed()[0]

def observing(h, jacobian=None):
    return ModularFilter(LINEAR, [GPS, Sensor("eye", extended_corrector(h, R, jacobian))], 0.1)

def two_inputs():
    return ModularFilter(linear_predictor(np.eye(2), Q, np.eye(2)), []), None, None, [1.0]

def returning():
    return observing(lambda x, out: x[:1])

def forgetful():
    return moving(lambda x, u, dt, out: out.__setitem__(0, x[0]))

def changing():
    return observing(lambda x, out: x.__setitem__(0, 2.0))

def too_long():
    return observing(lambda x, out: out.__setitem__(1, 2.0))

def wrong_jacobian():
    return observing(lambda x, out: out.__setitem__(0, x[0]), lambda x, out: np.array([[1.0, 0.0]]))

def not_plain():
    return moving(np.add)

def unstable():
    return moving(lambda x, u, dt, out: move(1e200 * x, u, dt, out))

def written(x, u, dt, out):
    out[0] = float("%.3f" % x[0])
    out[1] = x[1]

def not_compilable():
    return moving(written)

def raising():
    raise RuntimeError("boom")

def number():
    return 9

def too_many():
    return cart(), None, None, None, None
"""


@pytest.fixture(autouse=True)
def own_module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "own_filter.py").write_text(OWN_FILTER)
    monkeypatch.chdir(tmp_path)


def test_counts_of_each_part_are_printed_and_written(sched_sim: Run, tmp_path: Path) -> None:
    line = "measure --filter own_filter:distant_radar --backend counted"
    rows = json.loads(sched_sim(f"{line} --format json -o costs.toml").out)
    assert [row["job"] for row in rows] == ["predict", "correct.gps", "correct.radar"]
    assert rows[2]["function"] == 5  # a logarithm for each sigma point
    costs = read_sampled_costs(tmp_path / "costs.toml")
    assert costs.unit == "operation"
    assert {part: [float(one) for one in samples] for part, samples in costs.samples.items()} == {
        row["job"]: [row["operations"]] for row in rows
    }
    assert costs.provenance["sensors"] == {"gps": "linear", "radar": "unscented"}
    assert list(csv.DictReader(io.StringIO(sched_sim(f"{line} --format csv").out))) == [
        {key: "" if value is None else str(value) for key, value in row.items()} for row in rows
    ]
    assert "operations" in sched_sim(line).out


def test_a_filter_of_linear_parts_has_the_jobs_of_all_ways_with_late_measurements() -> None:
    assert list(load_filter("own_filter:cart").jobs) == [
        "predict",
        "correct.gps",
        "predict_accumulate",
        "correct_accumulate.gps",
        "correct_late.gps",
        "carry.gps",
        "beside.gps",
        "land.gps",
        "carry_product",
        "beside_product.gps",
        "land_product.gps",
        "hr_propagate",
        "hr_restart",
        "hr_update",
        "lr_propagate",
        "gain.gps",
        "gain_again.gps",
        "gain_kept.gps",
        "lr_correct.gps",
        "hr_pass.gps",
    ]


def test_an_input_can_be_given() -> None:
    assert load_filter("own_filter:pushed").jobs["predict"].arguments(0)[3].tolist() == [1.0]


@pytest.mark.parametrize("part", ["predict", "correct.gps", "correct.radar"])
def test_each_set_of_arguments_is_of_its_own_and_the_same_again(part: str) -> None:
    job = load_filter("own_filter:distant_radar").jobs[part]
    first, again, other = (job.arguments(index)[2 if part == "predict" else 3] for index in (0, 0, 1))
    np.testing.assert_array_equal(first.x, again.x)
    assert not np.shares_memory(first.x, again.x)
    assert (first.x != other.x).all()
    assert (first.P != other.P).any()


@pytest.mark.slow
def test_each_execution_of_a_part_is_timed(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a filter without sensors, which compiles in seconds."""
    monkeypatch.setattr(samples, "QUICK", Wanted(2500, 5.0))
    (row,) = json.loads(sched_sim("measure --filter own_filter:blind --format json -o costs.toml").out)
    costs = read_sampled_costs(tmp_path / "costs.toml")
    assert (costs.unit, list(costs.samples), costs.harness) == ("ns", ["predict"], False)
    times = costs.samples["predict"]
    assert len(times) == row["samples"] == 2500
    assert float(min(times)) == row["minimum"] <= row["median"] <= row["p95"] <= row["p99"] <= row["maximum"]
    about = costs.provenance
    assert float(about["autocorrelation"]["predict"]) == row["rank_autocorrelation"]
    assert row["rank_autocorrelation"] == pytest.approx(rank_autocorrelation([*map(float, times)]), abs=1e-4)
    assert (about["executions"], about["caches"]) == (True, "warm")
    assert {"machine", "date", "versions", "protocol", "clock"} <= set(about)
    assert about["allocations"] == {"predict": 0}


@pytest.mark.exhaust
def test_all_parts_of_a_filter_are_timed_in_the_order_of_its_loops(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(samples, "QUICK", Wanted(500, 5.0))
    user = load_filter("own_filter:cart")
    costs = measure_filter(user, name="cart", caches="sequence")
    assert {part: len(times) for part, times in costs.samples.items()} == dict.fromkeys(user.jobs, 500)
    assert [*costs.provenance["autocorrelation"]] == [*user.jobs]


def times(*nanoseconds: int) -> list[Fraction]:
    return [Fraction(each, 10**9) for each in nanoseconds]


def test_a_noisy_part_is_named_and_a_quiet_one_is_not() -> None:
    quiet, loud = times(*[100] * 90, *[290] * 10), times(*[100] * 90, *[310] * 10)
    assert noise({"predict": quiet, "once": times(5)}) == []
    said = "noisy: p95 of correct.gps is 3.1 times its median; repeat on an idle machine"
    assert noise({"predict": quiet, "correct.gps": loud}) == [said]


def sampled(correlation: float) -> SampledCosts:
    about = {"source": "2 samples", "caches": "warm", "autocorrelation": {"predict": correlation}}
    return SampledCosts("c", "ns", {"predict": (Fraction(100), Fraction(100))}, {}, about)


@pytest.mark.parametrize(("correlation", "doubtful"), [(0.04, False), (-0.04, False), (0.06, True), (-0.06, True)])
def test_below_the_times_it_is_said_what_they_leave_open(
    correlation: float, doubtful: bool, sched_sim: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("studies.measurement.samples.measure_filter", lambda *_, **__: sampled(correlation))
    out = " ".join(sched_sim("measure --filter own_filter:cart").out.split())
    assert "a slower execution than the slowest may come with a probability of up to 7.8e-01 each" in out
    assert ("above 0.05 of predict: independence doubtful" in out) == doubtful
    assert "noisy" not in out
    assert "new arrays" not in out


@pytest.mark.parametrize(("flag", "caches"), [("", "warm"), ("--cold", "cold"), ("--sequence", "sequence")])
def test_flags_say_how_caches_are(flag: str, caches: str, sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[Any] = []

    def noting(*_: Any, **options: Any) -> SampledCosts:
        given.append(options["caches"])
        return sampled(0.0)

    monkeypatch.setattr("studies.measurement.samples.measure_filter", noting)
    sched_sim(f"measure --filter own_filter:cart {flag}")
    assert given == [caches]


def test_parts_whose_functions_make_new_arrays_are_named() -> None:
    said = "your functions make new arrays, 25 in predict, 1 in correct.gps each time, which slows all of it down"
    assert parts_note({"allocations": {"predict": 25, "correct.gps": 1, "correct.eye": 0}}).startswith(said)
    assert parts_note({"allocations": {"predict": 0}}) == parts_note({}) == ""


@pytest.mark.exhaust
def test_a_function_that_cannot_be_compiled_is_named_with_its_line(sched_sim: Run) -> None:
    said = ["predict cannot be compiled by numba", "own_filter.py, line", '"%.3f" % x[0]']
    is_refused(sched_sim("measure --filter own_filter:not_compilable"), said)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("own_filter", "name a function"),
        ("not_there:cart", "'not_there' cannot be imported"),
        ("own_filter:truck", "has no function 'truck'"),
        ("own_filter:raising", r"raising\(\) failed: RuntimeError: boom \(.*own_filter\.py, line \d+\)"),
        ("own_filter:number", r"number\(\) returned a int; name a function"),
        ("own_filter:too_many", r"returned \(ModularFilter, NoneType, NoneType, NoneType, NoneType\)"),
        ("own_filter:radar", r"sensor 'radar': h\(x, out\).*finite.*x = \[0.0, 0.0\].*return \(filter, x0, P0, u\)"),
        ("own_filter:far_off_radar", r"sensor 'radar': h\(x, out\).*finite.*x = \[-100.0, 2.0\].*tried with your x0"),
        ("own_filter:short_start", r"x0 has shape \(1,\), the filter needs \(2,\)"),
        ("own_filter:negative_start", "P0 is no covariance"),
        ("own_filter:without_input", r"predictor: f\(x, u, dt, out\) failed: IndexError.*u \(0,\).*no input"),
        ("own_filter:two_inputs", "predictor: B has 2 columns, but the input has 1 numbers"),
        (
            "own_filter:returning",
            r"sensor 'eye': h\(x, out\) returned a ndarray of shape \(1,\); it must write into out",
        ),
        ("own_filter:forgetful", r"predictor: f\(x, u, dt, out\) left in out \[0.0, nan\]: not written.* is \[1\]"),
        ("own_filter:changing", r"sensor 'eye': h\(x, out\) changes what it is given"),
        ("own_filter:too_long", r"sensor 'eye': h\(x, out\) failed: IndexError.*out \(1,\)"),
        ("own_filter:wrong_jacobian", r"sensor 'eye': jacobian\(x, out\) returned a ndarray of shape \(1, 2\)"),
        ("own_filter:not_plain", r"predictor: f\(x, u, dt, out\) is a ufunc; give a plain function"),
        ("own_filter:unstable", "predictor, step 0: the estimate is no longer finite: the model lets it grow"),
    ],
)
def test_what_is_wrong_with_a_users_filter_is_named(name: str, said: str) -> None:
    with pytest.raises(InputError, match=said) as error:
        load_filter(name)
    assert f"--filter {name!r}" in str(error.value)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--states 9", ["--states"]),
        ("--inputs 3 --measurements 2", ["--inputs, --measurements"]),
        ("--system a:b", ["--system"]),
        ("--robust position --parallel 3", ["--robust, --parallel"]),
        ("--update short --method larsen", ["--method, --update"]),
        ("--backend numpy", ["--backend numpy", "compiled or counted"]),
        ("--cold --sequence", ["--cold, --sequence", "one of them"]),
        ("--cold --backend counted", ["--cold", "--backend counted"]),
        ("--sequence --backend counted", ["--sequence", "--backend counted"]),
        ("-o nowhere/costs.toml", ["nowhere/costs.toml"]),
    ],
)
def test_options_that_say_nothing_of_a_composed_filter_are_refused(
    sched_sim: Run, options: str, said: list[str]
) -> None:
    is_refused(sched_sim(f"measure --filter own_filter:cart {options}"), said)


def test_how_caches_are_is_for_executions_of_a_filter_only(sched_sim: Run) -> None:
    is_refused(sched_sim("measure --cold --sequence"), ["--cold, --sequence", "only with --filter"])
    is_refused(sched_sim("measure --robust position --cold"), ["--cold", "only with --filter"])
    with pytest.raises(InputError, match=r"caches=.hot. is unknown"):
        measure_filter(load_filter("own_filter:cart"), name="c", caches="hot")  # type: ignore[arg-type]


@pytest.mark.parametrize("what", ["--filter own_filter:cart", "--method standard"])
def test_python_is_not_timed_as_compiled_code(what: str, sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numba.config, "DISABLE_JIT", 1)
    said = "NUMBA_DISABLE_JIT is set, and compiled code is to be timed: unset it"
    is_refused(sched_sim(f"measure {what} -o costs.toml"), [said])
