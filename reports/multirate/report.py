"""The report on the multirate gain of the patent "Optimal covariance filtering": what it saves and what it costs."""

from __future__ import annotations

from reports.multirate import limits, said, shown, tables
from reports.multirate.costs import least_time_of, our_forms, patents_form
from reports.multirate.drawn import drawn
from reports.multirate.results import PERIODS, N, Results
from reports.multirate.schedule import RATES_HZ, frames_over_rate, schedule_rows
from reports.multirate.words import formula_text, signed
from reports.pages.pictures import Sliding, files, pictures
from reports.pages.render import csv_bytes, render
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.multirate import patent

TITLE = "The multirate gain, regenerated: what it saves, and what it costs"


def build(results: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what the studies found."""
    own, forms = patents_form(), our_forms()
    parts = [load_part(name) for name in shipped_parts()]
    patents = next(part for part in parts if part.name == "patent")
    cases, costs = patent.loads(), least_time_of(own, patents)
    textbook = forms["conventional, textbook"]
    asked = [(textbook, 1), (textbook, N), (forms["U-D"], N), (forms["square-root"], N)]
    tended = limits.limits()
    rows = {
        "loads": tables.loads(cases),
        "our-loads": tables.our_loads(forms.values(), patents),
        "limit-by-form": tables.limit_by_form([own, *forms.values()], patents),
        "logic": tables.logic(own, textbook, parts),
        "terms": tables.term_rows(),
        "totals": tables.totals(),
        "load-by-n": tables.load_by_n([own, *forms.values()], patents, PERIODS),
        "steady": tables.steady(results),
        "constancy": tables.constancy(results),
        "more": limits.more_rows(tended),
        "faster": limits.faster_rows(tended, costs),
        "late": tables.late(results),
        "starts": tables.starts(results),
        "processors": tables.processor_rows(asked, parts),
    }
    on_patents = on_part(own.table, patents)
    frames, shown_at = frames_over_rate(on_patents, N), RATES_HZ.index(said.GANTT_HZ)
    others = {
        "accuracy": tables.accuracy_rows(results),
        "limits": limits.all_rows(tended),
        "gains": tables.gain_rows(results),
        "courses": tables.course_rows(results),
        "rates": schedule_rows(frames[shown_at].panels, said.GANTT_HZ),
    }
    sliding = Sliding("measurement rate", frames, shown_at)
    figures = pictures({**drawn(results, tended, own, forms, patents, cases), "rates.svg": sliding})
    pages = render(
        "patent-multirate",
        TITLE,
        figures,
        **{name.replace("-", "_"): table for name, table in rows.items()},
        shown={
            "loads": shown.cases(rows["loads"]),
            "our_loads": shown.cases(rows["our-loads"]),
            "terms": shown.terms(rows["terms"]),
            "totals": shown.totals(rows["totals"]),
            "steady": shown.steady(rows["steady"]),
            "constancy": shown.constancy(rows["constancy"]),
            "limit_by_form": shown.cases(rows["limit-by-form"]),
            "starts": shown.systems(rows["starts"]),
            "late": shown.systems(rows["late"]),
            "processors": shown.processors(rows["processors"]),
        },
        N=N,
        answer=said.answer(results, costs),
        saving=said.saving(costs, *cases[:2]),
        accuracy=said.accuracy(results),
        constant=said.constant(results),
        limit=said.limit(tended, costs),
        start=said.start(results),
        running=said.running(textbook, parts),
        missing=said.missing(forms, parts, patents),
        remainders={
            cycle: {kind: signed(number) for kind, number in patent.comparison(cycle).remainder.items()}
            for cycle in patent.CYCLES
        },
        observations=[formula_text(observation.text) for observation in patent.observations() if observation.holds],
        gantt=said.gantt(on_patents),
        logic_factors=[row[1] for row in rows["logic"][1:3]],
        forms=said.forms(own, forms, patents),
    )
    return {
        **pages,
        **files(figures),
        **{f"{name}.csv": csv_bytes(table) for name, table in {**rows, **others}.items()},
    }
