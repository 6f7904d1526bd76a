"""A kernel written out again for matrices of which zeros and ones are known: straight Python, without loops.

The kernel is run on symbols, and each number that it leaves behind in its outputs is written as an expression of its
inputs. What no output needs is not there: products with zero, and of a result that is mirrored the half that is
overwritten. Sums are in the order of the kernel, so the bits are those of the kernel itself.

The functions are plain Python as all kernels are, to be read, run, counted, compiled and translated to C.
"""

from __future__ import annotations

import hashlib
import inspect
import linecache
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from filters.sparse.structure import ANY, Pattern
from filters.sparse.symbols import Symbol, Symbols
from filters.sparse.writing import Place, nodes, written_out

MOST_LINES = 4_000
"""Of a kernel that is written out: with more, compilers take minutes."""

WITHOUT = "What is always zero is left out, and so are products with one."

SymbolArray: TypeAlias = Any  # of dtype object, each item a Symbol


class Operand(NamedTuple):
    """A matrix, or with one row of characters a vector. symmetric: only what is on and below the diagonal is read."""

    pattern: Pattern | str
    symmetric: bool = False


class Traced(NamedTuple):
    """A kernel that was run on symbols.

    parameters: of the kernel. before, after: what its arrays held, by their text, as "out" or "work.HP".
    """

    kernel: Callable[..., None]
    parameters: tuple[str, ...]
    before: Mapping[str, SymbolArray]
    after: Mapping[str, SymbolArray]

    def reads(self, outputs: Sequence[str]) -> set[str]:
        """The arrays of which a number goes into these outputs."""
        return {node.of[0] for node in nodes(self._written(outputs)) if node.operation == "given"}

    def function(self, name: str, outputs: Sequence[str]) -> Callable[..., None]:
        """A function that fills these outputs, of the parameters of the kernel.

        Raises:
            ValueError: it is too long.
        """
        parts = written_out(self._written(outputs), self._homes())
        if (number := sum(map(len, parts))) > MOST_LINES:
            raise ValueError(
                f"{name} takes {number} lines without loops, and at most {MOST_LINES} are written: state more zeros "
                f"in the structure of the system, or multiply all entries, with structure=None"
            )
        head = f"({', '.join(self.parameters)}):"
        said = [
            part for part in (inspect.getdoc(self.kernel) or "").split("\n\n") if not re.search(r"\bloops?\b", part)
        ]
        doc = '"""{}\n"""'.format("\n\n".join([*said, WITHOUT])).splitlines()
        if len(parts) == 1:
            return _made({name: [f"def {name}{head}", *doc, *parts[0]]})
        texts: dict[str, list[str]] = {}
        calls = []
        for number, lines in enumerate(parts, 1):
            used = ", ".join(each for each in self.parameters if re.search(rf"\b{each}[.[]", " ".join(lines)))
            part = f"{name}_{number}"
            texts[part] = [f"def {part}({used}):", f'"""Part of {name}."""', *lines]
            calls.append(f"{part}({used})")
        return _made({**texts, name: [f"def {name}{head}", *doc, *calls]})

    def _written(self, outputs: Sequence[str]) -> list[tuple[Place, Symbol]]:
        """What is written where, in the order of the outputs."""
        return [
            ((text, *index), self.after[text][index])
            for text in outputs
            for index in np.ndindex(self.after[text].shape)
            if self.after[text][index] is not self.before[text][index]
        ]

    def _homes(self) -> dict[Symbol, Place]:
        """Of each number the scratch in which the kernel left it."""
        return {
            array[index]: (text, *index)
            for text, array in self.after.items()
            if text.startswith("work.")
            for index in np.ndindex(array.shape)
        }


def traced(kernel: Callable[..., None], arguments: Mapping[str, Any]) -> Traced:
    """Run a kernel on symbols. arguments: by parameter, in order, an `Operand` or a named tuple of such.

    Raises:
        TypeError: the kernel asks for the value of a number, or does with it what symbols have not.
    """
    symbols, arrays = Symbols(), dict[str, SymbolArray]()
    given = [_argument(symbols, name, value, arrays) for name, value in arguments.items()]
    before = {name: array.copy() for name, array in arrays.items()}
    kernel(*given)
    return Traced(kernel, tuple(arguments), before, arrays)


def _argument(symbols: Symbols, text: str, value: Any, arrays: dict[str, SymbolArray]) -> Any:
    if isinstance(value, Operand):
        arrays[text] = array = _array(symbols, text, value)
        return array
    return type(value)(*(_argument(symbols, f"{text}.{name}", item, arrays) for name, item in value._asdict().items()))


def _array(symbols: Symbols, text: str, operand: Operand) -> SymbolArray:
    rows = operand.pattern
    is_vector = isinstance(rows, str)
    shape = (len(rows),) if is_vector else (len(rows), len(rows[0]))
    array = np.empty(shape, dtype=object)
    for index in np.ndindex(shape):
        entry = rows[index[0]] if is_vector else rows[index[0]][index[1]]
        read = tuple(sorted(index, reverse=True)) if operand.symmetric else index
        array[index] = symbols.number(float(entry)) if entry != ANY else symbols.given(text, *read)
    return array


def _made(functions: Mapping[str, Sequence[str]]) -> Callable[..., None]:
    """The last of these functions, given as lines, in a file that `inspect` finds."""
    texts = ["\n    ".join(lines) for lines in functions.values()]
    text = "\n\n\n".join(texts) + "\n"
    file = f"<{[*functions][-1]}, {hashlib.sha256(text.encode()).hexdigest()[:12]}>"
    linecache.cache[file] = len(text), None, text.splitlines(keepends=True), file
    names = {"np": np, "__name__": __name__}
    exec(compile(text, file, "exec"), names)
    made: Callable[..., None] = names[[*functions][-1]]  # type: ignore[assignment]
    return made
