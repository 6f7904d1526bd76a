"""Of several methods, those that cannot have a design: a note says of each why, and the others stay."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from sched_sim.cli.output import say
from sched_sim.errors import InputError


class Refused:
    """What was refused of `methods`. notes: by the method, why, in words."""

    def __init__(self, methods: Sequence[str]) -> None:
        self.methods = methods
        self.notes: dict[str, str] = {}
        self._errors: dict[str, str] = {}

    @contextmanager
    def noting(self, method: str, shorter: str | None = None) -> Iterator[None]:
        """Keeps the InputError of this method, which stands alone if it is the only one.

        shorter: what the note says instead, where the error names other methods to choose.
        """
        try:
            yield
        except InputError as error:
            if len(self.methods) == 1:
                raise
            self._errors[method] = str(error)
            self.notes[method] = shorter or str(error)

    def say(self) -> None:
        """The notes. Raises InputError where no method is left."""
        if len(self.notes) == len(self.methods):
            methods_of: dict[str, list[str]] = {}
            for method, error in self._errors.items():
                methods_of.setdefault(error, []).append(method)
            if len(methods_of) == 1:
                raise InputError(*methods_of)
            raise InputError("; ".join(f"{', '.join(methods)}: {error}" for error, methods in methods_of.items()))
        for method, words in self.notes.items():
            say(f"Note: no {method}: {words}")
