"""What is said beside the files: how to compile, memory, stack, and how to time the jobs on the board."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from studies.board.compiled import CORES, Compiled, stack_of
from studies.board.dual_rate import TASKS
from studies.board.jobs import Jobs
from studies.board.serial.methods import serial
from studies.board.template import filled
from studies.board.wanted import Filter

BYTES = {"single": 4, "double": 8}


def readme(
    wanted: Filter, in_c: Jobs, sizes: Mapping[str, int], sources: Sequence[str], on_core: Compiled | None
) -> str:
    """The file README.md. sizes: numbers in each array of state.h that is no constant. sources: for the board."""
    n, m, p = wanted.system[:3]
    core, flags = CORES[wanted.precision]
    part = "tasks" if wanted.method == "dual-rate" else "steps" if wanted.steps is not None else "jobs"
    values = {
        "method": wanted.method,
        "said": wanted.said,
        "n": n,
        "m": m,
        "p": p,
        "precision": wanted.precision,
        "update": wanted.update,
        "core": core,
        "flags": " ".join(flags),
        "sources": " ".join(sources),
        "kinds": ", ".join(f"`{kind}`" for kind in in_c.by_kind),
        "memory": "\n".join(_memory(wanted, in_c, sizes, on_core)),
        "j_wraps": _wraps(in_c),
        "order": _order(wanted),
    }
    return "".join(filled(f"readme_{name}.md", values) for name in ("head", part, "end"))


def _memory(wanted: Filter, in_c: Jobs, sizes: Mapping[str, int], on_core: Compiled | None) -> list[str]:
    each = BYTES[wanted.precision]
    lines = ["| what | bytes |", "| --- | ---: |"]
    tasks = TASKS if wanted.method == "dual-rate" else {}
    for task, kinds in tasks.items():
        own = sum(size for name, size in sizes.items() if name.startswith((f"{task}_", *kinds)))
        lines.append(f"| RAM of {task.upper()}: arrays of state.h | {each * own} |")
    if not tasks:
        lines.append(f"| RAM: arrays of state.h | {each * sum(sizes.values())} |")
    if on_core is None:
        return [*lines, "", "No arm-none-eabi-gcc was found when this was written: code and stack are not known."]
    lines += [f"| code and constants of {name} | {size} |" for name, size in on_core.code.items()]
    if len(on_core.code) > 1:
        lines.append(f"| RAM of {[*on_core.code][-1]}, all | {on_core.ram} |")
    functions = in_c.unit.functions()
    for kind, job in in_c.by_kind.items():
        lines.append(f"| stack of {kind} | {stack_of(job, functions, on_core.frames)} |")
    said = f"arm-none-eabi-gcc {on_core.compiler} -O2 for {on_core.core}"
    return [*lines, "", f"By {said}, without the C library and interrupts."]


def _wraps(in_c: Jobs) -> str:
    used = any(name in job.used for job in in_c.by_kind.values() for name in ("j", "k"))
    return f"{'The model depends on the step, which is' if used else 'Steps are'} counted in an `int`: "


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
