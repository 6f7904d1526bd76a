"""What the jobs of a filter lead to, to be compiled: what a step releases, and what follows when a job has finished.

Written from the timeline, beside the sources of the SimPy engine (`Method.source`), so that each is the other's oracle.
Methods differ by the numbers of a `Plan` alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sched_sim.design.engine.codes import (
    FED_BACK,
    FREES,
    HR_JOB,
    HR_UPDATE,
    LANDS,
    LOW_DONE,
    LR_GAIN,
    LR_PROPAGATE,
    LR_UPDATE,
    MEASURED,
    NOTHING,
    PROPAGATED,
    RELEASES_LOW,
    REPLAYED,
    SENDS,
    UPDATED,
)
from sched_sim.heap import push
from sched_sim.schedule.jobs import HR, LR

if TYPE_CHECKING:
    from sched_sim.design.engine.plan import Plan
    from sched_sim.design.engine.records import Run

OF_K, OF_M, CARRIED_FROM, CARRIED_UNTIL = range(4)
"""How long ago the measurements were taken that a step has to do with."""

CHAIN, PROPAGATES, UPDATES, TO_APPLY, MISSING = range(5)
"""First in, first out: LR jobs in the order in which they run; those that wait for what they need; cycles whose
correction is not in the state yet; of each measurement on its way, how many corrections are not in the state at k."""


def release_high(run: Run, now: int) -> None:
    """The HR job of the next step, and the LR job of what arrives in it."""
    plan, state = run.plan, run.state
    step = state.step
    state.step = step + 1
    at_k, at_m = is_taken(run, OF_K), is_taken(run, OF_M) and step >= plan.M
    state.carried += is_taken(run, CARRIED_FROM) and step - plan.carried_from >= plan.earliest
    state.carried -= is_taken(run, CARRIED_UNTIL) and step - plan.carried_until >= plan.earliest
    work = plan.each + state.carried * plan.carry + applied(run, step) * plan.hr_update
    follows = NOTHING
    if at_k:
        work += plan.at_k + state.carried * plan.couple
        follows = plan.after_k
    if at_m:
        work += plan.at_m + max(state.taken - state.arrived - 1, 0) * plan.compensate
        state.arrived += 1
        if plan.after_m != NOTHING:
            follows = plan.after_m
    ready(run, new_job(run, HR_JOB, follows, step, HR, 0, now, now + plan.period, work))
    if at_k:
        if plan.dual_rate:
            put(run, MISSING, state.taken - state.in_state)
        state.taken += 1
    if at_m and plan.arrives:
        measurement(run, step - plan.M, now)


def is_taken(run: Run, which: int) -> bool:
    """Whether a measurement was taken that long ago; to be asked once in each step."""
    phase = run.phases[which] + run.plan.taken_count
    if phase >= run.plan.taken_steps:
        phase -= run.plan.taken_steps
    run.phases[which] = phase
    return bool(phase < run.plan.taken_count)


def applied(run: Run, step: int) -> int:
    """Lands the corrections that come into the state in the HR job of this step; how many HR updates they take."""
    updates = 0
    while waits(run, TO_APPLY):
        cycle = take(run, TO_APPLY)
        updates += max(run.state.taken - cycle, 1)
        land(run, cycle, step - -(-cycle * run.plan.taken_steps // run.plan.taken_count))
        run.state.in_state += 1
    return updates


def finished(run: Run, job: int, now: int) -> None:
    plan, state = run.plan, run.state
    follows, step = run.jobs[job].follows, run.jobs[job].step
    if follows == LANDS:
        k = step - plan.M
        land(run, taken_before(plan, k), max(step_at(run, now), step) - k)
    elif follows == SENDS:
        due = plan.propagate_due
        put(run, PROPAGATES, low_job(run, LR_PROPAGATE, PROPAGATED, step, now, due, plan.propagate))
        enqueue(run)
    elif follows == MEASURED:
        measurement(run, step, now)
    elif follows == RELEASES_LOW:
        ready(run, low_job(run, plan.low_kind, LOW_DONE, step, now, plan.update_due, plan.update))
    elif follows == LOW_DONE:
        put(run, TO_APPLY, taken_before(plan, step))
    elif follows == PROPAGATED and plan.gain:
        ready(run, low_job(run, LR_GAIN, FREES, step, now, plan.propagate_due, plan.gain))
    elif follows in (PROPAGATED, FREES):
        free_chain(run)
    elif follows == UPDATED:
        if plan.same_step:
            updates = max(taken_before(plan, step_at(run, now)) - taken_before(plan, step), 1)
            due = step * plan.period + plan.update_due
            ready(run, new_job(run, HR_UPDATE, FED_BACK, step, HR, 0, now, due, updates * plan.hr_update))
        else:
            put(run, TO_APPLY, taken_before(plan, step))
        free_chain(run)
    elif follows == FED_BACK:
        state.in_state += 1
        land(run, taken_before(plan, step), max(step_at(run, now) - step, plan.M))
    elif follows == REPLAYED:
        put(run, TO_APPLY, taken_before(plan, step))
        if plan.propagate:
            ready(run, low_job(run, LR_PROPAGATE, FREES, step, now, plan.propagate_due, plan.propagate))
        else:
            free_chain(run)


def goes_on(run: Run, job: int, now: int) -> bool:
    """Whether there is more to replay, for steps have come while it was replayed: the job is ready again."""
    if run.jobs[job].follows != REPLAYED:
        return False
    lands = step_at(run, now) + 1 - run.jobs[job].step
    more = lands - run.state.replayed
    if more <= 0:
        return False
    run.state.replayed = lands
    run.jobs[job].left = more * run.plan.replay
    ready(run, job)
    return True


def measurement(run: Run, k: int, now: int) -> None:
    """That of step k arrives: the LR update is released."""
    plan = run.plan
    if plan.dual_rate:
        work = plan.update + take(run, MISSING) * plan.hr_update
        put(run, UPDATES, low_job(run, LR_UPDATE, UPDATED, k, now, plan.update_due, work))
        enqueue(run)
    else:
        put(run, CHAIN, low_job(run, LR_UPDATE, REPLAYED, k, now, plan.update_due, plan.update))
        next_in_chain(run)


def enqueue(run: Run) -> None:
    """An LR update needs its LR propagate before it, and LR propagate the LR update before that computes the gain."""
    state = run.state
    while True:
        if waits(run, PROPAGATES) and (run.plan.gain or state.updates >= state.propagates):
            state.propagates += 1
            put(run, CHAIN, take(run, PROPAGATES))
        elif waits(run, UPDATES) and state.updates < state.propagates:
            state.updates += 1
            put(run, CHAIN, take(run, UPDATES))
        else:
            break
    next_in_chain(run)


def free_chain(run: Run) -> None:
    run.state.busy = 0
    run.state.freed += 1
    next_in_chain(run)


def next_in_chain(run: Run) -> None:
    if not run.state.busy and waits(run, CHAIN):
        run.state.busy = 1
        run.state.replayed = run.plan.M + 1
        ready(run, take(run, CHAIN))


def held(run: Run, job: int) -> bool:
    """Whether it waited for an earlier LR job."""
    return bool(0 <= run.jobs[job].freed < run.state.freed)


def low_job(run: Run, kind: int, follows: int, k: int, now: int, due: int, work: int) -> int:
    """due: after the start of step k."""
    plan = run.plan
    job = new_job(run, kind, follows, k, LR, plan.low_cpu, now, k * plan.period + due, work)
    run.jobs[job].freed = run.state.freed
    return job


def new_job(
    run: Run, kind: int, follows: int, step: int, priority: int, cpu: int, now: int, deadline: int, work: int
) -> int:
    """Its row among the jobs of the run."""
    state = run.state
    if state.unused == 0:
        state.full = 1
        state.unused = 1
    state.unused -= 1
    row = run.unused[state.unused]
    job = run.jobs[row]
    job.kind, job.follows, job.step, job.priority, job.cpu = kind, follows, step, priority, cpu
    job.release, job.deadline, job.left, job.freed, job.preemptive = now, deadline, work, -1, 1
    for each in range(run.cpus.shape[0]):
        if run.cpus[each].last == row:
            run.cpus[each].last = -1
    return int(row)


def ready(run: Run, job: int) -> None:
    state, row = run.state, run.jobs[job]
    cpu = run.cpus[row.cpu]
    state.order += 1
    cpu.ready = push(run.heaps, row.cpu, cpu.ready, row.deadline if run.plan.edf else row.priority, state.order, job)


def land(run: Run, cycle: int, L: int) -> None:
    if cycle < run.plan.cycles:
        run.landed[cycle] = L


def taken_before(plan: Plan, step: int) -> int:
    """How many measurements are taken before this step."""
    return int((step - 1) * plan.taken_count // plan.taken_steps + 1)


def step_at(run: Run, now: int) -> int:
    """The step in which it is now, before the releases of the instant; the last instant of a step belongs to it."""
    last = run.state.step - 1
    return int(last - (now <= last * run.plan.period))


def take(run: Run, which: int) -> int:
    head = run.ends[which, 0]
    run.ends[which, 0] = head + 1
    return int(run.queues[which, head & (run.queues.shape[1] - 1)])


def put(run: Run, which: int, value: int) -> None:
    head, tail = run.ends[which, 0], run.ends[which, 1]
    if tail - head == run.queues.shape[1]:
        run.state.full = 1
        return
    run.queues[which, tail & (run.queues.shape[1] - 1)] = value
    run.ends[which, 1] = tail + 1


def waits(run: Run, which: int) -> bool:
    return bool(run.ends[which, 0] != run.ends[which, 1])
