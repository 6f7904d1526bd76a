"""A function in C."""

from __future__ import annotations

from dataclasses import dataclass
from types import FunctionType

from filters.translation.kinds import NOTHING, Array, Kind, Record, lasts
from filters.translation.origins import Origins
from filters.translation.overlaps import Effects


@dataclass(frozen=True)
class Translated:
    """function: in Python. parameters: as there. used: those that are left in C. memory: arrays that the caller gives
    behind them.

    inside: its lines. effects: what it does with arrays. result_origins: of what it returns.
    """

    name: str
    function: FunctionType
    parameters: tuple[str, ...]
    kinds: tuple[Kind, ...]
    used: tuple[str, ...]
    memory: dict[str, Array]
    result: Kind
    is_public: bool
    inside: str
    effects: Effects
    result_origins: Origins

    @property
    def calls(self) -> tuple[str, ...]:
        """The functions that it calls itself."""
        return tuple(dict.fromkeys(site.name for site in self.effects.sites))

    @property
    def may_fail(self) -> bool:
        """Whether it may find that it cannot go on, itself."""
        return "FAULT(" in self.inside or "whole_of(" in self.inside

    @property
    def is_known(self) -> bool:
        """Whether what it returns is known while translating, and it can do nothing else."""
        if self.result == NOTHING or lasts(self.result) or self.calls or self.may_fail:
            return False
        kinds = dict(zip(self.parameters, self.kinds, strict=True))
        return not any(isinstance(kinds[name], Array | Record) for name in self.used)
