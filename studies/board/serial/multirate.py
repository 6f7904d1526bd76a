"""The multirate gain: a measurement in every step, and a gain in every N-th."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from filters.factored import FactoredFormName, factored_form
from filters.factored.form import FactoredForm
from filters.factored.workspace import new_factored_workspace
from filters.jobs import Job
from filters.multirate_gain import divided_gain, state_correct, state_predict
from filters.records import Sample, new_correction
from filters.registry import MULTIRATE_FORMS
from filters.system import System
from filters.systems.coarse import over
from studies.board.memory import add_model
from studies.board.serial.method import TEXTS, Parts, Serial, add_arrays, as_jobs
from studies.board.serial.pieces import kept_input
from studies.board.steps import Steps
from studies.board.wanted import Filter


def _more(name: FactoredFormName, wanted: Filter) -> Mapping[str, Job]:
    form = factored_form(name, wanted.update)
    return as_jobs(
        wanted,
        form,
        ("state_predict", state_predict, _predict),
        ("state_correct", state_correct, _correct),
        ("divided_gain", divided_gain, _divided_gain),
        ("factor", form.factor, lambda _system, _form, at: (at.P_posterior, np.zeros_like(at.P_posterior))),
    )


def _predict(system: System, _form: FactoredForm, at: Sample) -> tuple[Any, ...]:
    return system, at.m + 1, at.now.x, at.u, np.zeros_like(at.now.x)


def _correct(system: System, _form: FactoredForm, at: Sample) -> tuple[Any, ...]:
    return system, at.m, at.y, new_correction(system)._replace(K=at.correction.K), at.now.x.copy()


def _divided_gain(system: System, form: FactoredForm, at: Sample) -> tuple[Any, ...]:
    P, K = at.P_posterior, np.zeros_like(at.correction.K)
    predicted = np.zeros_like(P)
    form.factor(P, predicted)
    return system, form, at.m, at.m - at.k, at.now.x, predicted, K, np.zeros_like(P), new_factored_workspace(system)


def _memory(parts: Parts) -> None:
    (n, m, p), in_c = parts.system[:3], parts.in_c
    coarse = over(parts.system, parts.steps.N)
    parts.data.lines.append("/* The model over N steps. */")
    add_model(parts.data, "filter", coarse, in_c.parameter("covariance_gain", "coarse"), "coarse")
    add_arrays(parts, x=(2, n), x_at_k=(n,), u_at_k=(m,), predicted=(n, n), factors=(2, n, n), K=(2, n, p))
    add_arrays(parts, z=(p,), delta_x=(n,))


def _words(wanted: Filter, _steps: Steps) -> Mapping[str, Any]:
    return {"keep_u": kept_input(wanted.system.inputs, "filter_u_at_k", "        ")}


def _serial(form: FactoredFormName) -> Serial:
    kept = {"conventional": "the covariance", "square-root": "a square root of P", "u-d": "the factors U and D of P"}
    return Serial(
        title="filter with a multirate gain",
        behaviour=f"It corrects in every step, with a gain that is computed in every N-th, from {kept[form]}.",
        jobs=("state_update", "covariance_gain"),
        order="each",
        template="multirate.c",
        texts={
            **TEXTS,
            "j": "filter.j + 1",
            "x": "filter_x[filter.now]",
            "x_next": "filter_x[next]",
            "state_correct.j": "filter.j",
            "correction": "&correction",
            "coarse": "&filter_coarse",
            "k": "filter.j",
            "n": "CYCLE_STEPS",
            "x_last": "filter_x_at_k",
            "covariance_gain.u": "filter_u_at_k",
            "factors": "filter_factors[filter.factors]",
            "predicted": "filter_predicted",
            "K": "filter_K[row_of(filter.j)]",
            "posterior": "filter_factors[factors_next]",
            "divided_gain.posterior": "filter_factors[0]",
            "A": "filter_factors[1]",
            "P": "filter_factors[1]",
            "out": "filter_predicted",
        },
        memory=_memory,
        fields="    int now; /* which of the estimates in memory */\n"
        "    int factors; /* which of those of P_{k^+} */\n",
        start="    filter.now = 0;\n    filter.factors = 0;\n    $factor;\n    $divided_gain;\n",
        P="filter_factors[1]",
        more=partial(_more, form),
        words=_words,
    )


MULTIRATE: Mapping[str, Serial] = {name: _serial(form) for name, form in MULTIRATE_FORMS.items()}
