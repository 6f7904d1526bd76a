"""Random designs of the explorer, of every method, most of which can be had."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from sched_sim.costs.methods import DELAYED_METHODS, PAPER_METHODS
from sched_sim.design.methods import METHODS
from sched_sim.design.options import Options
from studies.explorer.design import Design

speeds = st.fractions(Fraction(1, 10), 20, max_denominator=20)


@st.composite
def designs_in_steps(draw: st.DrawFn) -> Design:
    """With a closed form, and one measurement on its way."""
    costs = draw(st.sampled_from([None, "counted-9-3-3"]))
    method = draw(st.sampled_from(PAPER_METHODS if costs is None else DELAYED_METHODS))
    gain = "at-update" if costs is None else draw(st.sampled_from(["at-update", "precomputed"]))
    options = Options(
        lr_propagate_by=draw(st.sampled_from(["m", "l"])),
        feedback=draw(st.sampled_from(["next-step", "same-step"])),
        gain=gain,
        cpus=draw(st.sampled_from([1, 2])),
    )
    law = METHODS[method].law(options.feedback)
    beside = law.after + law.before
    N = draw(st.integers(max(beside, 1), 14))
    M = draw(st.integers(0, N - beside))
    L = draw(st.none() | st.integers(M + law.after, N - law.before))
    speed = draw(st.none() | speeds)
    return Design(
        N=N,
        M=M,
        L=L,
        method=method,
        costs=costs,
        options=options,
        speed=None if speed is None else speed * (1 if costs is None else 10_000),
        cycles=draw(st.integers(1, 3)),
    )


@st.composite
def designs_in_time(draw: st.DrawFn) -> Design:
    """Of a shipped model, on a part or not."""
    hr_hz = draw(st.sampled_from([100, 200, "333", 400]))
    delay_ms = draw(st.integers(0, 80))
    return Design(
        hr_hz=hr_hz,
        measurement_hz=draw(st.sampled_from([5, 7, 10])),
        delay_ms=delay_ms,
        land_within_ms=draw(st.none() | st.integers(delay_ms + 11, 99)),
        method=draw(st.sampled_from(["dual-rate", "clone", "delayed-horizon", "recalculate"])),
        model="ins-gps",
        within=draw(st.none() | st.sampled_from(["0.37", "0.38", "0.4"])),
        processor=draw(st.none() | st.sampled_from(["rp2040", "cortex-m4f", "desktop"])),
        metric=draw(st.sampled_from(["worst", "rms"])),
    )
