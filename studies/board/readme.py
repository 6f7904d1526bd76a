"""What is said beside the files: how to compile, memory, stack, and how to time the jobs on the board."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from filters.translation.library import Precision
from sched_sim.costs.methods import MULTIRATE_METHODS
from studies.board.compiled import CLOCK_HZ, CORES, Compiled, stack_of, stacks_of
from studies.board.dual_rate import TASKS
from studies.board.jobs import Jobs
from studies.board.serial.methods import serial
from studies.board.steps import Steps
from studies.board.template import filled
from studies.board.wanted import Filter

BYTES = {"single": 4, "double": 8}


class About(NamedTuple):
    """What is said of a filter. method: in its cost table; described: sizes, forms and precision; source: of its
    equations, a sentence. part: of the README, "tasks", "steps", "composed" or "jobs"; order: which function of steps.c
    is called when; question: what the cost table is asked; structure: see `CostTable`."""

    method: str
    described: str
    source: str
    precision: Precision
    said: str
    part: str
    order: str = ""
    question: str = ""
    structure: str = ""


STEFFES = (
    "Equations are those of S. Steffes, Computationally Distributed Real-Time Dual Rate Kalman Filter, 2014, unless a "
    "function says otherwise."
)


WITHOUT_ZEROS = "Products leave out what is always zero, and those with one: the structure of the model says which."


def about_filter(wanted: Filter) -> About:
    """What is said of a method on a system."""
    n, m, p = wanted.system[:3]
    return About(
        wanted.method,
        f"{n} states, {m} inputs, {p} measurements; {wanted.update} covariance update; {wanted.precision} precision",
        f"{STEFFES} {WITHOUT_ZEROS}" if wanted.system.structure else STEFFES,
        wanted.precision,
        wanted.said,
        "tasks" if wanted.method == "dual-rate" else "steps" if wanted.steps is not None else "jobs",
        _order(wanted),
        _question(wanted),
        "sparse" if wanted.system.structure else "dense",
    )


def readme(
    about: About, in_c: Jobs, sizes: Mapping[str, int], sources: Mapping[str, str], on_core: Compiled | None
) -> str:
    """The file README.md. sizes: numbers in each array of state.h that is no constant. sources: for the board."""
    core, flags = CORES[about.precision]
    values = {
        **about._asdict(),
        "ask": " a scenario that names it as its `costs`"
        if about.part == "composed"
        else " what the board would have to do, and when the correction lands on it",
        "core": core,
        "clock_hz": CLOCK_HZ[about.precision],
        "flags": " ".join(flags),
        "sources": " ".join(sources),
        "kinds": ", ".join(f"`{kind}`" for kind in in_c.by_kind),
        "memory": "\n".join(_memory(about, in_c, sizes, sources, on_core)),
        "j_wraps": _wraps(in_c),
    }
    return "".join(filled(f"readme_{name}.md", values) for name in ("head", about.part, "end"))


def _memory(
    about: About, in_c: Jobs, sizes: Mapping[str, int], sources: Mapping[str, str], on_core: Compiled | None
) -> list[str]:
    each = BYTES[about.precision]
    lines = ["| what | bytes |", "| --- | ---: |"]
    tasks = TASKS if about.part == "tasks" else ()
    for task in tasks:
        own = sum(size for name, size in sizes.items() if name.startswith(f"{task}_"))
        lines.append(f"| RAM of {task.upper()}: arrays of state.h | {each * own} |")
    if not tasks:
        lines.append(f"| RAM: arrays of state.h | {each * sum(sizes.values())} |")
    if on_core is None:
        return [*lines, "", "No arm-none-eabi-gcc was found when this was written: code and stack are not known."]
    lines += [f"| code and constants of {name} | {size} |" for name, size in on_core.code.items()]
    if len(on_core.code) > 1:
        lines.append(f"| RAM of {[*on_core.code][-1]}, all | {on_core.ram} |")
    functions = in_c.unit.functions()
    for text in [text for name, text in sources.items() if name != "filter.c"]:
        for name, stack in stacks_of(text, functions, on_core.frames).items():
            lines.append(f"| stack of {name}, with all that it calls | {stack} |")
    for kind, job in in_c.by_kind.items():
        lines.append(f"| stack of the job {kind} | {stack_of(job, functions, on_core.frames)} |")
    said = f"arm-none-eabi-gcc {on_core.compiler} -O2 for {on_core.core}"
    return [*lines, "", f"By {said}, without the C library and interrupts."]


def _wraps(in_c: Jobs) -> str:
    used = any(name in job.used for job in in_c.by_kind.values() for name in ("j", "k"))
    return f"{'The model depends on the step, which is' if used else 'Steps are'} counted in an `int`: "


def _question(wanted: Filter) -> str:
    """The command that says when the correction lands, with the steps that it is written for."""
    steps = wanted.steps or Steps(10, 4, 5)
    given = f"-N {steps.N}"
    if wanted.method in MULTIRATE_METHODS:
        given += f" -L {steps.L}"
    else:
        given += f" -M {steps.M}"
        given += f" -L {steps.L}" if wanted.method in ("dual-rate", "delayed-horizon") else ""
    given += "".join(f" --{name.replace('_', '-')} {value}" for name, value in wanted.choices.items())
    return f"sched-sim minimum --costs board.toml --hr-hz 400 --method {wanted.method} {given}"


def _order(wanted: Filter) -> str:
    """Which function of steps.c is called when."""
    if wanted.steps is None or wanted.method == "dual-rate":
        return ""
    how = serial(wanted.method, wanted.steps)
    if how.order == "each":
        return "`filter_step`, and behind it `filter_measure` (not at all if the measurement was lost)."
    said = f"`filter_step`, in step m `filter_measure` {how.order} it, with the measurement of k"
    if how.takes:
        return f"{said}; and in step k, behind all else, `filter_take` if a measurement is taken that will arrive."
    return f"{said} (not at all if that was lost)."
