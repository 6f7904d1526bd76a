"""The arrays of a composed filter, and the records that point at them."""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.modular.arrivals import whole
from filters.modular.space import NOTHING
from filters.modular.workspace import new_workspace
from filters.translation.data import Data, Kept, Placing
from filters.translation.kinds import Record
from studies.board.composed.wanted import Composed
from studies.board.jobs import Jobs


def memory(wanted: Composed, in_c: Jobs) -> Data:
    """The declarations."""
    composed, data = wanted.composed, Data(in_c.unit)
    space, m, kept = composed.of, len(wanted.u), wanted.depth + 1
    data.lines.append("/* The model, which is constant, and the workspaces of its parts. */")
    values: dict[str, dict[str, Any]] = {
        "predict": {"motion": composed.predictor.motion, "space": space, "work": new_workspace(space, NOTHING)}
    }
    for sensor in composed.sensors:
        corrector, own = sensor.corrector, wanted.identifiers[sensor.name]
        work = new_workspace(space, corrector.observed)
        values[f"correct_{own}"] = {
            f"{own}_view": corrector.view(space.errors),
            f"{own}_observed": corrector.observed,
            "space": space,
            f"{own}_work": work,
        }
    taken = set[str]()
    for kind, records in values.items():
        job = in_c.by_kind[kind]
        for name, value in records.items():
            parameter = name if kind == "predict" else name.removeprefix(f"{kind.removeprefix('correct_')}_")
            record = in_c.parameter(kind, parameter)
            if parameter not in job.used or name in taken or not isinstance(record, Record):
                continue
            taken.add(name)
            fields = in_c.fields(record)
            data.record(f"filter_{name}", value, record, _work(fields) if parameter == "work" else _constant)
    for sensor in composed.sensors:
        own = wanted.identifiers[sensor.name]
        if "lost" in in_c.by_kind[f"correct_{own}"].used:
            data.array(Kept(f"filter_{own}_lost", constant=True), whole(sensor.corrector.observed), "bool")
    data.lines.append("\n/* The estimate, and a second one in turn; what is kept of the last steps. */")
    arrays: dict[str, tuple[int, ...]] = {
        "x": (space.numbers,),
        "P": (space.errors, space.errors),
        "corrected_x": (space.numbers,),
        "corrected_P": (space.errors, space.errors),
        "predicted_x": (kept, space.numbers),
        "predicted_P": (kept, space.errors, space.errors),
        **({"u": (kept, m)} if m else {}),
    }
    for sensor in composed.sensors:
        arrays[f"{wanted.identifiers[sensor.name]}_y"] = (kept, sensor.corrector.observed.numbers)
    for name, shape in arrays.items():
        data.array(Kept(f"filter_{name}"), np.zeros(shape))
    return data


def _constant(names: tuple[str, ...]) -> Kept:
    return Kept("_".join(names), constant=True)


def _work(fields: frozenset[str]) -> Placing:
    return lambda names: Kept("_".join(names)) if names[-1] in fields else None
