"""The jobs of a filter: its pieces of work that are scheduled, and so are costed, as a whole."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, TypeVar

from filters.covariance_forms.form import CovarianceForm
from filters.factored.form import FactoredForm
from filters.records import Sample
from filters.system import System


class Job(NamedTuple):
    """A piece of work that a method releases as a whole, so that its cost can be scheduled.

    function: plain Python loops; it reads its inputs, which it leaves as they are, and fills its outputs.
    arguments(index): a new set of arguments, with realistic values and its own memory; another index, other values.
        All sets of a job have the same types and shapes.
    """

    kind: str
    function: Callable[..., Any]
    arguments: Callable[[int], tuple[Any, ...]]


Form = TypeVar("Form", CovarianceForm, FactoredForm)
JobKind: TypeAlias = tuple[str, Callable[..., Any], Callable[[System, Form, Sample], tuple[Any, ...]]]
"""A kind of job: its name, its function, and the arguments of it at some moment."""
