"""The memory of a scenario's simulation as it is before the first step."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from sched_sim.scenario.draws import stream
from sched_sim.scenario.engine import memory as at
from sched_sim.scenario.engine.measured import Ints, Measured
from sched_sim.scenario.engine.nearness import BINS
from sched_sim.scenario.engine.words import stream_of
from sched_sim.scenario.kinds import correct_kind, gain_kind, loss_kind
from sched_sim.scenario.workload import Workload

FIRST_JOBS = 64
"""Room for so many at first, beside those of one instant."""


class Layout:
    """What has been placed in the memory, from address 0 on."""

    def __init__(self) -> None:
        self.blocks: list[Ints] = []
        self.end = 0

    def place(self, numbers: Iterable[int] | Ints) -> int:
        """The address of these numbers."""
        block = numbers if isinstance(numbers, np.ndarray) else np.array([*numbers], np.int64)
        address = self.end
        self.blocks.append(block)
        self.end += block.size
        return address

    def table(self, width: int, rows: Iterable[Mapping[int, int]]) -> tuple[int, int]:
        """Where a table of such rows begins and ends; what a row does not say is 0."""
        return self.place([row.get(field, 0) for row in rows for field in range(width)]), self.end

    def memory(self) -> Ints:
        return np.concatenate([block.ravel() for block in self.blocks])


def memory_of(workload: Workload, measured: Measured) -> Ints:
    layout, header = Layout(), np.zeros(at.HEADER, np.int64)
    layout.place(header)
    header[at.PERIOD], header[at.HORIZON], header[at.SWITCH] = (
        workload.period,
        workload.horizon,
        workload.context_switch,
    )
    header[at.RULE] = _rule(workload)
    header[at.NEXT_FINISH] = -1
    for ring in (at.PENDING, at.CARRIED, at.FLYING, at.APPLIED):
        header[ring + at.PREVIOUS] = header[ring + at.FOLLOWING] = ring
    header[at.APPLIED_AT] = -1
    lanes = _place_processors(layout, header, workload)
    _place_tasks(layout, header, workload, lanes)
    sensors = _place_sensors(layout, header, workload, lanes)
    most_at_once = _place_measurements(layout, header, workload, measured, sensors)
    header[at.ROOM] = most_at_once + 2 * len(workload.scenario.sensors) + len(workload.scenario.tasks) + 2
    header[at.WATCHED], header[at.HISTOGRAM] = at.NO_KIND, layout.place(np.zeros(BINS, np.int64))
    header[at.FIRST_JOB] = layout.end
    return with_jobs(layout.memory(), FIRST_JOBS + int(header[at.ROOM]))


def with_jobs(memory: Ints, count: int) -> Ints:
    """With room for so many jobs more."""
    rows = np.zeros((count, at.JOB), np.int64)
    rows[:, at.JOB_NEXT] = memory.size + at.JOB * np.arange(1, count + 1)
    rows[-1, at.JOB_NEXT] = memory[at.FREE]
    rows[:, at.KIND] = at.NO_KIND
    grown = np.concatenate([memory, rows.ravel()])
    grown[at.FREE] = memory.size
    grown[at.FREE_JOBS] += count
    return grown


def _rule(workload: Workload) -> int:
    scenario = workload.scenario
    if scenario.late == "dual-rate":
        return at.DUAL_RATE
    if scenario.carries is not None:
        return at.SEVERAL
    return at.ONE if scenario.late == "larsen" else at.BACK


def _place_processors(layout: Layout, header: Ints, workload: Workload) -> list[dict[int, int]]:
    """The lane of each priority, by processor."""
    scenario = workload.scenario
    priorities = {scenario.priority, *(sensor.priority for sensor in scenario.sensors)}
    priorities |= {task.priority for task in scenario.tasks}
    lanes, rows = [], []
    for _ in range(scenario.cpus):
        first = layout.place([0, 0] * len(priorities))
        lanes.append({priority: first + 2 * rank for rank, priority in enumerate(sorted(priorities))})
        rows.append({at.BEST: layout.end, at.LANES_END: layout.end})
    header[at.CPUS], header[at.CPUS_END] = layout.table(at.CPU, rows)
    header[at.HR_LANE] = lanes[0][scenario.priority]
    header[at.PREEMPTED_JOBS] = layout.place([0] * len(workload.kinds))
    return lanes


def _place_tasks(layout: Layout, header: Ints, workload: Workload, lanes: Sequence[Mapping[int, int]]) -> None:
    sources = workload.tasks()
    first_kind = len(workload.kinds) - len(sources)
    rows = [
        {
            at.TASK_RELEASE: source.next_release,
            at.TASK_NOMINAL: source.nominal,
            at.TASK_PERIOD: source.period,
            at.TASK_DUE: source.deadline,
            at.TASK_COST: source.cost,
            at.TASK_LANE: lanes[source.task.cpu - 1][source.task.priority],
            at.TASK_CPU: int(header[at.CPUS]) + (source.task.cpu - 1) * at.CPU,
            at.TASK_PREEMPTIVE: int(source.task.preemptive),
            at.TASK_KIND: first_kind + number,
        }
        for number, source in enumerate(sources)
    ]
    header[at.TASKS], header[at.TASKS_END] = layout.table(at.TASK, rows)
    header[at.NEXT_TASK] = min((source.next_release for source in sources), default=workload.horizon)


def _place_sensors(
    layout: Layout, header: Ints, workload: Workload, lanes: Sequence[Mapping[int, int]]
) -> Sequence[int]:
    """The address of each; and the parts of the filter, the streams, and what waits by priority."""
    scenario = workload.scenario
    part = {name: layout.place([len(times), *times]) for name, times in workload.costs.items()}
    kind = {name: number for number, name in enumerate(workload.kinds)}

    def place_stream(purpose: str) -> int:
        return layout.place(stream_of(stream(scenario.seed, purpose).bit_generator.state))

    def first_of(names: Iterable[str]) -> int:
        return next((part[name] for name in names if name in part), 0)

    header[at.HR_STREAM] = place_stream("predictor cost")
    for field, names in HIGH_RATE_PARTS.items():
        header[field] = first_of(names)
    waiting = {priority: layout.place([0, 0, 0]) for priority in {sensor.priority for sensor in scenario.sensors}}
    rows = []
    for sensor in scenario.sensors:
        own = {field: [f"{name}.{sensor.name}" for name in names] for field, names in PARTS.items()}
        if scenario.carries is not None:
            own[at.CARRY] = [scenario.carries.of(sensor.name)]
        rows.append(
            {
                at.SENSOR_KIND: kind[correct_kind(sensor)],
                at.LANE: lanes[-1][sensor.priority],
                at.SENSOR_CPU: int(header[at.CPUS_END]) - at.CPU,
                at.DUE: scenario.due(sensor),
                at.DELAYED: int(sensor.delayed),
                at.PREEMPTED: int(scenario.preempted(sensor)),
                at.STREAM: place_stream(f"{sensor.name} cost"),
                at.WAITING: waiting[sensor.priority],
                at.GAIN_KIND: kind.get(gain_kind(sensor), 0),
                at.LOSS_KIND: kind.get(loss_kind(sensor), 0),
                **{field: first_of(several) for field, several in own.items()},
            }
        )
    header[at.SENSORS], end = layout.table(at.SENSOR, rows)
    return range(int(header[at.SENSORS]), end, at.SENSOR)


HIGH_RATE_PARTS = {
    at.PREDICT: ("predict", "hr_propagate"),
    at.PREDICT_ACCUMULATE: ("predict_accumulate",),
    at.HR_RESTART: ("hr_restart",),
    at.HR_UPDATE: ("hr_update",),
    at.LR_PROPAGATE: ("lr_propagate",),
}
PARTS = {
    at.CORRECT: ("correct", "lr_correct"),
    at.CORRECT_ACCUMULATE: ("correct_accumulate",),
    at.BESIDE: ("beside", "beside_product"),
    at.LAND: ("land", "land_product", "correct_late"),
    at.GAIN: ("gain",),
    at.HR_PASS: ("hr_pass",),
    at.GAIN_AGAIN: ("gain_again",),
    at.GAIN_KEPT: ("gain_kept",),
}
"""The names of each, of which a scenario has one at most."""


def _place_measurements(
    layout: Layout, header: Ints, workload: Workload, measured: Measured, sensors: Sequence[int]
) -> int:
    """And the order in which they arrive, or are known to be lost; how many do in one step, at most."""
    steps, count = workload.scenario.steps, measured.step.size
    rows = np.zeros((count + 1, at.MEASUREMENT), np.int64)
    address = layout.end + at.MEASUREMENT * np.arange(count + 1)
    rows[:-1, at.TAKEN_AT], rows[-1, at.TAKEN_AT] = measured.step, at.NO_STEP
    rows[:-1, at.ARRIVES], rows[-1, at.ARRIVES] = measured.arrives, at.NO_STEP
    rows[:-1, at.OF] = np.array(sensors)[measured.sensor]
    rows[:, at.TO_COVARIANCE + at.ABOUT] = rows[:, at.TO_STATE + at.ABOUT] = address
    header[at.MEASUREMENTS] = header[at.TAKEN] = layout.place(rows)
    arriving = _arriving(workload, measured)
    header[at.ARRIVED] = layout.place(address[np.append(arriving, count)])
    rows[arriving, at.ORDER] = header[at.ARRIVED] + np.arange(arriving.size)
    known = _known_as_lost(workload, measured)
    lost = np.flatnonzero((known >= 0) & (known < steps))
    lost = lost[np.argsort(known[lost], kind="stable")]
    header[at.LOST] = layout.place(np.append(np.stack([known[lost], address[lost]], axis=1), [at.NO_STEP, 0]))
    header[at.LANDED] = layout.place(np.zeros(2 * count, np.int64))
    return sum(int(np.bincount(steps_of).max(initial=0)) for steps_of in (measured.arrives[arriving], known[lost]))


def _arriving(workload: Workload, measured: Measured) -> Ints:
    """The numbers of those that arrive, in the order of their corrections."""
    scenario = workload.scenario
    step, sensor, arrives = measured
    keys = [step, sensor, step, arrives]
    if scenario.late != "dual-rate":
        ranks = {priority: rank for rank, priority in enumerate(sorted({each.priority for each in scenario.sensors}))}
        rank = np.array([ranks[each.priority] for each in scenario.sensors])[sensor]
        keys = [step, sensor, step == arrives, rank, arrives]
    order = np.lexsort(keys)
    there = arrives[order]
    return order[(there >= 0) & (there < scenario.steps)]


def _known_as_lost(workload: Workload, measured: Measured) -> Ints:
    """The step in which the filter knows that a measurement never arrives, NEVER if it asks not."""
    scenario = workload.scenario
    if scenario.late == "dual-rate":
        after = np.array([sensor.land_by for sensor in scenario.sensors])
    else:
        after = np.array([sensor.longest_delay for sensor in scenario.sensors])
    asks = (measured.arrives == at.NEVER) & (after[measured.sensor] > 0)
    return np.where(asks, measured.step + after[measured.sensor], at.NEVER)
