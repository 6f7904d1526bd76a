"""Live runs in the report on boards: as tables that are stored, and what is said of them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import floor
from typing import Any, NamedTuple

from reports.pages.machine import marked
from reports.pages.stored import Rows, Tables, records
from studies.embedded.stairs import Record, judged
from studies.live.agreement import ALIKE, ENOUGH, Agreement, Word
from studies.live.measure import Measured
from studies.live.stairs import nearest_step, word_of
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
        verdict = "near" if abs(from_step) < NEAR else of.word
        row = [f"{float(run.design.speed):.4f}", f"{float(100 * from_step):+.0f}".replace("-", "−"), run.predicted]
        rows.append([*row, _percent(of.share), _percent(Fraction(of.undisturbed, of.cycles)), calm, verdict])
    return rows


class Said(NamedTuple):
    """In the text. cycles: of each run; words: the verdict on all, with what it means."""

    cycles: int
    word: Word
    words: str
    near: str
    far: str
    swapped: Word
    swapped_agreeing: str
    machine: str
    differing: int


WORDS: dict[Word, str] = {
    "agrees": "corrections land where they are predicted to",
    "disagrees": "corrections do not all land where they are predicted to",
    "inconclusive": "too much was taken from the core for a verdict",
}


def about_live(of: Record) -> dict[str, Any]:
    """For the text: what it came to, whatever that is."""
    far = [run.agreement for run in of.runs if abs(nearest_step(run.design)) >= NEAR]
    near = [run.agreement for run in of.runs if abs(nearest_step(run.design)) < NEAR]
    word, about = word_of(of.runs), of.about
    return Said(
        of.runs[0].design.cycles,
        word,
        WORDS[word],
        _least(near),
        _least(far),
        of.swapped.agreement.word,
        f"{of.swapped.agreement.agreeing} of {of.swapped.agreement.cycles}",
        f"{about['machine']}, core {about['core']}, {about['kernel']}, {about['date']}",
        sum(run.ran.differing for run in of.runs),
    )._asdict() | {"alike": _percent(ALIKE), "enough": _percent(ENOUGH), "within": _percent(NEAR)}


def _least(of: Sequence[Agreement]) -> str:
    """The worst share of all cycles, and of the undisturbed."""
    calm = [each.share_undisturbed for each in of if each.share_undisturbed is not None]
    undisturbed = _percent(min(calm)) if calm else "0"
    return f"{_percent(min(each.share for each in of))} % of all cycles, {undisturbed} % of the undisturbed"


def _percent(share: Fraction) -> str:
    """In percent, never more than it is."""
    return f"{floor(1000 * share) / 10:g}"
