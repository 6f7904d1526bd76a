"""The user's own function: whatever it is and does, it is told."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from sched_sim.errors import InputError
from studies.measurement.user_function import returned_by


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("def made(:", "cannot be imported: SyntaxError"),
        ("import sys; sys.exit(3)", r"cannot be imported: it ends the program, with sys.exit\(3\)"),
        ("1 / 0", "cannot be imported: ZeroDivisionError"),
        ("import absent_library", r"cannot be imported: ModuleNotFoundError: No module .* \(own_function.py, line 1\)"),
        ("def made(): import sys; sys.exit('bye')", r"made\(\) failed: it ends the program, with sys.exit\('bye'\)"),
        ("def made(): return made()", r"made\(\) failed: RecursionError: maximum recursion depth"),
        ("def made(): raise ValueError('a\\nb')", r"made\(\) failed: ValueError: a b \(own_function.py, line 1\)$"),
        (
            "import numpy\n\ndef made():\n    return numpy.linalg.inv(numpy.zeros((2, 2)))",
            r"made\(\) failed: LinAlgError: Singular matrix \(own_function.py, line 4\)$",
        ),
        (
            "from filters import linear_system\ndef made():\n    return linear_system([[1]], 3, [[1]], [[1]], [[1]])",
            r"made\(\) failed: ValueError: .* \(own_function.py, line 3\)$",
        ),
        ("def made(x): return x", r"made\(\) failed: TypeError"),
        ("class Mute(Exception):\n    def __str__(self): 1 / 0\ndef made(): raise Mute", r"made\(\) failed: Mute"),
        ("class Own(BaseException): ...\ndef made(): raise Own", r"made\(\) failed: Own"),
        ("made = 3", r"\(own_function.py\) has no function 'made': made is a int there, and it has none; how"),
        (
            "from math import sin\ndef mode(): ...\ndef _made(): ...\nclass Other: ...",
            r"\(own_function.py\) has no function 'made': did you mean mode\? it has mode, Other; how",
        ),
    ],
)
def test_what_it_does_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: str, said: str) -> None:
    (tmp_path / "own_function.py").write_text(code)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=rf"--system 'own_function:made'.*{said}"):
        returned_by("own_function:made", "--system", "how")


def test_what_it_prints_is_no_result_and_the_folder_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    code = "import os\nprint('loading')\ndef made():\n    print('making')\n    os.chdir('..')\n    return 1"
    (tmp_path / "own_function.py").write_text(code)
    monkeypatch.chdir(tmp_path)
    assert returned_by("own_function:made", "--system", "how").value == 1
    assert capsys.readouterr() == ("", "loading\nmaking\n")
    assert Path.cwd() == tmp_path


def test_each_folder_has_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = list(sys.path)
    for value in (1, 2):
        folder = tmp_path / str(value)
        folder.mkdir()
        (folder / "own_function.py").write_text(f"def made(): return {value}")
        monkeypatch.chdir(folder)
        assert returned_by("own_function:made", "--system", "how").value == value
    assert sys.path == before


def test_a_file_with_the_name_of_a_library_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "simpy.py").write_text("def made(): return 1")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=r"simpy\.py has the name of another module that is installed"):
        returned_by("simpy:made", "--system", "how")
