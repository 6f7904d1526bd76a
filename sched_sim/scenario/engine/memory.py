"""What stands where in the memory of a simulation: all of it, plan and state, is one row of whole numbers, so that a
copy of it is a simulation that goes on from there.

A thing is known by its address, the index of its first number, and a field of it by how far behind that stands:
`memory[job + WORK]`. 0 is no thing. The first numbers of the memory are known by name, `memory[NOW]`.
"""

from __future__ import annotations

from typing import Any, TypeAlias

Memory: TypeAlias = Any
"""An array of whole numbers of 64 bits, or a list where the rules are run without being compiled."""

# ------------------------------------------------------------------------------- the first numbers
(
    # the plan, which stays: times in ticks; RULE: see below; ROOM: for so many more jobs there must be, at any instant
    PERIOD, HORIZON, SWITCH, RULE, ROOM, CPUS, CPUS_END, TASKS, TASKS_END, HR_LANE, HR_STREAM,
    SENSORS, MEASUREMENTS, FIRST_JOB, PREEMPTED_JOBS,  # first rows; how often jobs were preempted, by kind
    # parts of the high-rate task, and of the covariance between the steps of the low-rate one
    PREDICT, PREDICT_ACCUMULATE, HR_RESTART, HR_UPDATE, LR_PROPAGATE,
    # the state: the instant, and the next at which a job finishes, or a task is released; the next step
    NOW, NEXT_FINISH, NEXT_TASK, INSTANTS, STEP,
    # the next measurement to be taken, to arrive, and to be known as lost; behind the last landing; jobs so far
    TAKEN, ARRIVED, LOST, LANDED, JOBS, FREE, FREE_JOBS, LOGGED,
    # of Larsen's method, the one that is waited for, if any
    AWAITED, AWAITED_STEP, AWAITED_ARRIVES,
    # of the dual-rate filter: see `dual_rate`
    RESTARTS, BUSY, QUEUE, QUEUE_TAIL,
    # of `nearness`: the kind that is watched, how near it is, how often it was, and the bounds within which to go on
    WATCHED, WATCHED_STEP, NEAR, HISTOGRAM, NEAREST, FARTHEST,
    # rings, two numbers each: measurements that have arrived and not landed; those of them that are carried
    PENDING, PENDING_NEXT, CARRIED, CARRIED_NEXT,
    # late ones in flight whose covariance was corrected, and how many; what has been applied to the state
    FLYING, FLYING_NEXT, FLYING_COUNT, APPLIED, APPLIED_NEXT, APPLIED_AT,
    HEADER,
) = range(1, 58)  # fmt: skip

BACK, ONE, SEVERAL, DUAL_RATE = range(4)
"""RULE: late measurements go back; one is in flight by Larsen's method; several are; all are the low-rate task's."""

# ------------------------------------------------------------------------------- queues, rings
HEAD, TAIL = range(2)
"""Of a queue of things that are linked by their NEXT."""
NEXT = 0
PREVIOUS, FOLLOWING, AT, ABOUT = range(4)
"""Of a place in a ring; and of what has been applied, in the state of which step, and the measurement."""

# ------------------------------------------------------------------------------- processors, tasks, sensors
# before LANES_END a queue for each priority, most urgent first; before BEST they are empty; LAST_RUN: a job's NUMBER
RUNNING, SINCE, FINISH, TICKS_BUSY, LAST_RUN, LANES_END, BEST, CPU = range(8)

(
    TASK_RELEASE, TASK_NOMINAL, TASK_PERIOD, TASK_DUE, TASK_COST, TASK_LANE, TASK_CPU, TASK_PREEMPTIVE, TASK_KIND,
    TASK_COUNT, TASK,
) = range(11)  # fmt: skip

(
    SENSOR_KIND, LANE, SENSOR_CPU, DUE, DELAYED, PREEMPTED, STREAM,
    # of its priority: whether a correction is under way, and the queue of measurements that wait for it
    WAITING,
    # parts: of a correction, and where another is in flight; of one that is carried, in a step and at its landing
    CORRECT, CORRECT_ACCUMULATE, CARRY, BESIDE, LAND,
    # parts of the dual-rate filter
    GAIN, HR_PASS, GAIN_AGAIN, GAIN_KEPT, GAIN_KIND, LOSS_KIND,
    SENSOR,
) = range(20)  # fmt: skip
UNDER_WAY, WAITING_QUEUE = range(2)

# ------------------------------------------------------------------------------- measurements, in the order of taking
(
    MEASUREMENT_NEXT, TAKEN_AT, OF, ARRIVES, ORDER, LEADER,
    IN_PENDING, _, IN_CARRIED, _, IN_FLYING, _,  # rings
    TO_COVARIANCE, _, _, _, TO_STATE, _, _, _,  # places in the ring of what has been applied
    QUEUED, CORRECTED, IN_STATE, WAITS,
    MEASUREMENT,
) = range(25)  # fmt: skip
"""TAKEN_AT, ARRIVES: steps; NEVER: it is lost. OF: its sensor. ORDER: its place among ARRIVED. LEADER: the first of
those that go together. Of the dual-rate filter: its gain job is in the queue; its correct job has finished; it is in
the state, or known to be lost; the job that waits for its gain job, if any."""
NEVER, NO_STEP = -1, -2
"""Instead of a step: of a measurement that does not arrive, and of the row behind the last."""

# ------------------------------------------------------------------------------- jobs
(
    JOB_NEXT, NUMBER, KIND, JOB_STEP, RELEASE, DEADLINE, JOB_LANE, JOB_CPU, PREEMPTIVE, REMAINING, OVERHEAD, THEN,
    # what it is about: the first measurement, and behind the last
    FIRST, BEHIND,
    # of a correction that may have to catch up: the step it aims at; LANDED and ARRIVED when its work was settled
    AIM, SEEN, BEFORE,
    JOB,
) = range(18)  # fmt: skip
NO_KIND = -1
"""Of a row where no job is."""
NOTHING, LANDS, CATCHES_UP, FREES_GAINS, ENDS_GAIN, ENDS_CORRECTION, ENDS_LOSS = range(7)
"""THEN: what follows when it has done its work."""

LOG_KIND, LOG_STEP, LOG_RELEASE, LOG_DEADLINE, LOG_END, LOG = range(6)
"""Of a job that has finished, a row of the log."""
