"""The accuracy along a simulated scenario: the closed form where it is periodic, conditioning where it is random."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from filters.accuracy import SensorsModel, lossless
from filters.arrays import FloatArray
from filters.modular import Measurement, ModularFilter, Sensor, linear_corrector, linear_predictor, run
from sched_sim.errors import InputError
from sched_sim.scenario.accuracy_asked import AccuracyAsked, Seen
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from studies.selection import in_scenario
from studies.selection.in_scenario import Question, ScenarioAccuracy, accuracy_along, question_of
from tests.filters.accuracy.cases import CV, INS, POSITION, random_model
from tests.scenarios import LR, scenario, sensor

GPS = sensor("gps", 80, 44)


def given_by(folder: Path, monkeypatch: pytest.MonkeyPatch, value: object) -> None:
    """model:it returns it."""
    (folder / "model.py").write_text("VALUE = []\ndef it():\n    return VALUE[0]\n")
    monkeypatch.chdir(folder)
    monkeypatch.syspath_prepend(folder)
    monkeypatch.delitem(__import__("sys").modules, "model", raising=False)
    __import__("model").VALUE.append(value)


def along(of: Scenario, **asked: Any) -> tuple[ScenarioAccuracy, Outcome]:
    outcome = run_scenario(of)
    return accuracy_along(question_of(of, Path(), **asked), of, outcome), outcome


@pytest.mark.exhaust
@pytest.mark.parametrize(("speed", "delay", "L"), [(100, 44, 44), (1.4, 44, 100), (100, 176, 176)])
def test_of_one_sensor_that_is_periodic_it_is_the_closed_form(speed: float, delay: int, L: int) -> None:
    costs = {"predict": 0.5, "correct.gps": 1}
    of = scenario(speed, costs, sensor("gps", 80, delay, land_by=400), steps=81 * 80, hr_hz=400)
    found, outcome = along(of, model="ins-gps")
    assert outcome.sensors["gps"].achieved.keys() == {L}
    exact = lossless(INS, POSITION, 80, L)
    assert found.first == L
    cycles = found.between(L + 80, L + 80 + 77 * 80 - 1)
    assert cycles.spread.worst == pytest.approx(exact.worst, rel=1e-9)
    assert np.sqrt(np.mean(cycles.counted**2)) == pytest.approx(exact.rms, rel=1e-9)
    by_age = [lossless_age(age) for age in range(L, L + 80)]
    assert cycles.spread.median == pytest.approx(np.median(by_age), rel=1e-9)
    assert cycles.spread.p95 == pytest.approx(np.quantile(np.tile(by_age, 77), 0.95), rel=1e-9)
    age = cycles.age("gps")
    assert age is not None
    assert (age.median, age.worst) == (pytest.approx(2.5 * (L + 39.5)), pytest.approx(2.5 * (L + 79)))


def lossless_age(age: int) -> float:
    """Deviation of the INS at this age, N = 80: from the sums of the closed form."""
    total = [80 * lossless(INS, POSITION, 80, at).rms ** 2 for at in (age, age + 1)]
    return float(np.sqrt(total[0] - total[1] + oldest(age)))


def oldest(age: int) -> float:
    from filters.accuracy.periodic import steady

    return float(steady(INS, np.eye(9)[POSITION], [80], age + 80).variances[0][age + 80])


def conditioned(model: SensorsModel, P0: FloatArray, landings: list[tuple[str, int, int]], j: int) -> FloatArray:
    """The covariance of x_j given what has landed by j, by stacking all noises."""
    n = model.states
    size = n * (1 + j)
    covariance = np.kron(np.eye(1 + j), model.Q)
    covariance[:n, :n] = P0
    states = [np.eye(n, size)]
    for i in range(j):
        x = model.Phi @ states[-1]
        x[:, n * (1 + i) : n * (2 + i)] += np.eye(n)
        states.append(x)
    for name, k, l in landings:
        if l <= j:
            H, R = model.sensors[name]
            rows = H @ states[k]
            gain = covariance @ rows.T @ np.linalg.inv(rows @ covariance @ rows.T + R)
            covariance = covariance - gain @ rows @ covariance
    return np.asarray(states[j] @ covariance @ states[j].T)


@pytest.mark.parametrize("seed", range(4))
def test_of_random_delays_dropout_and_times_it_is_conditioning(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = random_model(seed, 1.02, 3, 1), random_model(seed + 9, 1.0, 3, 2)
    model = SensorsModel(first.Phi, first.Q, {"gps": (first.H, first.R), "radio": (second.H, second.R)})
    given_by(tmp_path, monkeypatch, model)
    costs = {"predict": [1, 2, 3], "correct.gps": [2, 9], "correct.radio": [1, 4]}
    gps = sensor("gps", 7, range(3, 12), dropout=0.3, land_by=90)
    radio = sensor("radio", Fraction(7, 2), [0, 1, 4], dropout=0.2, priority=LR - 1, land_by=90)
    of = scenario(9, costs, gps, radio, steps=45, seed=seed)
    deviations = [0.5, 1.0, 2.0]
    found, outcome = along(of, model="model:it", output="0,2", initial_std=deviations)
    landings = [(name, k, l) for name, figures in outcome.sensors.items() for k, l in figures.landings]
    assert len({l - k for _, k, l in landings}) > 3
    P0 = np.diag(np.square(deviations))
    expected = [np.trace(conditioned(model, P0, landings, j)[np.ix_([0, 2], [0, 2])]) for j in range(45)]
    np.testing.assert_allclose(found.deviations**2, expected, rtol=1e-9)
    for each in (gps, radio):
        ages = found.ages[each.name]
        assert ages is not None
        for j, age in enumerate(ages, found.first):
            newest = max(k for name, k, l in landings if name == each.name and l <= j)
            assert age == pytest.approx(float(j - each.instant(newest)))


def test_landings_are_those_that_were_counted() -> None:
    of = scenario(3, {"predict": 1, "correct.gps": [1, 5]}, sensor("gps", 9, range(2, 6), dropout=0.2), steps=300)
    figures = run_scenario(of).sensors["gps"]
    assert sorted(l - k for k, l in figures.landings) == sorted(figures.achieved.elements())
    assert [l for _, l in figures.landings] == sorted(l for _, l in figures.landings)


CHEAP = {"predict": 1, "correct.gps": 1}


def test_a_start_is_left_out_until_it_no_longer_matters() -> None:
    of = scenario(100, CHEAP, GPS, steps=12000, hr_hz=400)
    usual, _ = along(of, model="ins-gps")
    found, _ = along(of, model="ins-gps", initial_std=[100.0] * 3 + [10.0] * 3 + [0.02] * 3)
    assert found.deviations[0] > 100
    assert 7000 < found.first < 9000
    np.testing.assert_allclose(found.counted, usual.deviations[found.first :], rtol=0.0101)
    assert abs(found.deviations[found.first - 1] / usual.deviations[found.first - 1] - 1) > 0.01
    assert any("makes less than 1 %" in remark for remark in found.remarks)


def test_a_start_that_is_felt_to_the_end_is_told() -> None:
    of = scenario(100, CHEAP, GPS, steps=100, hr_hz=400)
    found, _ = along(of, model="ins-gps", initial_std=[1000.0] * 9)
    assert found.first == 44
    assert any("to the end the start given makes more" in remark for remark in found.remarks)


def test_what_never_lands_is_told_and_has_no_age() -> None:
    of = scenario(100, CHEAP, sensor("gps", 80, 44, dropout=1.0), steps=200, hr_hz=400)
    with pytest.raises(InputError, match=r"^initial_std is missing: .* does not settle"):
        along(of, model="ins-gps")
    found, _ = along(of, model="ins-gps", initial_std=[1.0] * 9)
    assert (found.ages["gps"], found.age("gps")) == (None, None)
    assert any("no correction of gps lands" in remark for remark in found.remarks)
    assert found.spread.worst == found.deviations[-1]


def test_it_is_followed_as_far_as_there_is_time(monkeypatch: pytest.MonkeyPatch) -> None:
    of = scenario(100, CHEAP, GPS, steps=1000, hr_hz=400)
    everything, _ = along(of, model="ins-gps")
    for name, most, last in [("MOST_PROPAGATIONS", 500, 324), ("MOST_KEPT_BYTES", 30 * 8 * 81, 43)]:
        with monkeypatch.context() as patch:
            patch.setattr(in_scenario, name, most)
            found, _ = along(of, model="ins-gps")
        assert found.last == last
        np.testing.assert_array_equal(found.deviations, everything.deviations[: last + 1])
        assert any(f"of the first {last + 1} of 1,000 steps" in remark for remark in found.remarks)


def test_progress_is_told() -> None:
    of = scenario(100, CHEAP, GPS, steps=1000, hr_hz=400)
    told: list[tuple[int, int, str]] = []
    accuracy_along(
        question_of(of, Path(), model="ins-gps", initial_std=[1.0] * 9),
        of,
        run_scenario(of),
        on_progress=lambda *what: told.append(what),
    )
    assert 90 <= len(told) <= 110
    assert [done for done, _, _ in told] == sorted(done for done, _, _ in told)
    assert told[-1][1:] == (2000, "steps of the accuracy")


def test_a_file_says_what_the_model_does_not() -> None:
    barometer = Seen(((0.0, 0.0, 1.0) + (0.0,) * 6,), ((4.0,),))
    of = scenario(
        100,
        CHEAP | {"correct.barometer": 1},
        GPS,
        sensor("barometer", 8),
        steps=4000,
        hr_hz=400,
        accuracy=AccuracyAsked(model="ins-gps", output="2", sensors={"barometer": barometer}),
    )
    alone = scenario(100, CHEAP, GPS, steps=4000, hr_hz=400)
    both, one = along(of)[0], along(alone, model="ins-gps", output="2")[0]
    assert both.spread.worst < one.spread.median
    H, R = question(of).model.of.sensors["gps"]
    np.testing.assert_array_equal(H, INS.H)
    np.testing.assert_array_equal(R, INS.R)


def question(of: Scenario, **asked: Any) -> Question:
    return question_of(of, Path(), **asked)


TWO = scenario(100, CHEAP | {"correct.radio": 1}, GPS, sensor("radio", 8), steps=400, hr_hz=400)
H, R = ((1.0,) * 9,), ((1.0,),)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (
            AccuracyAsked("ins-gps"),
            r"model'? 'ins-gps' has the H and R of one sensor, and the scenario has several: gps",
        ),
        (AccuracyAsked("ins-gps", sensors={"rdio": Seen(H, R)}), r"\[accuracy.sensors\] has 'rdio', which is none of"),
        (AccuracyAsked("ins-gps", sensors={"radio": Seen(H, None)}), "'ins-gps' has the H and R of one sensor"),
        (AccuracyAsked("ins-gps", sensors={"radio": Seen(H, ((0.0,),))}), "sensor 'radio': R .* positive definite"),
        (AccuracyAsked("ins-gps", sensors={"radio": Seen(((1.0,),), R)}), r"sensor 'radio': H has shape \(1, 1\)"),
        (AccuracyAsked("ins-gps", "7:10", sensors={"radio": Seen(H, R)}), r"\[accuracy\] output 7:10.* 0 to 8"),
        (AccuracyAsked("nope"), r"\[accuracy\] model 'nope' is unknown"),
        (AccuracyAsked(), "^model is missing"),
        (
            AccuracyAsked("ins-gps", initial_std=(1.0,), sensors={"radio": Seen(H, R)}),
            r"\[accuracy\] initial_std \[1.0\]: give 9 numbers",
        ),
    ],
)
def test_what_a_file_asks_and_cannot_be_is_named(asked: AccuracyAsked, said: str) -> None:
    from dataclasses import replace

    with pytest.raises(InputError, match=said):
        question(replace(TWO, accuracy=asked))


def test_a_model_of_another_kind_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    given_by(tmp_path, monkeypatch, SensorsModel(CV.Phi, CV.Q, {"GPS": (CV.H, CV.R)}))
    of = scenario(100, CHEAP, GPS, steps=400)
    with pytest.raises(InputError, match="model 'model:it' has no sensor 'gps', but GPS"):
        question(of, model="model:it", output="0")
    with pytest.raises(InputError, match="depends on the time of a step: give the scenario hr_hz"):
        question(of, model="ins-gps")


def test_outputs_that_grow_want_a_start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    given_by(tmp_path, monkeypatch, SensorsModel(np.eye(2), np.eye(2), {"gps": (np.eye(1, 2), np.eye(1))}))
    of = scenario(100, CHEAP, GPS, steps=400)
    with pytest.raises(InputError, match=r"state 1 .* grows without bound.* give initial_std"):
        question(of, model="model:it", output="0,1")
    found, _ = along(of, model="model:it", output="1", initial_std=[1.0, 2.0])
    np.testing.assert_allclose(found.deviations, np.sqrt(4.0 + np.arange(400)))
    alone, _ = along(of, model="model:it", output="0")
    assert alone.spread.worst < 13


@pytest.mark.parametrize("model", [INS, CV])
def test_sensors_between_steps_settle_too(model: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sensors = {"gps": (model.H, model.R), "camera": (model.H, 3 * model.R)}
    given_by(tmp_path, monkeypatch, SensorsModel(model.Phi, model.Q, sensors))
    camera = sensor("camera", Fraction(40, 3), Fraction(5, 2), offset=Fraction(90, 7))
    of = scenario(100, CHEAP | {"correct.camera": 1}, sensor("gps", 20, 11), camera, steps=400)
    found, _ = along(of, model="model:it", output="0")
    np.testing.assert_allclose(found.deviations[80:], found.deviations[40:-40], rtol=1e-9)


def test_what_grows_beyond_all_numbers_is_cut_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    given_by(tmp_path, monkeypatch, SensorsModel([[2.0]], [[1.0]], {"gps": ([[1.0]], [[1.0]])}))
    of = scenario(100, CHEAP, sensor("gps", 600, 599), steps=1000)
    found, _ = along(of, model="model:it", output="0", initial_std=[1.0])
    assert 500 < found.last < 512
    assert np.isfinite(found.spread.worst)
    assert any("too large for a number" in remark for remark in found.remarks)


def test_what_the_figures_are_not_of_is_told() -> None:
    asked = AccuracyAsked("ins-gps", sensors={"radio": Seen(H, R)})
    late = scenario(0.9, CHEAP | {"correct.radio": 1}, GPS, sensor("radio", 8), steps=100, hr_hz=400, accuracy=asked)
    assert any("predict jobs finish late" in remark for remark in along(late)[0].remarks)
    costs = CHEAP | {"correct.radio": 1, "predict_accumulate": 1, "correct_late.gps": 1, "correct_accumulate.radio": 1}
    costs |= {"carry_product.gps": 1, "beside_product.radio": 1, "land_product.gps": 1, "carry_product": 1}
    larsen = scenario(100, costs, GPS, sensor("radio", 8), steps=100, hr_hz=400, accuracy=asked, late="larsen")
    assert any("late = larsen is not as good" in remark for remark in along(larsen)[0].remarks)


@pytest.mark.parametrize(("delays", "told"), [([10], False), ([4, 30], True)])
def test_one_that_overtakes_another_of_its_own_sensor_is_told_of(delays: list[int], told: bool) -> None:
    parts = ("hr_propagate", "hr_restart", "hr_update", "lr_propagate", "gain.gps", "lr_correct.gps", "hr_pass.gps")
    gps = sensor("gps", 8, delays, land_by=40)
    asked = AccuracyAsked("ins-gps")
    of = scenario(100, dict.fromkeys(parts, 1), gps, steps=200, hr_hz=400, accuracy=asked, late="dual-rate")
    found, outcome = along(of)
    assert outcome.sensors["gps"].landings
    assert any("late = dual-rate is not as good" in remark for remark in found.remarks) == told


@pytest.mark.parametrize(("late", "at_most"), [("recalculate", 1.0), ("carried-gain", 1.05), ("larsen", 1.05)])
def test_it_is_the_covariance_of_the_filter_itself(
    late: Any, at_most: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A modular filter that gets each measurement in the step in which the simulation has it landed; one that carries
    its corrections is not quite as good, as the remark says."""
    camera = linear_corrector([[1.0, 0.0]], [[0.3]])
    gps = linear_corrector(np.eye(2), np.diag([4.0, 1.0]))
    sensors = [Sensor("gps", gps, 20, range(5, 30), 0.2), Sensor("camera", camera, 7, range(2, 6), 0.1)]
    composed = ModularFilter(linear_predictor(CV.Phi, CV.Q), sensors)
    given_by(tmp_path, monkeypatch, composed)
    costs = {"predict": [1, 2], "correct.gps": [1, 5], "correct.camera": [1, 4]}
    of = scenario(9, costs, sensor("gps", 20, range(5, 30), land_by=90), sensor("camera", 7, range(2, 6)), steps=300)
    found, outcome = along(of, model="model:it", output="0", initial_std=[2.0, 1.0])
    measured = [
        Measurement(name, k, l, np.zeros(2 if name == "gps" else 1))
        for name, figures in outcome.sensors.items()
        for k, l in figures.landings
    ]
    history = {"history": 200} if late == "recalculate" else {}
    ran = run(composed, [0.0, 0.0], np.diag([4.0, 1.0]), np.zeros((299, 0)), measured, late=late, **history)
    over = np.sqrt(ran.P[:, 0, 0]) / found.deviations
    assert over.min() > 1 - 1e-9
    assert over.max() < at_most + 1e-9
