"""What the text of the report on boards says in numbers; a claim that its tables do not bear is not printed."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from math import ceil
from typing import Any

from reports.charts.panels import METHOD_NAMES
from reports.embedded import board_tables
from reports.embedded.compared import Compared, largest
from reports.embedded.results import Results
from reports.embedded.tables import per_operation
from reports.embedded.words import CORES, HERE, IN_HARDWARE, PAPERS, SOURCES, as_ratio, factor, percent_up, signed
from reports.pages.machine import legend, timed_on
from reports.pages.measurements import counted_on
from reports.pages.numbers import span
from sched_sim.costs.table_file import load_costs
from sched_sim.processors.part_file import load_part
from studies.embedded.folders import FOLDERS
from studies.embedded.known_loop import INSTRUCTIONS
from studies.embedded.published import times_us
from studies.embedded.sources import DESIGNS, FIRST, METHODS, counted, relative_speed
from studies.measurement.emulation.toolchain import FLAGS
from studies.measurement.published_timings import published_timings

WITHIN = 0.02
"""Least speeds by emulated cores and by counts should differ by no more, of the paper's methods."""
_PARTS = [load_part(name) for name in ("cortex-m4f", "cortex-m33", "cortex-m7")]
ASSUMED = float(1 + max(part.logic_per_arithmetic for part in _PARTS))
"""Instructions for an operation, of which one is the operation itself, as the files of these parts take them."""


def about_speeds(results: Results, found: Sequence[Compared]) -> dict[str, Any]:
    emulated = [one for one in found if one.source in CORES]
    papers = _of(emulated, "textbook", PAPERS)
    if abs(papers.deviation) > WITHIN:
        raise ValueError("emulated least speeds differ by more than 2 % from counted ones, against the report's claim")
    step = {kind: _each(results, "standard", kind, "short") for kind in ("propagate", "update")}
    if not max(step["propagate"]) < min(step["update"]):
        raise ValueError("in the short form propagate takes as many instructions an operation as update")
    here = [name for name in HERE if name != "numpy" and any(one.source == name for one in found)]
    return {
        "apart": f"{ceil(100 * (swapped(emulated) - 1))}",
        "here_apart": f"{ceil(100 * (swapped([one for one in found if one.source in here]) - 1))}",
        "paper": {
            method: f"{float(relative_speed(load_costs('steffes2014'), method, FIRST)):.2f}"
            for method in ("dual-rate", "larsen")
        },
        "by_counts": {
            method: f"{float(relative_speed(counted('textbook'), method, FIRST)):.2f}"
            for method in ("dual-rate", "larsen")
        },
        "papers": percent_up(abs(papers.deviation)),
        "most": percent_up(abs(largest(emulated).deviation)),
        "short_papers": signed(_of(emulated, "short", ["dual-rate"]).deviation),
        "here": {
            form: " and ".join(
                f"{100 * abs(float(_of([one for one in found if one.source == name], form, PAPERS).deviation)):.1f} % "
                f"({SOURCES[name]})"
                for name in here
            )
            for form in ("textbook", "short")
        },
        "step": {kind: span(*(f"{end:.1f}" for end in (min(each), max(each)))) for kind, each in step.items()},
        "designs": "; ".join(f"{of.N}, {of.M}, {of.L}" for of in DESIGNS),
        "number": len(DESIGNS),
        "methods": len(METHODS) - 1,
    }


def _of(found: Sequence[Compared], form: str, methods: Sequence[str]) -> Compared:
    return largest(one for one in found if one.form == form and one.method in methods)


def swapped(found: Sequence[Compared]) -> Fraction:
    """The largest ratio of the counted least speeds of two methods that a source has in the other order."""
    by_design: dict[Any, list[Compared]] = {}
    for one in found:
        by_design.setdefault((one.form, one.timing, one.source), []).append(one)
    return max(
        (
            max(one.counted / other.counted, other.counted / one.counted)
            for of in by_design.values()
            for one, other in combinations(of, 2)
            if (one.counted - other.counted) * (one.speed - other.speed) < 0
        ),
        default=Fraction(1),
    )


def _each(results: Results, method: str, kind: str, form: Any) -> list[float]:
    """Instructions for an operation of a job on each core with an FPU."""
    number = counted(form).entry(method, kind).median
    return [float(results.costs[core, form].entry(method, kind).median / number) for core in IN_HARDWARE]


def about_jobs(results: Results) -> dict[str, Any]:
    by_form = per_operation(results)
    hardware = [ratio for of in by_form.values() for core in IN_HARDWARE for _, ratio in of[core]]
    software = [ratio for of in by_form.values() for _, ratio in of["cortex-m4-soft"]]
    large = {
        form: [ratio for core in IN_HARDWARE for number, ratio in of[core] if number >= 1000]
        for form, of in by_form.items()
    }
    split = _each(results, "clone-split", "update", "textbook")
    return {
        "assumed": f"{ASSUMED:g}",
        "hardware": span(*(f"{end:.1f}" for end in (min(hardware), max(hardware)))),
        "software": span(*(f"{end:.0f}" for end in (min(software), max(software)))),
        "over": {form: span(*(f"{end / ASSUMED:.2f}" for end in (min(of), max(of)))) for form, of in large.items()},
        "split": span(*(f"{end:.1f}" for end in (min(split), max(split)))),
    }


def about_boards(results: Results) -> dict[str, Any]:
    every = published_timings()
    by_written: dict[str, list[Fraction]] = {}
    for timing in every:
        by_written.setdefault(timing.written, []).extend(timing.ratios)
    ends = {written: (min(of), max(of)) for written, of in by_written.items()}
    if not ends["generic matrix class"][0] > ends["plain loops"][1] > ends["zeros left out"][1]:
        raise ValueError("published timings are not ordered as the report says")
    looked = [
        (timing, int(row["instructions"]))
        for timing, row in zip(every, results.records("boards"), strict=True)
        if timing.written == "plain loops" and row["instructions"]
    ]
    plain = [(timing, times_us(timing, number)) for timing, number in looked]
    if any(timing.most_us < least for timing, (least, _) in plain):
        raise ValueError("a board takes less than the least time by instructions, against the report")
    above = [float(timing.most_us / most) - 1 for timing, (_, most) in plain if timing.most_us > most]
    cycles = [timing.most_us * timing.clock_mhz / number for timing, number in looked]
    return {
        "within": float(factor(by_written["plain loops"])),
        "plain": span(*map(as_ratio, ends["plain loops"])),
        "generic": span(*(f"{float(end):.0f}" for end in ends["generic matrix class"])),
        "sparse": span(*map(as_ratio, ends["zeros left out"])),
        "faster": f"{float(1 / ends['zeros left out'][0]):.0f}",
        "plain_number": len(plain),
        "inside": f"{len(plain) - len(above)} are in that range, the others up to {100 * max(above):.0f} % above it"
        if above
        else "all are in that range",
        "cycles": span(*(f"{float(end):.2f}" for end in (min(cycles), max(cycles)))),
    }


def about_memory(results: Results) -> dict[str, Any]:
    rows = board_tables.memory(results, "textbook")[1:]
    needed = {(row[0], row[1]): float(row[-1]) for row in rows}
    whole = {(row["method"], row["precision"]): int(row["ram"]) for row in results.records("folders")}
    single = {method: needed[METHOD_NAMES[method], "single"] for method in METHODS}
    ram = {method: whole[method, "single"] for method in FOLDERS}
    if max(single, key=single.__getitem__) != "dual-rate":
        raise ValueError("another method than dual-rate takes most RAM by its jobs, against the report")
    if sorted(ram, key=ram.__getitem__)[:-4:-1] != ["augmentation", "dual-rate", "larsen"]:
        raise ValueError("other methods than augmentation, dual-rate and larsen take most RAM, against the report")
    flash = [int(row["code"]) for row in results.records("folders") if row["precision"] == "single"]
    return {
        "number": len(ram),
        "flash": span(f"{min(flash):,}", f"{max(flash):,}"),
        "least": f"{min(ram.values()):,}",
        "augmentation": f"{ram['augmentation']:,}",
        "dual_rate": f"{ram['dual-rate']:,}",
        "larsen": f"{ram['larsen']:,}",
        "bounded": len(single),
        "upper": " and ".join(f"{needed[METHOD_NAMES['dual-rate'], of]:.1f}" for of in ("single", "double")),
        "over_larsen": f"{single['dual-rate'] / single['larsen']:.1f}",
        "whole_over_larsen": f"{ram['dual-rate'] / ram['larsen']:.1f}",
        "model": f"{results.costs['cortex-m4f', 'textbook'].provenance['memory']['standard']['model']['code']:,}",
    }


def provenance(results: Results) -> dict[str, Any]:
    """Of what is emulated, and of what is timed here."""
    core, here = results.costs["cortex-m4f", "textbook"].provenance, results.costs["numba", "textbook"].provenance
    busy = [table.provenance["busy"] for (name, _), table in results.costs.items() if "busy" in table.provenance]
    checks = results.records("checks")
    exact = all(int(row[run]) == INSTRUCTIONS for row in checks for run in ("loop", "loop_again"))
    if not exact or any(int(row["differing"]) for row in checks):
        raise ValueError("the known loop is not counted exactly, or a second run differs, against the report")
    about = {**here, **({"busy": busy[0]} if busy else {})}
    c = results.costs[("c", "textbook")].provenance["compiler"] if ("c", "textbook") in results.costs else ""
    return {
        "legend": legend(timed_on(about)),
        "measured_on": counted_on(results.measurements("numba", "textbook")),
        "compiler": core["compiler"],
        "emulator": core["emulator"],
        "flags": " ".join(FLAGS),
        "c": c,
        "not_emulated": results.said["emulated"],
        "no_c": results.said["c"],
        "loop": f"{INSTRUCTIONS:,}",
        "jobs": sum(int(row["jobs"]) for row in checks),
    }
