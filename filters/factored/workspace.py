"""Scratch memory of the factored forms."""

from __future__ import annotations

from typing import NamedTuple

from filters.records import Workspace, new_workspace
from filters.systems.system import System


class FactoredWorkspace(NamedTuple):
    """Scratch arrays, allocated once for a filter. What one call leaves in them means nothing to the next."""

    dense: Workspace


def new_factored_workspace(system: System) -> FactoredWorkspace:
    """Scratch memory for the functions of any factored form."""
    return FactoredWorkspace(dense=new_workspace(system))
