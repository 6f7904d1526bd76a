"""Live runs in the report on boards: as tables that are stored, and what is said of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from math import floor
from typing import Any, NamedTuple

from reports.pages.machine import marked
from reports.pages.minus import true_minus
from reports.pages.stored import Rows, Tables, records
from studies.embedded.stairs import Record, judged
from studies.live.agreement import ALIKE, CONFIDENCE, ENOUGH, Agreement, Word, together, would_do
from studies.live.measure import Measured
from studies.live.stairs import far_from_steps, nearest_step, word_of
from studies.live.taken import NEAR

TABLES = ("live", "live-runs", "live-about")


def live_tables(of: Record) -> dict[str, Rows]:
    """What `recorded` reads."""
    cycles: Rows = [["run", "cycle", "achieved", "disturbed"]]
    runs: Rows = [["run", "speed", "swapped", "differing", "taken_share"]]
    for number, run in enumerate([*of.runs, of.swapped], start=1):
        swapped = run is of.swapped
        runs.append([number, str(run.design.speed), int(swapped), run.ran.differing, f"{run.taken_share:.2g}"])
        for cycle, (landed, spoilt) in enumerate(zip(run.achieved, run.disturbed, strict=True), start=1):
            cycles.append([number, cycle, "" if landed is None else landed, int(spoilt)])
    return {"live": cycles, "live-runs": runs, "live-about": [["what", "said"], *map(list, of.about.items())]}


def recorded(tables: Tables) -> Record:
    """The runs that were stored."""
    by_run: dict[str, list[tuple[int | None, bool]]] = {}
    for row in records(tables["live"]):
        landed = int(row["achieved"]) if row["achieved"] else None
        by_run.setdefault(row["run"], []).append((landed, row["disturbed"] == "1"))
    runs: list[Measured] = []
    swapped: list[Measured] = []
    for row in records(tables["live-runs"]):
        of = judged(Fraction(row["speed"]), by_run[row["run"]], int(row["differing"]), float(row["taken_share"]))
        (swapped if row["swapped"] == "1" else runs).append(of)
    about = {row["what"]: row["said"] for row in records(tables["live-about"])}
    return Record(runs, swapped[0], about)


def live_rows(runs: Sequence[Measured]) -> Rows:
    """Each speed: how many cycles landed as predicted."""
    rows: Rows = [
        [
            "Speed", "from the step, %", "predicted l", *map(marked, ("as predicted, %", "undisturbed, %")),
            marked("of these as predicted, %"), marked("verdict"),
        ]
    ]  # fmt: skip
    for run in runs:
        of, from_step = run.agreement, nearest_step(run.design)
        calm = "-" if of.share_undisturbed is None else _percent(of.share_undisturbed)
        verdict = "near" if abs(from_step) < NEAR else _verdict(of)
        row = [f"{float(run.design.speed):.4f}", true_minus(f"{float(100 * from_step):+.0f}"), run.predicted]
        rows.append([*row, _percent(of.share), _percent(Fraction(of.undisturbed, of.cycles)), calm, verdict])
    return rows


def _verdict(of: Agreement) -> str:
    """With why there is none."""
    if of.word != "inconclusive":
        return of.word
    return "inconclusive: disturbed" if of.too_disturbed else "inconclusive: few"


class Said(NamedTuple):
    """In the text. cycles: of each run; speeds: how many there are; word: the verdict on all; words: what it means;
    verdicts: of each speed alone, in numbers."""

    cycles: int
    speeds: int
    word: Word
    words: str
    verdicts: str
    far: str
    near: str
    swapped: Word
    swapped_agreeing: str
    machine: str
    differing: int


def about_live(of: Record) -> dict[str, Any]:
    """For the text: what it came to, whatever that is."""
    far = far_from_steps(of.runs)
    near = [run.agreement for run in of.runs if abs(nearest_step(run.design)) < NEAR]
    word, about = word_of(of.runs), of.about
    return Said(
        of.runs[0].design.cycles,
        len(of.runs),
        word,
        _meaning(word, far),
        _verdicts(far, len(near)),
        _landed(far),
        _landed(near),
        of.swapped.agreement.word,
        f"{of.swapped.agreement.agreeing} of {of.swapped.agreement.cycles}",
        f"{about['machine']}, core {about['core']}, {about['kernel']}, {about['date']}",
        sum(run.ran.differing for run in of.runs),
    )._asdict() | {
        "alike": _percent(ALIKE),
        "enough": _percent(ENOUGH),
        "within": _percent(NEAR),
        "confidence": _percent(CONFIDENCE),
        "fewest": would_do(0),
    }


def _meaning(word: Word, far: Sequence[Agreement]) -> str:
    if word == "agrees":
        return "corrections land where they are predicted to"
    if word == "disagrees":
        return "corrections do not all land where they are predicted to"
    if any(of.too_disturbed for of in far):
        return "too much was taken from the core for a verdict"
    return "the cycles are too few for a verdict"


def _verdicts(far: Sequence[Agreement], near: int) -> str:
    """How many speeds have which, each by its own cycles."""
    words = Counter(of.word for of in far)
    disturbed = sum(of.too_disturbed for of in far)
    few = words["inconclusive"] - disturbed
    return (
        f"{words['agrees']} agree, {words['disagrees']} disagree, {few + disturbed} are inconclusive ({few} for too "
        f"few cycles, {disturbed} for too many disturbed ones), {near} are near a step and have no verdict"
    )


def _landed(of: Sequence[Agreement]) -> str:
    """Of all these speeds together."""
    if not of:
        return "no cycles"
    whole = together(of)
    return (
        f"{whole.agreeing_undisturbed:,} of {whole.undisturbed:,} undisturbed cycles and {whole.agreeing:,} of "
        f"all {whole.cycles:,}"
    )


def _percent(share: Fraction) -> str:
    """In percent, never more than it is."""
    return f"{floor(1000 * share) / 10:g}"
