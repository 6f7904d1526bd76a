"""What predict and correct cost: every kind, part and size, of models that are what they say."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from studies.measurement.job_times import Protocol, Timed
from studies.modular import costs as modular_costs
from studies.modular.costs import DT, KINDS, PARTS, STATES, jobs, move, move_jacobian, operations, see, see_jacobian


def test_every_part_is_counted_and_larger_ones_cost_more() -> None:
    found = operations()
    assert set(found) == {(kind, str(n), part) for kind in KINDS for n in STATES for part in PARTS}
    for kind in KINDS:
        for part in PARTS:
            assert all(found[kind, str(a), part] < found[kind, str(b), part] for a, b in pairwise(STATES))


def test_the_jacobians_are_those_of_the_models() -> None:
    x, u = np.linspace(1.0, 9.0, 9), np.empty(0)
    F, H = np.zeros((9, 9)), np.zeros((3, 9))
    move_jacobian(x, u, DT, F)
    see_jacobian(x, H)
    for column, step in enumerate(1e-4 * np.eye(9)):
        up, down, seen_up, seen_down = np.empty(9), np.empty(9), np.empty(3), np.empty(3)
        move(x + step, u, DT, up)
        move(x - step, u, DT, down)
        see(x + step, seen_up)
        see(x - step, seen_down)
        np.testing.assert_allclose(F[:, column], (up - down) / 2e-4, atol=1e-8)
        np.testing.assert_allclose(H[:, column], (seen_up - seen_down) / 2e-4, atol=1e-8)


def test_times_are_of_all_jobs(monkeypatch) -> None:
    asked = []

    def seconds(of, backend, protocol, _seed, _progress):
        asked.append((set(of), backend, protocol))
        return Timed({key: [1e-6] for key in of}, "")

    monkeypatch.setattr(modular_costs, "time_jobs", seconds)
    found = modular_costs.times()
    assert set(found.seconds) == set(jobs())
    ((_, backend, protocol),) = asked
    assert backend == "compiled"
    assert isinstance(protocol, Protocol)
    assert {"machine", "date", "versions", "protocol"} <= set(found.about)
