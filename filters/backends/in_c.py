"""Run kernels and jobs as C: translated, compiled by the C compiler of the machine, and loaded.

A model of the user's is ready in a second, where numba takes ten. The numbers are those of the other backends to the
last bit, for the compiler may neither reorder nor fuse operations.

A function is compiled for each new kind of arguments; for those that overlap in memory apart from those that do not,
for C is told where arrays do not overlap, and is then a third faster.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache, cached_property
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np

from filters.backends.c_arguments import (
    Argument,
    argument,
    dtype_of,
    overlapping,
    result_of,
    share_memory,
    type_of,
    types_passed,
)
from filters.backends.c_compiler import library
from filters.translation.kinds import Kind, kind_of
from filters.translation.origins import Path
from filters.translation.prototype import declared, given_up, is_void, passed, prototype
from filters.translation.translated import Translated
from filters.translation.unit import Unit

_FAULT = """#include <setjmp.h>
static __thread const char *fault;
static __thread jmp_buf on_fault;
#define FAULT(message) (fault = (message), longjmp(on_fault, 1))
"""
_ENTRIES = """
{prototype}
{{
    if (setjmp(on_fault)) {{
        {given_up}
    }}
    {call};
}}

void repeat_job({declared})
{{
    if (setjmp(on_fault)) {{
        return;
    }}
    for (int round = 0; round < times; round++) {{
        {name}({passed});
        __asm__ volatile("" ::: "memory");
    }}
}}

const char *take_fault(void)
{{
    const char *const found = fault;
    fault = 0;
    return found;
}}
"""


def in_c(function: FunctionType) -> InC:
    """The version of a plain function that runs as C, translated and compiled for each new kind of arguments."""
    return InC(function)


class InC:
    def __init__(self, function: FunctionType) -> None:
        self._function = function
        self._names = function.__code__.co_varnames[: function.__code__.co_argcount]
        self._loaded: dict[tuple[int, ...], _Loaded] = {}
        self.__name__ = function.__name__

    def __call__(self, *arguments: Any) -> Any:
        given = [argument(each) for each in arguments]
        return self._for(given)(given)

    def loop(self, *arguments: Any) -> Callable[[int], None]:
        """A function that runs it so many times in one call."""
        given = [argument(each) for each in arguments]
        return self._for(given).loop(given)

    def _for(self, given: Sequence[Argument]) -> _Loaded:
        key = tuple([each.number for each in given])
        loaded = self._loaded.get(key)
        if loaded is None:
            kinds = tuple(kind_of(each.value) for each in given)
            loaded = self._loaded[key] = _loaded(self._function, kinds, apart=True)
        if share_memory(given):
            pairs = overlapping(self._names, [each.value for each in given])
            if any(pair & loaded.writes for pair in pairs):
                return _loaded(self._function, loaded.kinds, apart=False)
        return loaded


@cache
def _loaded(function: FunctionType, kinds: tuple[Kind, ...], *, apart: bool) -> _Loaded:
    """apart: whether what is written among arguments overlaps with nothing else."""
    return _Loaded(function, kinds, Unit(public=frozenset({function}), overlapping=frozenset() if apart else None))


class _Loaded:
    """A translated function; compiled when it is first called."""

    def __init__(self, function: FunctionType, kinds: tuple[Kind, ...], unit: Unit) -> None:
        self.kinds = kinds
        self._unit, self._translated = unit, unit.function(function, kinds)
        self._used = [self._translated.parameters.index(name) for name in self._translated.used]

    @property
    def writes(self) -> frozenset[Path]:
        """The arrays among its arguments that it writes to."""
        return self._translated.effects.writes

    def __call__(self, given: Sequence[Argument]) -> Any:
        memory = self._memory()
        result = self._program.run(*self._passed([*given, *memory]))
        self._program.check()
        return result_of(result, self._translated.result, [*given, *memory])

    def loop(self, given: Sequence[Argument]) -> Callable[[int], None]:
        memory = self._memory()
        passed = self._passed([*given, *memory])

        def loop(times: int, _kept: Any = (given, memory)) -> None:
            self._program.loop(*passed, times)
            self._program.check()

        return loop

    @cached_property
    def _program(self) -> _Program:
        unit, each = self._unit, self._translated
        source = _FAULT + unit.header("FILTER_H") + unit.source("").partition("\n")[2] + _entries(unit, each)
        program = library(source)
        kinds = [each.kinds[index] for index in self._used] + list(each.memory.values())
        may_fail = any(function.may_fail for function in unit.functions().values())
        run = program.run_job if may_fail else getattr(program, each.name)
        often, take_fault = program.repeat_job, program.take_fault
        run.argtypes = [part for kind in kinds for part in types_passed(kind)]
        run.restype, often.restype, take_fault.restype = type_of(each.result), None, ctypes.c_char_p
        often.argtypes = [*run.argtypes, ctypes.c_int]
        return _Program(run, often, take_fault if may_fail else None)

    def _memory(self) -> list[Argument]:
        """Arrays that it needs as long as it runs, or returns."""
        kinds = self._translated.memory.values()
        return [argument(np.empty([length or 0 for length in kind.shape], dtype_of(kind))) for kind in kinds]

    def _passed(self, given: Sequence[Argument]) -> list[Any]:
        own = range(len(self._translated.parameters), len(given))
        return [part for index in (*self._used, *own) for part in given[index].passed]


class _Program(NamedTuple):
    """run: the function. loop: runs it so many times. take_fault: what it could not do; None of one that always can."""

    run: Callable[..., Any]
    loop: Callable[..., None]
    take_fault: Callable[[], bytes | None] | None

    def check(self) -> None:
        """Raises ValueError for what it could not do."""
        if self.take_fault and (message := self.take_fault()) is not None:
            raise ValueError(message.decode())


def _entries(unit: Unit, each: Translated) -> str:
    """What is called from Python: the function, and the loop."""
    head, arguments = declared(each, unit.record_name), ", ".join(passed(each))
    call = f"{each.name}({arguments})"
    return _ENTRIES.format(
        prototype=prototype(replace(each, name="run_job", is_public=True), unit.record_name),
        given_up=given_up(each.result, unit.record_name),
        call=call if is_void(each.result) else f"return {call}",
        declared=", ".join([*head, "int times"]),
        name=each.name,
        passed=arguments,
    )
