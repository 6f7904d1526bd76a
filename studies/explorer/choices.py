"""What there is to choose from, by the keys of a query."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, get_args

from filters.accuracy.shipped import SHIPPED_MODELS
from sched_sim.design import options
from sched_sim.design.pieces import Statistic
from studies.explorer.given import Given
from studies.explorer.resolved import Resolved
from studies.selection.compare import Metric

Choices = dict[str, Any]


def choices_of(asked: Resolved) -> Choices:
    """Lists of names; of processors and models objects with their titles, of models with their outputs."""
    return {"method": list(asked.methods), **_of_all(asked.given)}


@lru_cache(maxsize=16)
def _of_all(given: Given) -> Choices:
    """Whatever the design is."""
    known = {name: list(values) for name, values in options.choices().items() if values}
    return {
        "costs": given.table_names,
        "processor": [{"name": name, "title": given.part(name).title} for name in given.part_names],
        "model": [_model(given, name) for name in given.model_names],
        **known,
        "metric": list(get_args(Metric)),
        "statistic": list(get_args(Statistic)),
    }


def _model(given: Given, name: str) -> Choices:
    shipped = None if name in given.models else SHIPPED_MODELS[name]
    if shipped is None:
        return {"name": name, "title": name, "outputs": []}
    outputs = [{"name": output, "unit": of.unit} for output, of in shipped.outputs.items()]
    return {"name": name, "title": shipped.what, "outputs": outputs}
