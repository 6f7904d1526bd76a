"""Shared objects are kept, and made again where what is kept is not to be trusted."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

import pytest

from filters.backends import c_compiler
from filters.backends.c_compiler import library
from tests.filters.translation.cases import needs_compiler

pytestmark = needs_compiler


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    library.cache_clear()
    yield tmp_path / "sched_sim" / "c"
    library.cache_clear()


def answer(number: int = 1) -> int:
    """That of a program which gives this number."""
    found: int = library(f"int answer(void) {{ return {number}; }}").answer()
    return found


def anew() -> int:
    """In another process, as it were."""
    library.cache_clear()
    return answer()


def test_it_is_compiled_once(folder: Path) -> None:
    assert answer() == 1
    with patch.object(c_compiler, "_built", side_effect=AssertionError):
        assert anew() == 1
    assert answer(2) == 2
    assert len([*folder.iterdir()]) == 2


def test_one_for_each_processor_and_compiler(folder: Path) -> None:
    answer()
    with patch.object(c_compiler, "_target", return_value="another"):
        anew()
    assert len([*folder.iterdir()]) == 2


def test_a_damaged_one_is_made_again(folder: Path) -> None:
    kept = folder / "program.so"
    folder.mkdir(parents=True)
    kept.write_bytes(b"\x7fELF")
    with patch.object(c_compiler, "_digest", return_value="program"):
        assert answer() == 1
    assert kept.stat().st_size > 4


def test_what_others_may_have_written_is_not_loaded(folder: Path) -> None:
    answer()
    (kept,) = folder.iterdir()
    kept.chmod(0o666)
    with patch.object(c_compiler, "_built", side_effect=InterruptedError), pytest.raises(InterruptedError):
        anew()


def test_it_runs_where_nothing_can_be_kept(folder: Path) -> None:
    folder.parent.parent.mkdir(exist_ok=True)
    folder.parent.write_text("a file in place of the folder")
    assert answer() == 1


def test_what_the_compiler_says_is_passed_on(folder: Path) -> None:
    with pytest.raises(ValueError, match=r"backend='c': .* cannot compile what was made of the filter: "):
        library("int answer(void) { return ; ")
    assert not folder.exists()


def test_a_machine_without_a_compiler_says_what_to_do(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.setenv("CC", "")
    c_compiler.compiler_version.cache_clear()
    c_compiler._target.cache_clear()
    with pytest.raises(ValueError, match="needs a C compiler: install gcc or clang"):
        answer()
