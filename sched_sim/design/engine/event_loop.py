"""The simulated processor on whole numbers, to be compiled: the rules of `schedule.processor`, written anew.

At one instant, finishes come first, then releases, then dispatch; a job without work finishes as it is dispatched, and
where a finish makes it the next, that is before the releases of the instant.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sched_sim.design.engine.codes import NOTHING
from sched_sim.design.engine.records import Run
from sched_sim.design.engine.rules import (
    CARRIED_FROM,
    CARRIED_UNTIL,
    OF_K,
    OF_M,
    applied,
    finished,
    goes_on,
    held,
    new_job,
    ready,
    release_high,
)
from sched_sim.heap import pop, push, replace

if TYPE_CHECKING:
    from sched_sim.design.engine.plan import Plan
    from sched_sim.design.engine.records import Cpu, Figures, Job, Numbers, Rows, State, TaskRow

CARRY = 2**61
"""A sum of response times is less; how often it was reached is counted beside it."""


def simulate_each(
    plans: Rows[Plan],
    states: Rows[State],
    cpus: Rows[Cpu],
    jobs: Rows[Job],
    unused: Numbers,
    phases: Numbers,
    queues: Numbers,
    ends: Numbers,
    heaps: Numbers,
    tasks: Rows[Rows[TaskRow]],
    figures: Rows[Rows[Figures]],
    landed: Numbers,
    log: Numbers,
    numbers: Numbers,
) -> None:
    """A run for each of these numbers of a plan. states, tasks, figures, landed: a row for each plan; other arrays are
    used anew by each run."""
    for number in numbers:
        run = Run(
            plans[number],
            states[number],
            cpus,
            jobs,
            unused,
            phases,
            queues,
            ends,
            heaps,
            tasks[number],
            figures[number],
            landed[number],
            log,
        )
        start(run)
        simulate_one(run)


def start(run: Run) -> None:
    plan, state = run.plan, run.state
    state.unused, state.first_kind = run.jobs.shape[0], -1
    for row in range(run.jobs.shape[0]):
        run.unused[row] = row
        run.jobs[row].kind = -1
    for cpu in run.cpus:
        cpu.ready = cpu.since = cpu.finish = cpu.busy = 0
        cpu.running = cpu.last = -1
    run.ends[:] = 0
    run.landed[:] = -1
    before = -plan.taken_count
    run.phases[OF_K] = before % plan.taken_steps
    run.phases[OF_M] = (before - plan.M * plan.taken_count) % plan.taken_steps
    run.phases[CARRIED_FROM] = (before - plan.carried_from * plan.taken_count) % plan.taken_steps
    run.phases[CARRIED_UNTIL] = (before - plan.carried_until * plan.taken_count) % plan.taken_steps
    size = push(run.heaps, 2, 0, 0, 0, 0)
    for task in range(run.tasks.shape[0]):
        size = push(run.heaps, 2, size, run.tasks[task].next_release, task + 1, task)


def simulate_one(run: Run) -> None:
    """Stops early where there is no room for more."""
    plan, state, horizon = run.plan, run.state, run.plan.horizon
    now, next_finish = 0, -1
    while not state.full:
        while now == next_finish and not state.full:
            next_finish = finish_jobs(run, now)
        if now == horizon:
            break
        release_jobs(run, now)
        until = min(run.heaps[2, 0, 0], horizon)
        for cpu in range(plan.cpus):
            if dispatch(run, cpu, now) and run.cpus[cpu].finish <= until:
                next_finish = until = run.cpus[cpu].finish
        state.instants += 1
        now = until
    applied(run, state.step)
    leave(run)


def finish_jobs(run: Run, now: int) -> int:
    """What finishes now; whether more does: -1, or now again."""
    plan, jobs = run.plan, run.jobs
    for number in range(plan.cpus):
        cpu = run.cpus[number]
        row = cpu.running
        if row < 0 or cpu.finish != now:
            continue
        cpu.running = -1
        cpu.busy += now - cpu.since
        if goes_on(run, row, now):
            continue
        figures = run.figures[jobs[row].kind]
        response = now - jobs[row].release
        figures.finished += 1
        figures.worst = max(figures.worst, response)
        figures.total += response
        if figures.total >= CARRY:
            figures.total -= CARRY
            figures.carries += 1
        if now > jobs[row].deadline:
            missed(run, row, now)
        if run.state.logged < run.log.shape[0]:
            line = run.log[run.state.logged]
            line[0], line[1], line[2], line[3] = jobs[row].kind, jobs[row].step, jobs[row].release, now
            run.state.logged += 1
        if jobs[row].follows != NOTHING:
            finished(run, row, now)
        jobs[row].kind = -1
        run.unused[run.state.unused] = row
        run.state.unused += 1
    again = -1
    for number in range(plan.cpus):
        cpu = run.cpus[number]
        if cpu.running < 0 and cpu.ready and not (plan.switch or jobs[run.heaps[number, 0, 2]].left):
            run_next(run, number)
            cpu.since = cpu.finish = again = now
    return again


def release_jobs(run: Run, now: int) -> None:
    heaps, sources = run.heaps, run.tasks.shape[0] + 1
    while heaps[2, 0, 0] == now and not run.state.full:
        source = heaps[2, 0, 1]
        if source == 0:
            release_high(run, now)
            replace(heaps, 2, sources, now + run.plan.period, 0, 0)
            continue
        task = run.tasks[source - 1]
        row = new_job(
            run, task.kind, NOTHING, task.count, task.priority, task.cpu, now, task.nominal + task.deadline, task.cost
        )
        run.jobs[row].preemptive = task.preemptive
        ready(run, row)
        task.nominal += task.period
        task.count += 1
        replace(heaps, 2, sources, task.nominal, source, 0)


def dispatch(run: Run, number: int, now: int) -> bool:
    """Whether a job runs."""
    plan, jobs, cpu = run.plan, run.jobs, run.cpus[number]
    row = cpu.running
    if cpu.ready and (row < 0 or (jobs[row].preemptive and run.heaps[number, 0, 0] < cpu.rank)):
        if row >= 0:
            ran, rank, order = now - cpu.since, cpu.rank, cpu.order
            jobs[row].left -= ran
            cpu.busy += ran
            run.figures[jobs[row].kind].preemptions += 1
            run_next(run, number)
            cpu.ready = push(run.heaps, number, cpu.ready, rank, order, row)
        else:
            run_next(run, number)
        row = cpu.running
        if plan.switch and row != cpu.last:
            jobs[row].left += plan.switch
            cpu.last = row
        cpu.since = now
        cpu.finish = now + jobs[row].left
    return bool(row >= 0)


def run_next(run: Run, number: int) -> None:
    cpu, top = run.cpus[number], run.heaps[number, 0]
    cpu.rank, cpu.order, cpu.running = top[0], top[1], top[2]
    cpu.ready = pop(run.heaps, number, cpu.ready)


def missed(run: Run, row: int, now: int) -> None:
    """The first miss is that of the least deadline, then priority, then release, then kind."""
    job, state = run.jobs[row], run.state
    figures = run.figures[job.kind]
    figures.misses += 1
    figures.worst_lateness = max(figures.worst_lateness, now - job.deadline)
    this = (job.deadline, job.priority, job.release, job.kind)
    if state.first_kind < 0 or this < (
        state.first_deadline,
        state.first_priority,
        state.first_release,
        state.first_kind,
    ):
        state.first_deadline, state.first_priority, state.first_release, state.first_kind = this
        state.first_held = held(run, row)


def leave(run: Run) -> None:
    """Unfinished jobs are counted as they stand."""
    horizon = run.plan.horizon
    for cpu in run.cpus:
        if cpu.running >= 0:
            cpu.busy += horizon - cpu.since
        run.state.busy_ticks += cpu.busy
    for row in range(run.jobs.shape[0]):
        if run.jobs[row].kind >= 0:
            run.figures[run.jobs[row].kind].releases += 1
            if run.jobs[row].deadline <= horizon:
                missed(run, row, horizon)
    for figures in run.figures:
        figures.releases += figures.finished
