"""The one writer of files: whole or not at all, and nothing else touched."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from threading import Thread

import pytest

from sched_sim.cli.outputs import refuse_one_file_for_two
from sched_sim.errors import InputError
from sched_sim.files.writable import check_writable, write, writing
from tests.deaths import call_alone, killed_at_call, traceable
from tests.full_disk import room_for

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def umask_027() -> Iterator[None]:
    before = os.umask(0o027)
    yield
    os.umask(before)


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@pytest.mark.usefixtures("umask_027")
def test_permissions_are_those_of_any_new_file_or_of_the_one_that_was_there(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write(path, b"first", "--trace")
    assert (path.read_bytes(), mode(path)) == (b"first", 0o640)
    path.chmod(0o604)
    write(path, b"second", "--trace")
    assert (path.read_bytes(), mode(path)) == (b"second", 0o604)
    assert os.listdir(tmp_path) == ["a.csv"]


def test_a_name_as_long_as_names_can_be(tmp_path: Path) -> None:
    path = tmp_path / ("n" * 251 + ".csv")
    write(path, b"content", "--trace")
    assert os.listdir(tmp_path) == [path.name]
    with pytest.raises(InputError, match="cannot be written: File name too long"):
        check_writable(tmp_path / ("n" * 252 + ".csv"), "--trace")


def test_a_link_stays_and_what_it_points_to_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    for name, target in [("old.csv", tmp_path / "there" / "old.csv"), ("new.csv", Path("there/new.csv"))]:
        (tmp_path / name).symlink_to(target)
    (tmp_path / "there" / "old.csv").write_text("old")
    for name in ("old.csv", "new.csv"):
        write(tmp_path / name, b"content", "--trace")
        assert (tmp_path / name).is_symlink()
        assert (tmp_path / "there" / name).read_bytes() == b"content"
    assert sorted(os.listdir(tmp_path / "there")) == ["new.csv", "old.csv"]


@pytest.mark.parametrize("target", ["none/a.csv", "loop.csv", "folder"])
def test_a_link_that_leads_nowhere_is_refused_beforehand(tmp_path: Path, target: str) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "loop.csv").symlink_to(target)
    with pytest.raises(InputError, match=r"--trace '.*loop\.csv' cannot be written: .*give"):
        check_writable(tmp_path / "loop.csv", "--trace")


def test_a_current_folder_that_is_gone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "gone").mkdir()
    os.chdir("gone")
    (tmp_path / "gone").rmdir()
    with pytest.raises(InputError, match=r"--trace 'a\.csv' cannot be written: No such file"):
        check_writable(Path("a.csv"), "--trace")
    refuse_one_file_for_two([("--trace", Path("a.csv")), ("--trace", Path("b.csv"))])


def test_devices_and_pipes_are_written_to(tmp_path: Path) -> None:
    write(Path("/dev/null"), b"content", "--output")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    read: list[bytes] = []
    reader = Thread(target=lambda: read.append(pipe.read_bytes()))
    reader.start()
    write(pipe, b"content", "--trace")
    reader.join()
    assert read == [b"content"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_standard_output_under_another_name_is_added_to(tmp_path: Path) -> None:
    """What a shell's >> holds already, and what was printed before, stay."""
    code = "import sys; from pathlib import Path; from sched_sim.files.writable import write; print('table')\n"
    code += "write(Path('/dev/stdout'), b'file\\n', '--output'); print('end')"
    (tmp_path / "all.txt").write_text("earlier\n")
    with (tmp_path / "all.txt").open("a") as file:
        subprocess.run([sys.executable, "-c", code], stdout=file, cwd=ROOT, check=True)
    assert (tmp_path / "all.txt").read_text() == "earlier\ntable\nfile\nend\n"


@pytest.mark.parametrize("earlier", [b"earlier", None])
def test_a_full_disk_leaves_what_was_there_and_nothing_more(tmp_path: Path, earlier: bytes | None) -> None:
    path = tmp_path / "p.svg"
    if earlier is not None:
        path.write_bytes(earlier)
    with room_for(1000), pytest.raises(InputError, match=r"picture '.*p\.svg' cannot be written: .*; make room there"):
        write(path, bytes(100_000), "picture")
    assert {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)} == (
        {} if earlier is None else {"p.svg": earlier}
    )


@pytest.mark.parametrize("error", [KeyboardInterrupt("Ctrl-C"), OSError("another file's")])
def test_work_that_fails_leaves_what_was_there_and_nothing_more(tmp_path: Path, error: BaseException) -> None:
    path = tmp_path / "t.csv"
    path.write_bytes(b"earlier")

    def work() -> None:
        with writing(path, "--trace") as file:
            file.write(b"half")
            raise error

    with pytest.raises(type(error), match=str(error)):
        work()
    assert path.read_bytes() == b"earlier"
    assert os.listdir(tmp_path) == ["t.csv"]


def test_two_at_once_do_not_disturb_each_other(tmp_path: Path) -> None:
    with writing(tmp_path / "a.csv", "--trace") as a, writing(tmp_path / "b.csv", "--trace") as b:
        a.write(b"a")
        b.write(b"b")
    assert [(tmp_path / name).read_bytes() for name in sorted(os.listdir(tmp_path))] == [b"a", b"b"]


def test_only_what_a_killed_writer_left_is_removed(tmp_path: Path) -> None:
    own = [".sched-sim-notes.unfinished", "a.csv-new", ".a.csv.1-new", ".sched-sim-0123456789abcdef.unfinished.txt"]
    for name in own:
        (tmp_path / name).write_text("the user's own")
    (tmp_path / ".sched-sim-0123456789abcdef.unfinished").write_text("half")
    write(tmp_path / "a.csv", b"content", "--trace")
    assert sorted(os.listdir(tmp_path)) == sorted([*own, "a.csv"])


def die_everywhere(folder: str) -> None:
    """Kill a process that writes a file at each of its system calls, and look at what there is then."""
    path, call = Path(folder, "a.csv"), 0
    died = True
    while died:
        call += 1
        path.write_bytes(b"earlier")
        died = killed_at_call(call, lambda: write(path, b"content", "--trace"))
        assert path.read_bytes() in (b"earlier", b"content"), call
        write(Path(folder, "b.csv"), b"next", "--trace")
        assert sorted(os.listdir(folder)) == ["a.csv", "b.csv"], call
    assert path.read_bytes() == b"content"
    assert call > 10


@pytest.mark.skipif(not traceable(), reason="no process can be traced here")
def test_a_kill_at_any_system_call_leaves_the_old_file_or_the_new_and_no_stray_beyond_the_next(tmp_path: Path) -> None:
    done = call_alone("tests.sched_sim.files.test_writable", "die_everywhere", str(tmp_path))
    assert done.returncode == 0, done.stderr
