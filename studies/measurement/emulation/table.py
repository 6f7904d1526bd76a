"""The cost table of an emulated core: instructions by method and job, and the memory of each method."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from filters.jobs import Job
from filters.translation.library import Precision
from filters.translation.refusal import Untranslatable
from sched_sim.costs.table import INSTRUCTION, Cost, CostTable
from sched_sim.errors import InputError
from studies.measurement.emulation.jobs import ARGUMENT_SETS, emulate
from studies.measurement.emulation.memory import COUNTED, Memory, memory_of
from studies.measurement.emulation.targets import Target
from studies.measurement.emulation.toolchain import FLAGS, check_installed, versions
from studies.measurement.job_times import Progress, silent

SOURCE = (
    "instructions, not cycles: QEMU has no pipeline, caches and wait states; those of a call of the job, with passing "
    f"its arguments; p95: the most of {ARGUMENT_SETS} sets of arguments"
)


def emulated_table(
    jobs: Mapping[tuple[str, str], Job],
    target: Target,
    precision: Precision,
    about: Mapping[str, Any],
    *,
    name: str,
    progress: Progress = silent,
) -> CostTable:
    """The cost table of these jobs, by method and kind; about: what else is to be said of them.

    Raises InputError where the compiler or the emulator is missing, and for a job that cannot be translated, with the
    file, the line and what stands there.
    """
    check_installed()
    by_method: dict[str, dict[str, Job]] = {}
    for (method, kind), job in jobs.items():
        by_method.setdefault(method, {})[kind] = job
    costs: dict[str, dict[str, Cost]] = {}
    memory: dict[str, Memory] = {}
    for number, (method, kinds) in enumerate(by_method.items()):
        progress(number, len(by_method), method)
        try:
            found = emulate(kinds, target, precision)
            memory[method] = memory_of(method, kinds, found, target, precision)
        except Untranslatable as error:
            raise InputError(f"{method} cannot be translated to C for {target.name}: {error}") from error
        except ValueError as error:
            raise InputError(f"{method} cannot be measured on {target.name}: {error}") from error
        costs[method] = {kind: _cost(emulated.instructions) for kind, emulated in found.items()}
    provenance = {
        **about,
        "target": target.name,
        "precision": precision,
        "machine": f"{target.title}; QEMU's {target.board}",
        **versions(),
        "flags": " ".join((*FLAGS, *target.flags)),
        "source": SOURCE,
        "memory_source": COUNTED,
        "memory": memory,
    }
    return CostTable(name, INSTRUCTION, costs, provenance)


def _cost(instructions: Sequence[int]) -> Cost:
    return Cost(*(Fraction(f(instructions)) for f in (min, statistics.median_low, max)))
