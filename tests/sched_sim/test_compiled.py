"""Plain functions, compiled with all that they call."""

import errno
import os
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.compiled import compiled
from sched_sim.heap import pop, push, replace

CALLER = "from callee import plus\n\n\ndef twice(value):\n    return plus(plus(value))\n"
CALLEE = "ONE = {}\n\n\ndef plus(value):\n    return value + ONE\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)  # of a source as long, and as old in seconds
    return tmp_path


def twice(folder: Path, one: int) -> int:
    """From files anew, as another process has them."""
    (folder / "caller.py").write_text(CALLER)
    (folder / "callee.py").write_text(CALLEE.format(one))
    for name in ("caller", "callee"):
        sys.modules.pop(name, None)
    answer: int = compiled(import_module("caller").twice)(40)
    return answer


def test_a_callee_in_another_file_is_part_of_it(folder: Path) -> None:
    kept = folder / "cache" / "sched_sim" / "compiled"
    assert twice(folder, 1) == 42
    (file,) = kept.rglob("*.nbc")
    as_written = file.stat()
    assert twice(folder, 1) == 42
    assert file.stat() == as_written, "it was compiled again"
    assert twice(folder, 3) == 46
    assert len(list(kept.rglob("*.nbc"))) == 2

    content = file.read_bytes()
    file.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    assert twice(folder, 1) == 42
    written_anew = file.stat()
    assert twice(folder, 1) == 42
    assert file.stat() == written_anew != as_written


def test_of_what_cannot_be_kept_nothing_is_left(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_source: object, _target: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "replace", full)
    assert twice(folder, 1) == 42
    assert [path for path in (folder / "cache").rglob("*") if path.is_file()] == []


@given(st.lists(st.tuples(st.integers(-3, 3), st.booleans()), max_size=40))
def test_a_heap_gives_the_least_rank_and_of_equals_the_first(wanted: list[tuple[int, bool]]) -> None:
    heaps = np.zeros((2, 50, 3), np.int64)
    size, held = 0, []
    for order, (rank, put) in enumerate(wanted):
        if put or not held:
            size = push(heaps, 1, size, rank, order, 7 * order)
        else:
            assert tuple(heaps[1, 0]) == min(held)
            held.remove(min(held))
            if rank:
                replace(heaps, 1, size, rank, order, 7 * order)
            else:
                size = pop(heaps, 1, size)
                continue
        held.append((rank, order, 7 * order))
    for entry in sorted(held):
        assert tuple(heaps[1, 0]) == entry
        size = pop(heaps, 1, size)
    assert size == 0
