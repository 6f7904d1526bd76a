"""What biases of the rocket's sensors do, in the report on modular filters, as a table and in words."""

from __future__ import annotations

from typing import Any

from filters.systems.rocket_filter import SENSORS
from reports.modular.bias_rows import ENDS, READINGS
from reports.modular.oscillator import Record
from reports.modular.results import Results
from reports.modular.tables import share_of
from reports.pages.numbers import between
from reports.pages.stored import Rows
from studies.modular.biases import LARGE

ALL = " and ".join(SENSORS)


def bias_table(results: Results) -> Rows:
    """A row for each case."""
    holds = [f"{name} {what}" for name in READINGS for what in ("holds, %", "from s")]
    rows: Rows = [["Bias of", "size", "position, m", "orientation, °", *holds]]
    for row in results.records("rocket-biases"):
        said = "all" if row["biased"] == ALL else row["biased"] or "none"
        cells = [cell for name in READINGS for cell in (_holds(row, name), f"{float(row[f'{name} from s']):.2f}")]
        rows.append([said, row["size"] if row["biased"] else "-", *(_error(row, name) for name in READINGS), *cells])
    return rows


def bias_words(results: Results) -> dict[str, Any]:
    """How many flights keep to the claim with biases of all sensors, as large as the noise and larger."""
    found: dict[str, Any] = {"large": f"{LARGE:g}"}
    for name, size in (("noise", "1"), ("more", found["large"])):
        (row,) = results.records("rocket-biases", biased=ALL, size=size)
        found[name] = {quantity: _holds(row, quantity) for quantity in READINGS}
        found[name]["worst"] = row["position worst"]
        found[name]["from_s"] = f"{float(row['position from s']):.2f}"
    return found


def _holds(row: Record, name: str) -> str:
    return share_of(int(row[f"{name} holds"]), int(row["runs"]))


def _error(row: Record, name: str) -> str:
    return between(*(float(row[f"{name}{end}"]) for end in ENDS))
