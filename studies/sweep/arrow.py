"""A sweep's rows in Arrow's columns, as Parquet, pandas, polars and pyarrow take them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import pyarrow as pa

from studies.sweep.rows import Column
from studies.sweep.store import Store

TYPES = {"int": pa.int64(), "bool": pa.bool_(), "float": pa.float64(), "text": pa.string()}


def schema(columns: Sequence[Column]) -> pa.Schema:
    """A typed column for each figure."""
    return pa.schema([(column.name, TYPES[column.kind]) for column in columns])


def tables(store: Store, at_a_time: int) -> Iterator[pa.Table]:
    """All rows in order of their design index, in portions; null where there is no figure."""
    for rows in store.results(at_a_time):
        cells = zip(*rows, strict=True) if rows else [()] * len(store.columns)
        arrays = [_array(values, column) for values, column in zip(cells, store.columns, strict=True)]
        yield pa.Table.from_arrays(arrays, schema=schema(store.columns))


def _array(cells: Sequence[Any], column: Column) -> pa.Array:
    if column.kind == "bool":
        cells = [None if cell is None else bool(cell) for cell in cells]
    return pa.array(cells, TYPES[column.kind])
