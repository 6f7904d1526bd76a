"""What is written compiles under the strictest warnings, gives Python's bits, and is the same each time."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from filters.registry import MULTIRATE_METHODS
from filters.systems.example import example_system
from filters.systems.navigation import vehicle
from filters.translation.library import Precision
from studies.board.compiled import compiled
from studies.board.steps import Steps
from studies.measurement.sparsity import with_structure
from studies.measurement.user_function import Returned
from studies.measurement.user_system import checked_system
from tests.command_line import Run
from tests.studies.board.build import ARM, HERE, STRICT, build, needs_arm_gcc, needs_gcc, put, ran, ran_as_one, written
from tests.studies.board.systems import beyond_floats, pendulum, unchanging, writing_to_its_parameters
from tests.studies.board.test_serial import STEPS as WHOLE_RUNS

STEPS = Steps(10, 4, 8)
DRIVING = np.array([0.0, 0.0, 0.5, 15.0, 0.0, 0.0])
MODELS = {
    "linear": (example_system(5, 2, 3), np.zeros(5)),
    "no-inputs": (example_system(3, 0, 2), np.zeros(3)),
    "vehicle": (vehicle(), DRIVING),
    "scratch": (pendulum(), np.array([0.1, 0.0])),
}
SOURCES = ("filter.c", "tasks.c")


FEW = [("linear", "double"), ("scratch", "double"), ("vehicle", "single"), ("no-inputs", "single")]


@needs_gcc
@pytest.mark.parametrize(
    ("name", "precision"),
    [
        pytest.param(name, precision, marks=() if (name, precision) in FEW else pytest.mark.exhaust)
        for name in MODELS
        for precision in ("single", "double")
    ],
)
def test_jobs_and_tasks_give_the_numbers_of_python(name: str, precision: Precision, tmp_path: Path) -> None:
    system, x0 = MODELS[name]
    put(tmp_path, written(system, x0=x0, precision=precision, steps=STEPS))
    exact = precision == "double"
    build(tmp_path, "-O2", *(["-DTOLERANCE=0"] if exact else []), *SOURCES, "test.c", "-lm", "-o", "test")
    status, said = ran(tmp_path, "test")
    assert status == 0, said
    assert said.count("the same bits") == 6 if exact else said.count("the same bits") >= 3


@needs_gcc
def test_jobs_alone(tmp_path: Path) -> None:
    """Of a method that would need a model over several steps."""
    files = written(example_system(3, 1, 2), method="multirate-ud", precision="single")
    put(tmp_path, files)
    status, said = ran_as_one(tmp_path, "filter.c", "test.c")
    assert status == 0, said
    put(tmp_path, {"state.c": '#include "state.h"\n'})
    build(tmp_path, "-Wno-unused-variable", "-Wno-unused-const-variable", "-c", "state.c")
    assert "What is missing" in files["README.md"]


@needs_gcc
def test_two_threads_land_every_correction(tmp_path: Path) -> None:
    put(tmp_path, written(*MODELS["linear"][:1], steps=STEPS))
    build(tmp_path, "-O2", "-DPERIOD_US=20000", *SOURCES, "posix.c", "-lm", "-lpthread", "-o", "threads")
    tries = [ran(tmp_path, "threads") for _ in range(3)]  # on a busy machine LR may be kept from its processor
    landed = [said.startswith("3 of 3 corrections have landed; from Python's states off by 0, ") for _, said in tries]
    assert any(landed)
    assert all(status == 0 for (status, _), exact in zip(tries, landed, strict=True) if exact)


@needs_gcc
def test_two_threads_that_give_other_states_fail(tmp_path: Path) -> None:
    files = written(*MODELS["linear"][:1], steps=STEPS)
    moved = files["posix.c"].replace("    tasks_start(", "    record_x0[0] += 9.0;\n    tasks_start(")
    put(tmp_path, {**files, "posix.c": moved})
    build(tmp_path, "-O2", "-DPERIOD_US=100", *SOURCES, "posix.c", "-lm", "-lpthread", "-o", "threads")
    status, said = ran(tmp_path, "threads")
    assert status == 1, said


@needs_gcc
def test_a_counter_that_does_not_run_gives_no_costs(tmp_path: Path) -> None:
    put(tmp_path, written(*MODELS["linear"][:1], steps=STEPS))
    status, said = ran_as_one(tmp_path, *SOURCES, "test.c", options=["-DCYCLES=7", "-DCLOCK_HZ=1e6"])
    assert status == 1
    assert "# no costs: the counter that CYCLES reads does not run" in said
    assert "[costs" not in said


def test_lines_are_indented_as_their_blocks_are() -> None:
    for name, text in written(*MODELS["linear"][:1], steps=STEPS).items():
        if name in ("posix.c", "freertos.c"):
            depth = 0
            for line in text.partition("*/")[2].splitlines():
                depth -= line.lstrip().startswith("}")
                if re.match(r" *(arrives|const|\(void\)|for|if|while|return)\b", line):
                    assert len(line) - len(line.lstrip()) == 4 * depth, line
                depth += line.endswith("{") + line.startswith("{") - (line == "{")


@needs_gcc
@pytest.mark.parametrize(
    ("method", "steps"),
    [("dual-rate", STEPS)]
    + [
        pytest.param(method, steps, marks=pytest.mark.exhaust)
        for method, several in WHOLE_RUNS.items()
        for steps in several
    ],
)
def test_times_of_jobs_are_the_cost_table_that_the_readme_asks(
    method: str, steps: Steps, tmp_path: Path, sched_sim: Run
) -> None:
    system = unchanging() if method in MULTIRATE_METHODS else pendulum()
    files = written(system, method=method, steps=steps)
    put(tmp_path, files)
    sources = [name for name in ("filter.c", "tasks.c", "steps.c", "test.c") if name in files]
    clock = ["-DCYCLES=clock()", "-DCLOCK_HZ=CLOCKS_PER_SEC", "-include", "time.h"]
    said = ran_as_one(tmp_path, *sources, options=clock)[1]
    (tmp_path / "board.toml").write_text(re.sub(r"= 0\.0000\b", "= 0.0001", said))
    (command,) = re.findall(r"^sched-sim (minimum .*)$", files["README.md"], re.MULTILINE)
    result = sched_sim(command)
    assert result.code == 0, result.err
    assert "board" in result.out


@needs_gcc
@pytest.mark.parametrize("name", ["linear", "no-inputs"])
def test_the_example_for_freertos_compiles(name: str, tmp_path: Path) -> None:
    put(tmp_path, written(MODELS[name][0], steps=STEPS))
    build(tmp_path, "-I", str(HERE / "stubs"), "-c", "freertos.c")


@needs_arm_gcc
@pytest.mark.parametrize("precision", ["single", pytest.param("double", marks=pytest.mark.exhaust)])
def test_for_a_cortex_m(precision: Precision, tmp_path: Path) -> None:
    files = written(MODELS["vehicle"][0], x0=DRIVING, precision=precision, steps=STEPS, for_a_core=True)
    put(tmp_path, files)
    build(tmp_path, "-O2", "-DCORTEX_M", "-DCLOCK_HZ=168e6", "-c", *SOURCES, "test.c", compiler=ARM)
    found = compiled(files, SOURCES, precision)
    assert found is not None
    assert 1000 < found.code["filter.c"] < 10_000
    assert 0 < max(found.frames.values()) < 1000
    stacks = {
        name: int(size) for name, size in re.findall(r"stack of (?:the job )?(\w+).* \| (\d+) \|", files["README.md"])
    }
    assert stacks["hr_step"] > stacks["hr_propagate"]
    assert stacks["lr_measure"] > stacks["lr_update"]
    words = re.findall(r"STACK_WORDS (\d+)", files["freertos.c"])
    assert 4 * int(words[0]) >= 1024 + max(stacks.values())


def test_without_a_cross_compiler_the_rest_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda _: None)
    said = written(MODELS["linear"][0], steps=STEPS, for_a_core=True)["README.md"]
    assert "code and stack are not known" in said
    assert "| RAM of LR: arrays of state.h |" in said


def test_the_same_files_each_time() -> None:
    assert written(pendulum(), steps=STEPS, for_a_core=True) == written(pendulum(), steps=STEPS, for_a_core=True)


@pytest.mark.parametrize("name", MODELS)
def test_no_memory_but_in_state_h_and_no_path_of_a_machine(name: str) -> None:
    system, x0 = MODELS[name]
    files = written(system, x0=x0, steps=STEPS)
    for line in files["filter.c"].splitlines():
        assert not line.startswith("static real ") or "(" in line
    for text in files.values():
        assert str(Path.cwd()) not in text
        assert "malloc(" not in text


def test_what_a_model_writes_to_is_not_constant() -> None:
    with pytest.raises(ValueError, match="changes p, which is not its own"):
        written(writing_to_its_parameters(), x0=np.array([0.3, 0.0]), steps=STEPS)


def test_a_model_beyond_single_precision() -> None:
    with pytest.raises(ValueError, match="R: single precision has no 1e-60; choose double"):
        written(beyond_floats(), precision="single", steps=STEPS)


def test_warnings_are_errors() -> None:
    assert {"-Wconversion", "-Wpedantic", "-Werror"} <= set(STRICT)


@pytest.mark.parametrize("steps", [STEPS, None], ids=["tasks", "jobs"])
def test_the_scratch_of_a_model_begins_as_the_user_gave_it(steps: Steps | None) -> None:
    system = pendulum()
    files = written(system, x0=np.array([0.1, 0.2]), method="dual-rate" if steps else "standard", steps=steps)
    assert re.search(r"\w+_scratch_F\[2\]\[2\]\[2\];", files["state.h"])
    assert not re.search(r"scratch\w*(\[\d\])+ =", files["state.h"])
    assert not system.parameters.scratch.F.any()


def test_nor_is_it_left_otherwise_by_what_tries_the_model() -> None:
    system = pendulum()
    checked_system(Returned("pendulum", (system, [0.1, 0.2])), "--system 'a:pendulum'", "how")
    with_structure(system, np.array([0.1, 0.2]), "--system 'a:pendulum'", confirmed=True)
    assert not system.parameters.scratch.F.any()
