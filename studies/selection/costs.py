"""The costs of a model's filters, in each form of the covariance update that there is a table of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sched_sim.costs.table import COUNTED, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.errors import InputError, option
from studies.selection.model import Model

if TYPE_CHECKING:
    from filters.covariance_forms import CovarianceFormName

FORMS: tuple[CovarianceFormName, ...] = ("textbook", "short")
SHIPPED = {(9, 3, 3): (COUNTED, f"{COUNTED}-short")}
"""By states, inputs and measurements: tables of FORMS."""


def tables_for(
    model: Model, names: Sequence[str] | None, forms: Sequence[CovarianceFormName] = FORMS
) -> tuple[CostTable, ...]:
    """The named tables; or counts for a system of the model's sizes, of the user's own System itself.

    Raises InputError for tables of several units, and where the user's functions cannot be counted.
    """
    if names:
        tables = tuple(load_costs(name) for name in dict.fromkeys(names))
        units = list(dict.fromkeys(table.unit for table in tables))
        if len(units) > 1:
            raise InputError(f"{option('costs')}: the tables are in {' and '.join(units)}: give tables of one unit")
        return tables
    if model.system is None and model.sizes in SHIPPED:
        return tuple(load_costs(name) for name, form in zip(SHIPPED[model.sizes], FORMS, strict=True) if form in forms)
    from filters.systems.example import example_system
    from studies.measurement.methods import measure

    system = model.system or example_system(*model.sizes)
    try:
        return tuple(
            measure(system, "counted", form, name="-".join(["counted", *map(str, model.sizes), form]), x0=model.x0)
            for form in FORMS
            if form in forms
        )
    except InputError as error:
        raise InputError(
            f"{option('model')}: its operations cannot be counted ({error}); time them with `sched-sim measure "
            f"--system ... -o FILE` and give {option('costs')} FILE"
        ) from None
