"""The project as a whole: what the wheel holds, what the locks name, what an import costs."""

import importlib.metadata
import importlib.util
import os
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import grimp
import pytest
from packaging.markers import default_environment
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name, parse_wheel_filename

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("filters", "reports", "sched_sim", "studies")
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
VERSION = PYPROJECT["project"]["version"]
UV_LOCK = {package["name"]: package for package in tomllib.loads((ROOT / "uv.lock").read_text())["package"]}
REQUIREMENTS_LOCK = (ROOT / "requirements.lock").read_text()
PINS = [
    Requirement(line.rstrip(" \\")) for line in REQUIREMENTS_LOCK.splitlines() if re.match(r"[A-Za-z0-9].*==", line)
]


def tracked_files() -> list[Path]:
    """The files in git, relative to the root; skips the test in a source archive, which has no git."""
    if not (ROOT / ".git").exists():
        pytest.skip("not a git checkout")
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    names = [Path(name) for name in listing.stdout.split("\0") if name]
    return [name for name in names if (ROOT / name).is_file()]


# -------------------- version


def test_version_is_the_same_everywhere():
    citation = re.search(r"^version: (.+)$", (ROOT / "CITATION.cff").read_text(), re.MULTILINE)
    releases = re.findall(r"^## \[(\d.*?)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert citation is not None
    assert citation[1] == VERSION
    assert releases[0] == VERSION  # the newest release stands first, below [Unreleased]
    assert importlib.metadata.version("sched-sim") == VERSION, "installed from another version: make install"


# -------------------- wheel


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, built from this tree; needs no network."""
    target = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(target)]
    subprocess.run(build, cwd=ROOT, capture_output=True, check=True)
    (path,) = target.glob("*.whl")
    return path


def test_wheel_holds_the_four_packages_with_their_data_and_nothing_else(wheel):
    with zipfile.ZipFile(wheel) as archive:
        held = set(archive.namelist())
    expected = {
        name.as_posix()
        for name in tracked_files()
        if name.parts[0] in PACKAGES and name.parts[:2] != ("reports", "published")
    }
    assert expected <= held
    assert {f"{package}/py.typed" for package in PACKAGES} <= held
    assert {name.split("/")[0] for name in held} == {*PACKAGES, f"sched_sim-{VERSION}.dist-info"}
    assert not [name for name in held if name.startswith("reports/published") or name.endswith(".pyc")]


def test_wheel_metadata(wheel):
    with zipfile.ZipFile(wheel) as archive:
        info = f"sched_sim-{VERSION}.dist-info"
        metadata = archive.read(f"{info}/METADATA").decode()
        assert b"\nsched-sim = sched_sim.cli:main\n" in archive.read(f"{info}/entry_points.txt")
        assert archive.read(f"{info}/licenses/LICENSE") == (ROOT / "LICENSE").read_bytes()
    assert f"\nVersion: {VERSION}\n" in metadata
    assert "\nRequires-Python: >=3.11\n" in metadata


def test_wheel_runs_without_the_source_tree(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}  # comes before the editable installation
    show = "import {0}; print(*(m.__file__ for m in ({0},)), sep='\\n')".format(", ".join(PACKAGES))
    run = {"cwd": tmp_path, "env": environment, "capture_output": True, "text": True, "check": True}
    files = subprocess.run([sys.executable, "-c", show], **run).stdout.split()
    assert [Path(file).parent.parent for file in files] == [tmp_path] * len(PACKAGES)
    assert "minimum" in subprocess.run([sys.executable, "-m", "sched_sim", "--help"], **run).stdout


# -------------------- locks


@pytest.mark.parametrize("lock", ["uv.lock", "requirements.lock"])
def test_lock_names_only_the_public_index(lock):
    text = (ROOT / lock).read_text()
    assert set(re.findall(r"\w+://([^/\s\"']*)", text)) <= {"pypi.org", "files.pythonhosted.org"}
    assert not re.search(r"file:|find-links|index-url|trusted-host", text)


def test_uv_lock_was_made_from_this_pyproject():
    def normal(requirements: list[str]) -> set[str]:
        return {f"{canonicalize_name((r := Requirement(text)).name)}{r.specifier}" for text in requirements}

    def locked(entries: list[dict[str, str]]) -> set[str]:
        return normal([entry["name"] + entry.get("specifier", "") for entry in entries])

    project, metadata = PYPROJECT["project"], UV_LOCK["sched-sim"]["metadata"]
    extras = project["optional-dependencies"]
    remedy = "run: make lock"
    assert locked(metadata["requires-dist"]) == normal(sum(extras.values(), project["dependencies"])), remedy
    assert set(metadata["requires-dev"]) == set(PYPROJECT["dependency-groups"]), remedy
    for group, requirements in PYPROJECT["dependency-groups"].items():
        assert locked(metadata["requires-dev"][group]) == normal(requirements), remedy


def test_both_locks_pin_the_same_set():
    def needed(names: list[str]) -> set[str]:
        """The names and all that they need."""
        found: set[str] = set()
        while names:
            found.add(name := names.pop())
            names += [d["name"] for d in UV_LOCK[name].get("dependencies", []) if d["name"] not in found]
        return found

    project = UV_LOCK["sched-sim"]
    direct = [*project["dependencies"], *project["dev-dependencies"]["dev"]]
    expected = needed([dependency["name"] for dependency in direct])
    assert {pin.name: str(pin.specifier) for pin in PINS} == {
        name: f"=={UV_LOCK[name]['version']}" for name in expected
    }


@pytest.mark.parametrize("python", [11, 12, 13])
@pytest.mark.parametrize("system", ["manylinux.*x86_64", "manylinux.*aarch64", "macosx.*(arm64|universal2)"])
def test_every_locked_package_has_a_wheel(python, system):
    """`make` installs wheels only: a source distribution would build with tools that no lock names."""
    linux = default_environment() | {"sys_platform": "linux", "python_version": f"3.{python}"}

    def fits(url: str) -> bool:
        for tag in parse_wheel_filename(url.rsplit("/", 1)[1])[3]:
            any_python = tag.interpreter in ("py3", f"py3{python}") and tag.abi == "none"
            stable = tag.abi == "abi3" and int(tag.interpreter.removeprefix("cp3")) <= python
            exact = (tag.interpreter, tag.abi) == (f"cp3{python}", f"cp3{python}")
            if (any_python or stable or exact) and re.fullmatch(f"any|{system}", tag.platform):
                return True
        return False

    missing = [
        pin.name
        for pin in PINS
        if (pin.marker is None or pin.marker.evaluate(linux))
        and not any(fits(wheel["url"]) for wheel in UV_LOCK[pin.name]["wheels"])
    ]
    assert missing == []


# -------------------- the tree


def test_no_tracked_file_holds_a_path_of_someones_machine():
    absolute = re.compile(r"(?<![\w.~:/<>{}$-])/(?:home|root|work|Users|opt)/\w|\b[A-Z]:\\Users\\")
    found = []
    for name in tracked_files():
        content = (ROOT / name).read_bytes()
        if b"\0" not in content:
            for number, line in enumerate(content.decode(errors="replace").splitlines(), start=1):
                if absolute.search(line):
                    found.append(f"{name}:{number}: {line.strip()[:120]}")
    assert found == []


def test_only_main_imports_the_command_line():
    """The one import rule that is not a contract in pyproject.toml: lint-imports fails without a cli."""
    graph = grimp.build_graph(*PACKAGES, cache_dir=None)
    cli = {name for name in graph.modules if f"{name}.".startswith("sched_sim.cli.")}
    importers = {importer for module in cli for importer in graph.find_modules_that_directly_import(module)}
    assert importers - cli <= {"sched_sim.__main__"}


def test_no_files_import_one_another_in_a_circle():
    """Not even when they run, or for types alone: what imports nothing that is left is taken away until all is."""
    graph = grimp.build_graph(*PACKAGES, cache_dir=None)
    imported = {name: set(graph.find_modules_directly_imported_by(name)) for name in graph.modules}
    while free := {name for name, others in imported.items() if not others & imported.keys()}:
        imported = {name: others for name, others in imported.items() if name not in free}
    assert sorted(imported) == []


def test_the_command_line_imports_nothing_slow():
    slow = {"matplotlib.pyplot", "numba", "pyarrow", "pydantic", "simpy"}
    code = f"import sys, sched_sim.cli; print(*sorted({slow!r} & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == [], "import it inside the command that needs it"


def test_a_least_speed_in_closed_form_needs_no_numpy():
    """One after the other in one process, so that what one of them imports would be seen after it."""
    lines = [
        "minimum -N 20 -M 4",
        "minimum -N 20 -M 4 --feedback same-step --cpus 2 --format json",
        "minimum --hr-hz 400 --measurement-hz 5 --delay-ms 110 --processor cortex-m7",
        "processors -N 20 -M 4 --hr-hz 400",
    ]
    code = "import sys; from sched_sim.cli.streams import run\n"
    for line in lines:
        code += f"sys.argv = ['sched-sim', *{line.split()!r}]; code = run(); print('= = =')\n"
        code += "print('=', code, 'numpy' in sys.modules, file=sys.stderr)\n"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    answers = run.stdout.split("= = =\n")[:-1]
    assert [bool(answer.strip()) for answer in answers] == [True] * len(lines)
    assert [said for said in run.stderr.splitlines() if said.startswith("=")] == ["= 0 False"] * len(lines)


def test_the_command_line_loads_no_plugins_of_pydantic(tmp_path):
    installed = tmp_path / "noisy-1.0.dist-info"
    installed.mkdir()
    (installed / "METADATA").write_text("Metadata-Version: 2.1\nName: noisy\nVersion: 1.0\n")
    (installed / "entry_points.txt").write_text("[pydantic]\nnoisy = noisy:plugin\n")
    (tmp_path / "noisy.py").write_text("raise SystemExit('loaded')")
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    line = [sys.executable, "-m", "sched_sim", "minimum", "-N", "20", "-M", "4"]
    run = subprocess.run(line, env=environment, capture_output=True, text=True)
    assert (run.returncode, run.stderr) == (0, "")
