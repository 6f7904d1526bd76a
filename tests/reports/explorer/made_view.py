"""Views made up for tests of the page: of the shape that it is given, and different for each query."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil, floor
from typing import Any
from urllib.parse import parse_qsl, urlencode

START = {"hr_hz": "400", "measurement_hz": "5", "delay_ms": "110", "model": "ins-gps"}
OPTIONS = {
    "lr_propagate_by": ["m", "l"],
    "feedback": ["next-step", "same-step"],
    "gain": ["at-update", "precomputed"],
    "low_rate_noise": ["exact", "sum", "euler"],
    "cpus": [1, 2],
    "policy": ["fixed", "edf"],
}
METHODS = {"recalculate": 40.0, "dual-rate": 1.0, "clone": 2.0}
PARTS = {"rp2040": ("RP2040 at 133 MHz", 0.2), "cortex-m4f": ("Arm Cortex-M4F at 168 MHz", 1.0)}
OUTPUTS = [{"name": "position", "unit": "m"}, {"name": "attitude", "unit": "rad"}]


class RefusedError(ValueError):
    """What a server answers with 422."""


def made_view(query: str) -> dict[str, Any]:
    """The view of a query. Raises RefusedError for a landing before the measurement arrives, and for an unknown key."""
    given = dict(parse_qsl(query)) or START
    design = _design(given)
    N, M, L = design["N"], design["M"], design["L"]
    period_ms = None if design["hr_hz"] is None else 1000 / float(Fraction(design["hr_hz"]))
    methods = [_method(name, work, design, given) for name, work in METHODS.items()]
    cannot = {
        **dict.fromkeys(methods[0]),
        "method": "augmentation",
        "reason": "no memory of so many steps",
        "query": "",
    }
    now = next(row for row in methods if row["method"] == design["method"])
    misses = 1 if design["speed"] is not None and float(design["speed"]) < now["power"] else 0
    return {
        "query": urlencode(given, safe="/"),
        "design": design,
        "choices": {
            "method": list(METHODS),
            "costs": ["steffes2014", "counted-9-3-3"],
            "processor": [{"name": name, "title": title} for name, (title, _) in PARTS.items()],
            "model": [{"name": "ins-gps", "title": "inertial navigation with GPS", "outputs": OUTPUTS}],
            "metric": ["worst", "rms"],
            "statistic": ["minimum", "median", "p95"],
            **OPTIONS,
        },
        "limits": {
            "N": [(L if "L" in given else M) + 1, 2000], "M": [0, (L if "L" in given else N) - 1], "L": [M + 1, N],
        },
        "period_ms": period_ms,
        "power": {"unit": "standard steps per HR period", "short": "speed"},
        "answer": {
            "sentence": f"{design['method']} lands by step {L} of {N} with speed {now['power']:.3g}",
            "state": "misses" if misses else "holds",
        },
        "warnings": [f"lands at {M + 1} of the {L} you allow"] if L > M + 1 else [],
        "notes": [f"{N} steps from one measurement to the next", "costs: made up"],
        "current": {
            "least": _quantity(now["power"]), "power": now["power"], "binding": "LR update, m to l",
            "speed": _quantity(now["power"]), "runs_at": "least speed", "pace": now["power"], "achieved_l": L,
            "landed_ms": None if period_ms is None else L * period_ms, "std": now["std"], "std_at_L": now["std"],
            "unit": "m" if design["model"] else None, "load": _quantity(0.8), "misses": misses, "fits": None,
        },
        "schedule": _schedule(N, M, L, period_ms),
        "methods": [*methods, cannot],
        "parts": [] if period_ms is None else [_part(name, given) for name in PARTS],
        "commands": {"shell": f"sched-sim minimum -N {N} -M {M}", "python": f"N = {N}\nM = {M}\nL = {L}"},
    }  # fmt: skip


def _design(given: Mapping[str, str]) -> dict[str, Any]:
    known = ["N", "M", "L", "hr_hz", "measurement_hz", "delay_ms", "land_within_ms", "method", "costs", "statistic",
             "processor", "speed", "model", "output", "within", "metric", "cycles", "context_switch",
             *OPTIONS]  # fmt: skip
    for key in given:
        if key not in known:
            raise RefusedError(f"the query's key '{key}' is unknown: choose from {', '.join(known)}")
    try:
        numbers = {
            key: Fraction(given[key])
            for key in ("hr_hz", "measurement_hz", "delay_ms", "land_within_ms")
            if key in given
        }
    except ValueError:
        raise RefusedError("hr_hz is no number: give a finite number such as 400") from None
    hr = numbers.get("hr_hz", Fraction(1))
    N = int(given.get("N") or floor(hr / numbers.get("measurement_hz", Fraction(1))))
    M = int(given.get("M") or ceil(numbers.get("delay_ms", Fraction(0)) * hr / 1000))
    L = int(given.get("L") or floor(numbers.get("land_within_ms", N * 1000 / hr) * hr / 1000))
    if M > 3 * N:
        raise RefusedError("delay_ms is longer than measurement_hz allows: see `sched-sim minimum delay_ms`")
    if not M < L <= N:
        raise RefusedError(
            f"L={L} must be > M={M} and at most N={N}: the correction cannot land before the measurement arrives"
        )
    return {
        **dict.fromkeys(known),
        "method": "dual-rate", "statistic": "minimum", "metric": "worst", "cycles": 1, "context_switch": "0",
        **{key: values[0] for key, values in OPTIONS.items()},
        "output": "position" if "model" in given else None,
        **given, "N": N, "M": M, "L": L, "cpus": int(given.get("cpus", 1)),
    }  # fmt: skip


def _method(name: str, work: float, design: Mapping[str, Any], given: Mapping[str, str]) -> dict[str, Any]:
    N, M, L = design["N"], design["M"], design["L"]
    steps = list(range(M + 1, N + 1))
    power = {step: work * (0.6 + 1 / (step - M)) for step in steps}
    std = {step: 0.36 + 0.0003 * step for step in steps} if design["model"] else {}
    row = {
        "method": name, "reason": "", "query": urlencode({**given, "method": name}), "L": L,
        "least": _quantity(power[L]), "power": power[L], "binding": "LR update, m to l", "achieved_l": L,
        "landed_ms": None, "std": std.get(L), "fits": None, "within": None,
        "staircase": {"L": steps, "power": list(power.values()), "achieved": steps},
        "landing": {"power": sorted(power.values()), "L": steps[::-1]},
        "accuracy": {"L": list(std), "std": list(std.values())} if std else None,
        "front": {"L": steps, "power": list(power.values()), "std": list(std.values())} if std else None,
    }  # fmt: skip
    if design["within"] is not None and std:
        kept = [step for step in steps if std[step] <= float(design["within"])]
        row["within"] = {
            "L": max(kept), "std": std[max(kept)], "least": _quantity(power[max(kept)]), "power": power[max(kept)],
            "part": "rp2040", "needed": _quantity(0.4), "landed": M + 1, "landed_std": std[M + 1], "reason": "",
            "query": urlencode({**given, "method": name, "L": max(kept), "processor": "rp2040"}),
        } if kept else {
            "L": None, "std": None, "least": None, "power": None, "part": None, "needed": None, "landed": None,
            "landed_std": None, "reason": f"{min(std.values()):.3g} m at best", "query": row["query"],
        }  # fmt: skip
    return row


def _part(name: str, given: Mapping[str, str]) -> dict[str, Any]:
    title, speed = PARTS[name]
    return {
        "name": name, "title": title, "fits": True, "needed": _quantity(0.1 / speed), "load": _quantity(0.08 / speed),
        "landed": 45, "landed_ms": 112.5, "std": 0.373, "price": 1.0, "reason": "",
        "query": urlencode({**given, "processor": name}),
    }  # fmt: skip


def _schedule(N: int, M: int, L: int, period_ms: float | None) -> dict[str, Any]:
    steps = list(range(min(N, 2000)))
    jobs = {
        "row": [0] * len(steps) + [1], "kind": ["HR propagate"] * len(steps) + ["LR update"], "step": [*steps, M],
        "release": [*steps, M], "start": [*steps, M + 0.5], "finish": [step + 0.5 for step in steps] + [L - 0.1],
        "deadline": [step + 1 for step in steps] + [L], "missed": [False] * (len(steps) + 1),
        "preemptions": [0] * len(steps) + [L - M - 1],
    }  # fmt: skip
    pieces = range(M, L)
    bars = {
        "row": [0] * len(steps) + [1] * len(pieces), "style": [0] * len(steps) + [1] * len(pieces),
        "start": [*steps, *(step + 0.5 for step in pieces)],
        "end": [*(step + 0.5 for step in steps), *(step + 0.9 for step in pieces)],
        "job": [*steps, *[len(steps)] * len(pieces)],
    }  # fmt: skip
    return {
        "steps": N, "period_ms": period_ms, "cut": "", "rows": [{"name": "HR", "cpu": 0}, {"name": "LR", "cpu": 0}],
        "styles": [{"label": "HRP", "meaning": "high-rate propagate"}, {"label": "LRU", "meaning": "low-rate update"}],
        "jobs": jobs, "bars": bars,
        "marks": [{"step": 0, "label": "k", "meaning": "measurement taken"},
                  {"step": M, "label": "m", "meaning": "measurement arrives"},
                  {"step": L, "label": "l", "meaning": "correction landed"}],
        "misses": 0, "busy": 0.8,
    }  # fmt: skip


def _quantity(value: float) -> dict[str, Any]:
    return {"value": value, "exact": str(Fraction(value).limit_denominator(10_000))}
