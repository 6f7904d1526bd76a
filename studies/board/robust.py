"""The extended robust filter, step by step."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.jobs import Job
from filters.robust.extended import ExtendedWorkspace, Setting, linearise, run
from filters.robust.jobs import RobustCase, robust_jobs
from filters.robust.model import prepared, weights, without_measurement
from filters.robust.step import JOBS, WayName
from filters.robust.uncertain import linearised
from filters.translation.data import Data, Kept, Placing
from filters.translation.kinds import Record
from filters.translation.library import Precision
from studies.board.assembled import Around, assembled, words_of_run
from studies.board.jobs import Jobs, call, named, translated
from studies.board.readme import About
from studies.board.record import SEED, held, record_h
from studies.board.record import Record as Recorded
from studies.board.template import filled

SOURCE = "Weights are those of Sayed and Nascimento 1999, and Rocha and Terra 2021."


class Robust(NamedTuple):
    """What is to be written. name: of the case; N: steps from one measurement to the next."""

    name: str
    case: RobustCase
    way: WayName
    precision: Precision
    N: int
    said: str


def robust_files(wanted: Robust) -> dict[str, str]:
    """The files, by name.

    Raises Untranslatable where something has nothing in C: its file and line are named.
    """
    jobs = _jobs(wanted)
    in_c = translated(jobs, wanted.precision)
    n, p = len(wanted.case.start.x), len(wanted.case.start.y)
    about = About(
        f"robust-{wanted.way}",
        f"{wanted.name}: {n} states, {p} measurements; {wanted.precision} precision",
        SOURCE,
        wanted.precision,
        wanted.said,
        "steps",
        "`filter_step`, in a step with a measurement `filter_measure` before it (not at all if that was lost).",
        f"sched-sim minimum --costs board.toml --hr-hz 400 --method robust-{wanted.way} -N {wanted.N} -L {wanted.N}",
    )
    return assembled(about, jobs, in_c, _around(wanted, in_c))


def _jobs(wanted: Robust) -> dict[str, Job]:
    case, way = wanted.case, wanted.way
    jobs = {kind: robust_jobs(case)[f"robust-{way}", kind] for kind in ("inertial", "robust_step")}

    def linearise_arguments(index: int) -> tuple[Any, ...]:
        system, scaling, _, _, x, u, before, _, _, work = jobs["robust_step"].arguments(index)
        return system, scaling, x, u, before.x, _unseen(case, way, x, u).model, work

    def step_arguments(index: int) -> tuple[Any, ...]:
        _, _, _, _, x, u, before, _, after, work = jobs["robust_step"].arguments(index)
        unseen = _unseen(case, way, x, u)
        return unseen.model, unseen.weights, before, work.no_y, np.zeros_like(x), after, unseen.work

    return named(
        {
            **jobs,
            "linearise": Job("linearise", linearise, linearise_arguments),
            "step_unseen": Job("step_unseen", JOBS[way].function, step_arguments),
        },
        all_of_them=True,
    )


def _unseen(case: RobustCase, way: WayName, x: FloatArray, u: FloatArray) -> Setting:
    """Of a step without a measurement."""
    model = linearised(case.system, case.scaling, case.uncertainty, x, u)
    return _setting(case, way, prepared(without_measurement(model), case.mu))


def _seen(case: RobustCase, way: WayName) -> Setting:
    start = case.start
    return _setting(
        case, way, prepared(linearised(case.system, case.scaling, case.uncertainty, start.x, start.u), case.mu)
    )


def _setting(case: RobustCase, way: WayName, model: Any) -> Setting:
    return Setting(model, weights(model, case.mu), JOBS[way].workspace(model))


def _around(wanted: Robust, in_c: Jobs) -> Around:
    case, N = wanted.case, wanted.N
    n, m, p = len(case.start.x), len(case.start.u), len(case.start.y)
    data = _memory(wanted, in_c)
    before = in_c.parameter("robust_step", "before")
    assert isinstance(before, Record)
    words = {
        **{"n": n, "m": m, "p": p, "N": N},
        "title": f"extended robust filter of {wanted.name}",
        "behaviour": "Each step predicts, one with a measurement from it, one without from the model alone.",
        "when": f"N = {N}: a measurement is taken in steps 0, N, 2N, ..., and used from the next on.",
        "more_steps": "",
        "before_its_measurement": ", before its measurement; P scaled, see `Scaling`",
        "u_parameter": f"real u[{m}]",
        "u_doc": ", with the input u of the step before",
        "take": "",
        "measure_doc": "/* Before filter_step: the measurement y of the step before it. Left out if none came. */",
        "Predicted": in_c.unit.record_name(before),
        "fields": "    int now; /* which of the estimates in memory */\n"
        "    bool measured; /* whether a measurement waits for the step */\n",
        "memory": "\n".join(data.lines),
        **_calls(in_c),
    }
    words["functions"] = filled("steps/robust.c", words)
    files = {"steps.h": "steps.h", "steps.c": "source.c", "state.h": "state.h"}
    texts = {name: filled(f"steps/{template}", words) for name, template in files.items()}
    measure = "        if (j > 0 && (j - 1) % CYCLE_STEPS == 0) {\n"
    measure += "            filter_measure(record_y[(j - 1) / CYCLE_STEPS]);\n        }\n"
    running = filled("steps/run.c", {"before": measure, "after": "", "u": "record_u[j - 1]"})
    return Around(
        {**texts, "record.h": record_h(_simulated(wanted), wanted.precision)},
        ["filter.c", "steps.c"],
        data.sizes,
        words_of_run("steps", running),
        {kind: kind for kind in ("inertial", "robust_step")},
    )


def _calls(in_c: Jobs) -> dict[str, str]:
    texts = {
        "system": "&filter_system",
        "scaling": "&filter_scaling",
        "y": "filter_y",
        "x": "filter_x",
        "u": "u",
        "before": "&before",
        "after": "&after",
        "seen": "&filter_seen",
        "scaled_x": "before.x",
        "work": "&filter_work",
        "linearise.model": "&filter_unseen_model",
        "step_unseen.model": "&filter_unseen_model",
        "weights": "&filter_unseen_weights",
        "step_unseen.y": "filter_work.no_y",
        "c": "filter_work.c",
        "step_unseen.work": "&filter_unseen_work",
    }
    return {
        kind: call(
            job,
            {name: texts.get(f"{kind}.{name}", texts.get(name, name)) for name in job.used},
            {name: f"{kind}_{name}" for name in job.memory},
        )
        for kind, job in in_c.by_kind.items()
    }


def _memory(wanted: Robust, in_c: Jobs) -> Data:
    case, way, start = wanted.case, wanted.way, wanted.case.start
    data, n, p = Data(in_c.unit), len(start.x), len(start.y)
    work = ExtendedWorkspace(np.zeros(n), np.zeros(p), np.zeros(p), np.zeros(0), np.zeros(n))
    data.lines.append("/* The model; F and G are those of the last step, all else is constant. */")
    seen, unseen = _seen(case, way), _unseen(case, way, start.x, start.u)
    places: dict[str, tuple[Any, str, str, Placing]] = {
        "system": (case.system, "robust_step", "system", _constant),
        "scaling": (case.scaling, "robust_step", "scaling", _constant),
        "seen": (seen, "robust_step", "seen", _of_setting),
        "unseen_model": (unseen.model, "linearise", "model", _of_setting),
        "unseen_weights": (unseen.weights, "step_unseen", "weights", _of_setting),
        "unseen_work": (unseen.work, "step_unseen", "work", _of_setting),
        "work": (work, "robust_step", "work", _changing),
    }
    for name, (value, kind, parameter, placing) in places.items():
        record = in_c.parameter(kind, parameter)
        assert isinstance(record, Record)
        data.record(f"filter_{name}", value, record, _used(placing, in_c.fields(record)))
    data.lines.append("\n/* The estimate, in the units of the system and scaled, and the measurement that waits. */")
    for name, shape in {"x": (n,), "scaled_x": (2, n), "P": (2, n, n), "y": (p,)}.items():
        data.array(Kept(f"filter_{name}"), np.zeros(shape))
    return data


def _used(placing: Placing, fields: frozenset[str]) -> Placing:
    return lambda names: placing(names) if names[-1] in fields else None


def _constant(names: tuple[str, ...]) -> Kept:
    return Kept("_".join(names), constant=True)


def _changing(names: tuple[str, ...]) -> Kept:
    return Kept("_".join(names))


def _of_setting(names: tuple[str, ...]) -> Kept:
    """F and G are overwritten, and the workspace but for what `BlockWorkspace` says."""
    changes = any(name.endswith("work") for name in names[:2]) and names[-1] not in ("starts", "constant")
    return Kept("_".join(names), constant=not (changes or names[-1] in ("F", "G")))


def _simulated(wanted: Robust) -> Recorded:
    """A record along a path without noise, near the typical moment."""
    case, N = wanted.case, wanted.N
    system, start = case.system, case.start
    random = np.random.default_rng(SEED)
    steps, cycles = 2 * N + 1, 3
    u = held(start.u + 0.01 * random.normal(size=(steps, len(start.u))), wanted.precision)
    x0 = held(start.x, wanted.precision)
    truth, y = x0.copy(), np.zeros((cycles, len(start.y)))
    for i in range(steps):
        if i % N == 0:
            system.residual(start.y, truth, y[i // N])
            y[i // N] = start.y - y[i // N] + 0.1 * case.scaling.measurement_unit * random.normal(size=len(start.y))
        after = np.empty_like(truth)
        system.f(truth, u[i], system.parameters, after)
        truth = after
    y = held(y, wanted.precision)
    history = run(
        system, case.scaling, case.uncertainty, N, x0, start.P, u, y, mu=case.mu, way=wanted.way, backend="reference"
    )
    return Recorded(x0, start.P, u, y, history.x)
