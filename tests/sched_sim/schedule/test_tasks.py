"""The user's tasks: what is left out follows what is given."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from sched_sim.schedule.tasks import Task


def test_a_deadline_that_is_not_given_follows_the_period() -> None:
    task = Task("control", Fraction(4), Fraction(1), 5)
    assert (task.deadline, task.due) == (None, 4)
    assert replace(task, period=Fraction(6)).due == 6
    assert replace(task, period=Fraction(2)).due == 2
    own = replace(task, deadline=Fraction(3))
    assert (own.deadline, own.due, replace(own, period=Fraction(6)).due) == (3, 3, 3)
