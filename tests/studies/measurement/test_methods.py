"""Measured cost tables: what they hold, for any size and for a user's own system."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from filters.systems.example import example_system
from filters.systems.navigation import vehicle
from sched_sim.costs.methods import KINDS, SYSTEM_METHODS
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.errors import InputError
from studies.measurement.methods import BackendName, measure
from studies.measurement.user_system import load_system
from tests.command_line import Run
from tests.filters.translation.cases import needs_compiler

OWN_SYSTEM = """
import numpy as np
from filters.systems.linear import linear_system

def car():
    return linear_system(Phi=[[1.0, 0.1], [0.0, 1.0]], B=[[0.005], [0.1]], H=[[1.0, 0.0]],
                         Q=0.01 * np.eye(2), R=[[1.0]])

def moving_car():
    return car(), [3.0, 7.0]

def raising():
    raise RuntimeError("boom")

def wrong_shape():
    return car()._replace(F=lambda j, x, u, p: np.eye(3))

def returning():
    return car()._replace(f=lambda j, x, u, p, out: 2.0 * x)

def of_lists():
    return car()._replace(Q=lambda j, p: [[1.0, 0.0], [0.0, 1.0]])

def not_finite():
    return car()._replace(H=lambda k, x, p: np.array([[np.nan, 0.0]]))

def started_nowhere():
    return car(), np.array([np.nan, 7.0])

def noiseless():
    return car()._replace(R=lambda k, p: np.zeros((1, 1)))

def lopsided():
    return car()._replace(Q=lambda j, p: np.array([[1.0, 0.5], [0.0, 1.0]]))

def negative():
    return car()._replace(Q=lambda j, p: np.diag([1.0, -1.0]))

def failing():
    return car()._replace(Q=lambda j, p: p[9][9])

def wrong():
    return linear_system(Phi=[[1.0, 0.1]], B=[[0.005], [0.1]], H=[[1.0, 0.0]], Q=np.eye(2), R=[[1.0]])

def moving():
    return car()._replace(h=lambda k, x, p, out: (x.__iadd__(0.1), out.fill(x[0] - 0.1)))

def free():
    return linear_system(Phi=np.eye(2), B=np.zeros((2, 0)), H=[[1.0, 0.0]], Q=0.01 * np.eye(2), R=[[1.0]])

def breaking():
    return car()._replace(F=lambda j, x, u, p: p.Phi[0] * (np.nan if j == 7 else 1.0))

def bursting():
    return car()._replace(f=lambda j, x, u, p, out: out.fill(1e200 + 1e200 * x[0] ** 2))

def imaginary():
    return car(), np.array([1.0, 2.0j])

def number():
    return 9

def inverting():
    return car()._replace(F=lambda j, x, u, p: np.linalg.inv(p.Phi[0] + np.diag(x)))
"""

PENDULUM = """
import numpy as np
from numpy import cos, sin
from filters.system import System

def f(j, x, u, p, out):
    out[0] = x[0] + 0.005 * x[1]
    out[1] = float(x[1]) + 0.005 * (u[0] - 9.81 * sin(x[0]))

def F(j, x, u, p):
    A = np.zeros((2, 2), dtype=np.float64)
    A[0, 1] = 1.0
    A[1, 0] = -9.81 * cos(x[0])
    return np.eye(2) + 0.005 * A

def system():
    return System(
        states=2, inputs=1, measurements=1, f=f, F=F, Q=lambda j, p: 1e-6 * np.eye(2),
        h=lambda k, x, p, out: out.fill(sin(x[0])), H=lambda k, x, p: np.array([[cos(x[0]), 0.0]]),
        R=lambda k, p: np.array([[1e-4]]), parameters=())
"""


@pytest.mark.parametrize(
    ("backend", "methods"),
    [
        pytest.param("compiled", ("standard",), marks=pytest.mark.exhaust),
        pytest.param("c", ("standard",), marks=needs_compiler),
        ("counted", SYSTEM_METHODS),
        ("numpy", ("standard", "dual-rate")),
    ],
)
def test_a_measured_table_has_every_entry_and_says_where_it_comes_from(
    backend: BackendName, methods: tuple[str, ...]
) -> None:
    table = measure(example_system(2, 1, 1), backend, "short", name="small", methods=methods)
    assert {method: tuple(sorted(kinds)) for method, kinds in table.costs.items()} == {
        method: tuple(sorted(KINDS[method])) for method in methods
    }
    for method in methods:
        select(table, method, Options())
    for kinds in table.costs.values():
        assert all(0 < cost.minimum <= cost.median <= cost.p95 for cost in kinds.values())
    assert table.provenance["update_form"] == "short"
    if backend != "counted":
        assert {"machine", "date", "versions", "protocol"} <= set(table.provenance)
        assert table.provenance["protocol"]["rounds"] >= 61


def test_counts_grow_with_the_cube_of_the_states() -> None:
    costs = [
        measure(example_system(n, 1, 1), "counted", name="n").entry("dual-rate", "lr_propagate").minimum
        for n in (2, 4, 8)
    ]
    assert costs == [2 * (2 * n**3 - n**2) + n**2 for n in (2, 4, 8)]  # two products and a sum


def test_a_nonlinear_system_can_be_counted_and_its_model_counts_too() -> None:
    model = measure(vehicle(), "counted", name="vehicle")
    linear = measure(example_system(6, 2, 2), "counted", name="linear")
    assert model.operations["standard"]["propagate"]["function"] == 4  # sin and cos, in f and in F
    assert model.entry("dual-rate", "lr_propagate") == linear.entry("dual-rate", "lr_propagate")


def test_progress_reaches_its_end() -> None:
    seen: list[tuple[int, int]] = []
    measure(
        example_system(1, 1, 1),
        "numpy",
        name="n",
        methods=("standard",),
        progress=lambda done, total, _what: seen.append((done, total)),
    )
    assert seen[0][0] == 0
    assert seen[-1][0] == seen[-1][1]


@pytest.fixture
def own_module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "own_system.py").write_text(OWN_SYSTEM)
    monkeypatch.chdir(tmp_path)


@pytest.mark.usefixtures("own_module")
def test_the_users_own_system_is_found_in_the_current_folder() -> None:
    system, x0 = load_system("own_system:car")
    assert (system.states, system.inputs, system.measurements) == (2, 1, 1)
    assert x0.tolist() == [0, 0]


@pytest.mark.usefixtures("own_module")
def test_the_user_may_give_a_typical_state() -> None:
    assert load_system("own_system:moving_car")[1].tolist() == [3, 7]


@pytest.mark.usefixtures("own_module")
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("own_system", "name a function"),
        ("own_system:", "name a function"),
        ("not_there:car", "'not_there' cannot be imported"),
        ("./models/own.py:car", "is a path, not the name of a module; in the folder that .* write models.own:car$"),
        ("own_system:truck", "has no function 'truck'"),
        ("own_system:number", "returned a int"),
        ("own_system:raising", r"raising\(\) failed: RuntimeError: boom \(own_system.py, line 13\)"),
        ("own_system:wrong_shape", r"F\(j, x, u, p\) has shape \(3, 3\); needed is \(2, 2\)"),
        ("own_system:returning", r"f\(j, x, u, p, out\) does not write out\[0\]; it must write all of out"),
        ("own_system:of_lists", r"Q\(j, p\) returns a list; needed is an array of numbers of shape \(2, 2\)"),
        ("own_system:not_finite", r"H\(k, x, p\) is not finite.*return \(system, x0\)"),
        ("own_system:started_nowhere", r"the typical state is not finite; return \(system, x0\) with numbers that are"),
        ("own_system:noiseless", r"R\(k, p\) is not positive definite: its smallest eigenvalue is 0; give each"),
        ("own_system:lopsided", r"Q\(j, p\) is not symmetric, so it is no covariance"),
        ("own_system:negative", r"Q\(j, p\) is no covariance: its smallest eigenvalue is -1"),
        ("own_system:failing", r"Q\(j, p\) failed: IndexError: .* \(own_system.py, line \d+\)"),
        ("own_system:moving", r"h\(k, x, p, out\) changes x, which is not its own"),
        ("own_system:imaginary", "the typical state is no array of numbers: it is complex"),
        ("own_system:wrong", r"wrong\(\) failed: ValueError: linear_system: Phi"),
    ],
)
def test_what_is_wrong_with_a_users_system_is_named(name: str, said: str) -> None:
    with pytest.raises(InputError, match=said) as error:
        load_system(name)
    assert f"--system {name!r}" in str(error.value)


def test_a_users_system_without_measurement_noise_ends_with_code_2(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "own_system.py").write_text(OWN_SYSTEM)
    result = sched_sim("measure --system own_system:noiseless --backend counted")
    assert result.code == 2
    assert "R(k, p) is not positive definite" in " ".join(result.err.split())


def test_a_system_without_inputs_is_measured(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "own_free.py").write_text(OWN_SYSTEM, encoding="utf-8")
    for line in ("--system own_free:free", "--states 2 --inputs 0 --measurements 1"):
        result = sched_sim(f"measure {line} --backend counted --format json")
        assert result.code == 0, result.err
        costs = {(row["method"], row["job"]): row["minimum"] for row in json.loads(result.out)}
        assert costs["dual-rate", "hr_restart"] == 6  # two rows of two products and one sum


@pytest.mark.parametrize(
    ("function", "message"),
    [
        ("breaking", "step 7: F of the system gives a value that is not finite"),
        ("bursting", "step 1: f of the system gives a value that is not finite at the simulated state"),
    ],
)
def test_a_system_that_breaks_down_later_ends_with_code_2(
    sched_sim: Run, tmp_path: Path, function: str, message: str
) -> None:
    (tmp_path / "own_broken.py").write_text(OWN_SYSTEM, encoding="utf-8")
    result = sched_sim(f"measure --system own_broken:{function} --backend counted")
    assert result.code == 2
    assert message in result.err.replace("\n", " ")


def test_functions_of_math_are_counted_as_those_of_numpy(sched_sim: Run, tmp_path: Path) -> None:
    printed = {}
    for library in ("numpy", "math"):
        name = f"pendulum_of_{library}"
        (tmp_path / f"{name}.py").write_text(PENDULUM.replace("from numpy", f"from {library}"), encoding="utf-8")
        result = sched_sim(f"measure --system {name}:system --backend counted --method larsen -o {library}.toml")
        assert result.code == 0, result.err
        text = (tmp_path / f"{library}.toml").read_text(encoding="utf-8")
        printed[library] = text.replace(name, "pendulum")
    assert printed["math"] == printed["numpy"]
    assert "propagate = { multiply = 21, add = 16, function = 2 }" in printed["math"]


def test_a_model_that_cannot_be_counted_is_named_with_its_line(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "own_inverse.py").write_text(OWN_SYSTEM, encoding="utf-8")
    result = sched_sim("measure --system own_inverse:inverting --backend counted")
    assert result.code == 2
    message = " ".join(result.err.split())
    line = 1 + OWN_SYSTEM[: OWN_SYSTEM.index("np.linalg.inv")].count("\n")
    assert (
        f"in own_inverse.py, line {line}: np.linalg.inv(p.Phi[0] + np.diag(x)) cannot be counted: it does not"
        in message
    )
    assert message.endswith("or time it with another --backend")


def test_without_a_c_compiler_the_remedy_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shutil.which", lambda _name: None)
    monkeypatch.delenv("CC", raising=False)
    with pytest.raises(InputError, match=r"^backend c needs a C compiler: install gcc or clang, .*backend compiled$"):
        measure(example_system(2, 1, 1), "c", methods=["standard"], name="absent")
