"""All files of a composed filter."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from filters.jobs import Job
from filters.modular.composition import ModularFilter
from filters.modular.correctors import observe_numeric
from filters.modular.jobs import modular_jobs
from filters.modular.kept import kept_by
from filters.modular.predictors import evolve_numeric
from filters.translation.kinds import Record
from sched_sim.errors import option
from studies.board.assembled import NUMERIC, USUAL, Around, assembled, words_of_run
from studies.board.composed.memory import memory
from studies.board.composed.record import recorded
from studies.board.composed.wanted import Composed
from studies.board.jobs import Jobs, call, named, translated
from studies.board.readme import About
from studies.board.serial.pieces import kept_input
from studies.board.template import filled


def composed_files(wanted: Composed) -> dict[str, str]:
    """The files, by name.

    Raises:
        Untranslatable: something in a part has nothing in C; its file and line are named.
        ValueError: it cannot be filtered from the typical start, or takes differences that floats do not resolve.
    """
    if wanted.precision == "single":
        _check_differences(wanted.composed)
    jobs = _jobs(wanted)
    in_c = translated(jobs, wanted.precision)
    sensors = ", ".join(wanted.identifiers) or "no sensor"
    about = About(
        wanted.name,
        f"{wanted.composed.of.errors} states; {sensors}; {wanted.composed.update} covariance update; "
        f"{wanted.precision} precision",
        "",
        wanted.precision,
        wanted.said,
        "composed",
        question="sched-sim simulate --scenario FILE",
    )
    return assembled(about, jobs, in_c, _around(wanted, in_c))


def _check_differences(composed: ModularFilter) -> None:
    for part in numeric_parts(composed):
        raise ValueError(
            f"{part}: it takes its Jacobian by differences, which single precision does not resolve; give it a "
            f"jacobian, make it unscented, or choose {option('precision')} double"
        )


def numeric_parts(composed: ModularFilter) -> list[str]:
    """The parts that take their Jacobian by differences, in words."""
    parts = {"predictor": composed.predictor.evolve is evolve_numeric}
    parts |= {f"sensor {each.name!r}": each.corrector.observe is observe_numeric for each in composed.sensors}
    return [part for part, numeric in parts.items() if numeric]


def _jobs(wanted: Composed) -> dict[str, Job]:
    """predict, correct_SENSOR, and what keeps the first covariance."""
    composed = wanted.composed
    parts = modular_jobs(composed, wanted.x0, wanted.P0, wanted.u)
    jobs = {"predict": parts["predict"]}
    jobs |= {f"correct_{own}": parts[f"correct.{name}"] for name, own in wanted.identifiers.items()}
    keep = kept_by(composed).keep
    jobs["keep"] = Job("keep", keep, lambda _: (wanted.P0.copy(), np.zeros_like(wanted.P0)))
    return named(jobs, all_of_them=True)


def _around(wanted: Composed, in_c: Jobs) -> Around:
    space, m = wanted.composed.of, len(wanted.u)
    data = memory(wanted, in_c)
    before = in_c.parameter("predict", "before")
    assert isinstance(before, Record)
    own = wanted.identifiers
    words: dict[str, Any] = {
        "title": f"composed filter {wanted.name}",
        "numbers": space.numbers,
        "n": space.errors,
        "m": m,
        "depth": wanted.depth,
        "u_parameter": f"real u[{m}]" if m else "void",
        "u_doc": ", u being the input of the step before it" if m else "",
        "Estimate": in_c.unit.record_name(before),
        "keep_u": kept_input(m, "filter_u[filter.j % KEPT_STEPS]"),
        "forget": "".join(f"    filter.{each}_known[filter.j % KEPT_STEPS] = false;\n" for each in own.values()),
        "forget_all": _forget_all(own),
        "used": "".join(
            f"        if (filter.{each}_known[slot]) {{\n            correct_by_{each}(slot);\n        }}\n"
            for each in own.values()
        ),
        "fields": "    int first; /* from which on all is to be done */\n"
        + "".join(f"    bool {each}_known[KEPT_STEPS];\n" for each in own.values()),
        "memory": f"enum {{ KEPT_STEPS = {wanted.depth + 1} }};\n\n" + "\n".join(data.lines),
        **_calls(wanted, in_c),
    }
    lengths = {sensor.name: sensor.corrector.observed.numbers for sensor in wanted.composed.sensors}
    each = [
        {
            **words,
            "name": name,
            "identifier": own[name],
            "length": lengths[name],
            "correct": words[f"correct_{own[name]}"],
        }
        for name in own
    ]
    words["corrections"] = "\n".join(filled("steps/composed_correction.c", one) for one in each)
    words["given"] = "".join(filled("steps/composed_measure.c", one) for one in each).rstrip("\n") + "\n"
    words["measures"] = "\n".join(
        f"void filter_measure_{own[name]}(int taken, real y[{lengths[name]}]);" for name in own
    )
    words["functions"] = filled("steps/composed.c", words)
    templates = {"steps.h": "composed.h", "steps.c": "source.c", "state.h": "state.h"}
    files = {name: filled(f"steps/{template}", words) for name, template in templates.items()}
    record = recorded(wanted)
    return Around(
        {**files, "record.h": record.header(wanted)},
        ["filter.c", "steps.c"],
        data.sizes,
        words_of_run("steps", record.run(wanted), NUMERIC if numeric_parts(wanted.composed) else USUAL),
        {"predict": "predict"} | {f"correct.{_key(name)}": f"correct_{each}" for name, each in own.items()},
        costs=("[samples]", "%s = [%.4f]"),
    )


def _forget_all(own: Mapping[str, str]) -> str:
    if not own:
        return ""
    lines = [f"        filter.{each}_known[i] = false;" for each in own.values()]
    return "\n".join(["    for (int i = 0; i < KEPT_STEPS; i++) {", *lines, "    }", ""])


def _key(name: str) -> str:
    """A key of TOML."""
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else '\\"' + name.replace('"', "'") + '\\"'


def _calls(wanted: Composed, in_c: Jobs) -> dict[str, str]:
    calls = {}
    for kind, job in in_c.by_kind.items():
        own = kind.removeprefix("correct_")
        texts = {
            "motion": "&filter_motion",
            "space": "&filter_space",
            "before": "&before",
            "after": "&after",
            "u": "filter_u[(i - 1) % KEPT_STEPS]" if len(wanted.u) else "NULL",
            "dt": in_c.unit.number(wanted.composed.dt),
            "view": f"&filter_{own}_view",
            "observed": f"&filter_{own}_observed",
            "y": f"filter_{own}_y[slot]",
            "lost": f"(bool *)filter_{own}_lost",
            "work": "&filter_work" if kind == "predict" else f"&filter_{own}_work",
        }
        if kind == "keep":
            texts = dict(zip(job.parameters, ("P", "filter_predicted_P[0]"), strict=True))
        calls[kind] = call(job, texts, {name: f"{kind}_{name}" for name in job.memory})
    return calls
