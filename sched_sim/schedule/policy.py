"""Which of the jobs that are ready a processor runs: that with the least rank; of equals, the one released first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from operator import attrgetter
from typing import Literal, TypeAlias

from sched_sim.schedule.jobs import Job

Policy: TypeAlias = Literal["fixed", "edf"]


RANKS: Mapping[Policy, Callable[[Job], int]] = {"fixed": attrgetter("priority"), "edf": attrgetter("deadline")}
"""Fixed priorities; earliest deadline first (C. L. Liu and J. W. Layland, Scheduling algorithms for multiprogramming in
a hard-real-time environment, 1973, section 7)."""
