"""How much of a job is spent in the functions of a user's system, and which of them ask for memory."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.backends.allocations import allocations
from sched_sim.cli.own_note import MEANING, own_note, own_share
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import costs_text, read_costs
from studies.measurement.methods import measure
from studies.measurement.user_system import load_system
from tests.command_line import Run

HOW_TO = Path(__file__).parents[3] / "docs" / "howto" / "own-model.md"
MAKING = """
import numpy as np
from pendulum import DT, GRAVITY, system as filling

def F(j, x, u, p):
    return np.array([[1.0, DT], [-DT * GRAVITY * np.cos(x[0]), 1.0]])

def H(k, x, p):
    return np.array([[np.cos(x[0]), 0.0]])

def Q(j, p):
    return np.diag(np.array([1e-8, 1e-5]))

def R(k, p):
    return np.array([[1e-4]])

def system():
    return filling()._replace(F=F, H=H, Q=Q, R=R, parameters=())
"""


def filled(x: FloatArray, out: FloatArray) -> None:
    for i in range(len(x)):
        out[i] = 2.0 * x[i]


def made(x: FloatArray, out: FloatArray) -> None:
    out[:] = 2.0 * x
    out[:] = np.ones(len(x)) + out


def test_new_arrays_are_counted_those_that_are_dropped_again_too() -> None:
    arguments = np.ones(3), np.ones(3)
    assert allocations(filled, arguments) == 0
    assert allocations(made, arguments) >= 1
    assert allocations(filled, arguments) == 0


@pytest.fixture
def pendulum(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """That of the how-to, and one that makes its matrices anew."""
    found = re.search(r"```python\n(# pendulum\.py.*?)```", HOW_TO.read_text(encoding="utf-8"), re.DOTALL)
    assert found is not None
    (tmp_path / "pendulum.py").write_text(found[1], encoding="utf-8")
    (tmp_path / "making.py").write_text(MAKING, encoding="utf-8")
    monkeypatch.chdir(tmp_path)


def measured(name: str) -> CostTable:
    system, x0 = load_system(name)
    return measure(system, name="p", x0=x0, methods=["standard"], own=True)


@pytest.mark.exhaust
@pytest.mark.usefixtures("pendulum")
def test_a_model_that_makes_new_arrays_takes_most_of_the_time_and_one_that_does_not_does_not() -> None:
    """By wide margins: 5 times, and 86 of 100, were measured."""
    filling, making = measured("pendulum:system"), measured("making:system")
    cost = {
        name: sum(each.minimum for each in table.costs["standard"].values())
        for name, table in (("filling", filling), ("making", making))
    }
    assert cost["making"] > 2 * cost["filling"]
    assert list(making.costs) == ["standard"]
    shares = [table.provenance["own_share"]["standard"] for table in (filling, making)]
    for kind in ("propagate", "update"):
        assert 0 <= shares[0][kind] < shares[1][kind] <= 1
        assert shares[1][kind] > 0.5
    about = making.provenance["own_functions"]
    assert {name for name in about if about[name]["allocations"]} == {"F", "Q", "H", "R"}
    assert not any(one["allocations"] for one in filling.provenance["own_functions"].values())
    assert own_note(making).startswith(f"{MEANING}\nF (")
    assert "R (" in own_note(making)
    assert own_note(filling) == MEANING


@pytest.mark.exhaust
@pytest.mark.usefixtures("pendulum")
def test_the_command_says_it_and_writes_it(sched_sim: Run, tmp_path: Path) -> None:
    line = "measure --system pendulum:system --method standard"
    rows = json.loads(sched_sim(f"{line} --format json -o costs.toml").out)
    table = read_costs(tmp_path / "costs.toml")
    assert {row["job"]: row["own_share"] for row in rows} == {
        kind: float(share) for kind, share in table.provenance["own_share"]["standard"].items()
    }
    assert costs_text(table) == (tmp_path / "costs.toml").read_text(encoding="utf-8")
    assert set(table.provenance["own_functions"]) == {"f", "F", "Q", "h", "H", "R"}
    out = sched_sim(line).out
    assert "own, %" in out
    assert MEANING in out


def table(share: float, allocations: int) -> CostTable:
    one = {"seconds": 5e-9, "allocations": allocations}
    about = {"own_share": {"standard": {"update": share}}, "own_functions": {"f": one, "F": one}}
    return CostTable("t", "second", {"standard": {}}, about)


def test_functions_are_named_where_they_make_arrays_and_take_a_large_share() -> None:
    named = "F (5 ns alone): a new array in each call"
    assert named in own_note(table(0.25, 1))
    assert own_note(table(0.24, 1)) == own_note(table(0.9, 0)) == MEANING
    assert own_share(table(0.3, 0), "standard", "update") == {"own_share": 0.3}


def test_nothing_is_said_of_systems_that_are_not_the_users(sched_sim: Run) -> None:
    out = sched_sim("measure --states 2 --inputs 1 --measurements 1 --backend counted --method standard").out
    assert "own, %" not in out
    assert own_note(CostTable("t", "second", {})) == ""
    assert own_share(CostTable("t", "second", {}), "standard", "update") == {}
