"""The files steps.h, steps.c and state.h of a method, and its run on the record."""

from __future__ import annotations

from collections.abc import Mapping
from string import Template
from typing import Any

from filters.jobs import Job
from filters.translation.data import Data
from filters.translation.kinds import Record
from studies.board.jobs import Jobs, call
from studies.board.serial.method import Parts, Serial, add_common, in_flight
from studies.board.steps import Files, Steps
from studies.board.template import filled
from studies.board.wanted import Filter

FOLDER = "steps"


def steps_files(serial: Serial, wanted: Filter, steps: Steps, jobs: Mapping[str, Job], in_c: Jobs) -> Files:
    """steps.h, steps.c and state.h. in_c: the jobs in C."""
    data = Data(in_c.unit)
    parts = Parts(data, wanted.system, in_c, steps)
    add_common(parts, jobs)
    serial.memory(parts)
    words = _words(serial, wanted, steps, in_c)
    start = Template(serial.start).substitute(words)
    words["started"] = start
    words["head"] = _filled("head.c", words)
    words["functions"] = _filled(serial.template, words)
    words["fields"] = Template(serial.fields).substitute(words)
    words["memory"] = "\n".join(data.lines)
    names = {"steps.h": "steps.h", "steps.c": "source.c", "state.h": "state.h"}
    return Files({name: _filled(template, words) for name, template in names.items()}, data.sizes)


def steps_run(serial: Serial, wanted: Filter) -> str:
    """The function of test.c that runs the filter on the record."""
    measure = """        if (j >= DELAY_STEPS && (j - DELAY_STEPS) % CYCLE_STEPS == 0 &&
            (j - DELAY_STEPS) / CYCLE_STEPS < RECORD_MEASURED) {
            filter_measure(record_y[(j - DELAY_STEPS) / CYCLE_STEPS]);
        }
"""
    take = """        if (j % CYCLE_STEPS == 0 && j / CYCLE_STEPS < RECORD_MEASURED) {
            filter_take();
        }
"""
    before = measure if serial.order == "before" else ""
    after = "" if before else "        filter_measure(record_y[j]);\n" if serial.order == "each" else measure
    after += take if serial.takes else ""
    u = "record_u[j - 1]" if wanted.system.inputs else ""
    return _filled("run.c", {"before": before, "after": after, "u": u})


def _filled(name: str, words: Mapping[str, Any]) -> str:
    return filled(f"{FOLDER}/{name}", words)


def _words(serial: Serial, wanted: Filter, steps: Steps, in_c: Jobs) -> dict[str, Any]:
    n, m, p = wanted.system[:3]
    return {
        **{"n": n, "m": m, "p": p, **steps._asdict(), "in_flight": in_flight(steps)},
        "zero": in_c.unit.number(0.0),
        "title": serial.title,
        "behaviour": serial.behaviour,
        "u_parameter": f"real u[{m}]" if m else "void",
        "u_doc": ", with the input u of the step before" if m else "",
        "unused_u": "    (void)u; /* the model does not ask for it */\n" if m and _ignores_u(in_c) else "",
        "x_start": serial.x,
        "P_start": serial.P,
        "x_now": serial.now,
        **_records(in_c),
        **_calls(serial, in_c),
        **_documented(serial, steps),
        "unused_k": "" if _uses(in_c, "predict", "j") else "    (void)k; /* the model does not ask for it */\n",
        **serial.words(wanted, steps),
    }


def _uses(in_c: Jobs, kind: str, name: str) -> bool:
    return kind in in_c.by_kind and name in in_c.by_kind[kind].used


def _ignores_u(in_c: Jobs) -> bool:
    return not any("u" in job.used for job in in_c.by_kind.values())


def _records(in_c: Jobs) -> dict[str, str]:
    """The names in C of the records that the jobs take, by those that they have in Python."""
    found = {}
    for job in in_c.by_kind.values():
        for kind in job.kinds:
            if isinstance(kind, Record) and kind in in_c.unit.records:
                found[kind.name] = in_c.unit.record_name(kind)
    return found


def _calls(serial: Serial, in_c: Jobs) -> dict[str, str]:
    calls = {}
    for kind, job in in_c.by_kind.items():
        texts = {name: serial.texts.get(f"{kind}.{name}", serial.texts.get(name, name)) for name in job.used}
        calls[kind] = call(job, texts, {name: f"{kind}_{name}" for name in job.memory})
    return calls


def _documented(serial: Serial, steps: Steps) -> dict[str, str]:
    """What is said of when to call what."""
    N, M, L = steps
    if serial.order == "each":
        return {
            "when": f"N = {N}: a gain is computed at k = 0, N, 2N, ...; L = {L}: it is in use from l = k + L on.",
            "more_steps": f", LANDING_STEPS = {L}",
            "before_its_measurement": ", before its measurement",
            "take": "",
            "measure_doc": "/* In each step, and in step 0, after filter_step: its measurement y. Left out where it is "
            "lost. */",
        }
    when = f"N = {N}: a measurement is taken at k = 0, N, 2N, ...; M = {M}: it arrives at m = k + M, and is used there"
    place = "before" if serial.order == "before" else "after"
    lost = "One that was taken must come" if serial.takes else "Left out where it is lost"
    taken = (
        "/* In step k, and in step 0, behind all else: a measurement is taken. Left out where none is. */\n"
        "void filter_take(void);\n\n"
    )
    landing = "delayed_horizon" in serial.template
    return {
        "when": f"{when}{f'; L = {L}: it is in the state from l = k + L on' if landing else ''}.",
        "more_steps": f", DELAY_STEPS = {M}" + (f", LANDING_STEPS = {L}" if landing else ""),
        "before_its_measurement": "",
        "take": taken if serial.takes else "",
        "measure_doc": f"/* In step m, {place} filter_step: the measurement y of step k = m - M. {lost}. */",
    }
