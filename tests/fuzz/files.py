"""Files that a user might write: one good one of each kind, as the values in it, and the TOML that they make."""

from __future__ import annotations

import json
from typing import Any, NamedTuple


class Raw(NamedTuple):
    """A value as it stands in the file."""

    text: str


Document = dict[str, Any]

COSTS: Document = {
    "name": "mine",
    "unit": "ms",
    "costs": {
        "standard": {"propagate": 0.45, "update": 0.55},
        "recalculate": {"propagate": 0.45, "update": 0.56, "replay": 0.45},
        "larsen": {"propagate": 0.21, "propagate_accumulate": 0.3, "update": {"minimum": 0.4, "median": 1, "p95": 2}},
        "dual-rate": {
            "hr_propagate": 0.29,
            "hr_restart": 0.02,
            "hr_update": 0.02,
            "lr_propagate": 0.2,
            "lr_update": 0.26,
            "lr_gain": 0.1,
            "lr_correct": 0.2,
        },
    },
}
COUNTS: Document = {
    "name": "counts",
    "unit": "operation",
    "operations": {
        "standard": {"propagate": {"multiply": 90, "add": 80}, "update": {"multiply": 50, "add": 40, "divide": 3}},
        "larsen": {
            "propagate": {"multiply": 100, "add": 90},
            "propagate_accumulate": {"multiply": 200, "add": 180, "logic": 300},
            "update": {"multiply": 270, "add": 240, "sqrt": 2, "function": 1},
        },
    },
}
PART: Document = {
    "name": "mypart",
    "title": "my board at 200 MHz",
    "precision": "double",
    "clock_mhz": 200,
    "logic_per_arithmetic": {"value": 2.5, "source": "measured"},
    "cycles": {"multiply": 4, "add": {"cycles": "9/2", "is": "latency", "source": "p. 3"}, "divide": 30, "sqrt": 30,
               "logic": 0.7},
}  # fmt: skip
TASKS: Document = {
    "task": [
        {"name": "control", "period": 2, "cost": 0.1, "priority": 5},
        {"name": "telemetry", "period": 5, "offset": 1, "cost": 0.2, "priority": 30, "cpu": 1},
    ]
}
GRID: Document = {
    "N": "4:5",
    "M": [1, 2],
    "L": [4],
    "speed": ["0.5:1.5:0.5"],
    "method": ["larsen", "dual-rate"],
    "costs": "steffes2014",
    "statistic": "minimum",
    "lr_propagate_by": "m,l",
    "feedback": ["next-step"],
    "gain": "at-update",
    "low_rate_noise": "exact",
    "cpus": [1, 2],
    "context_switch": 0,
    "simulate": False,
    "cycles": 2,
}
GRID_OF_PARTS: Document = {
    "N": 6,
    "M": [1, 2],
    "processor": ["part.toml", "leon3"],
    "hr_hz": ["100:300:100", 400],
    "method": "larsen",
    "tasks": "tasks.toml",
}
SAMPLES: Document = {
    "name": "samples",
    "unit": "second",
    "samples": {"predict": [0.0005, 0.0006], "correct": {"gps": [0.0005], "radio": [0.0003, 0.0004]}},
}
SCENARIO: Document = {
    "name": "rocket",
    "hr_hz": 400,
    "unit": "s",
    "steps": 40,
    "duration_s": 0.1,
    "seed": 1,
    "late": "recalculate",
    "costs": "samples.toml",
    "times_slower": 2,
    "context_switch_us": 10,
    "cpus": 1,
    "predictor": {"priority": 10, "cost": [0.0005, 0.0006]},
    "sensor": [
        {"name": "gps", "every": 8, "delay": {"least": 1, "most": 3}, "dropout": 0.1, "land_by": 9, "priority": 20},
        {"name": "radio", "hz": 30, "offset_ms": 3, "delay_ms": [0, 4], "land_within_ms": 40, "cost_ms": 0.3},
    ],
    "task": [{"name": "control", "period": 2, "cost": 0.0005, "priority": 5}],
}

DOCUMENTS = {
    "costs.toml": COSTS,
    "counts.toml": COUNTS,
    "part.toml": PART,
    "tasks.toml": TASKS,
    "grid.toml": GRID,
    "parts.toml": GRID_OF_PARTS,
    "samples.toml": SAMPLES,
    "scenario.toml": SCENARIO,
}

SYSTEM = {
    "head": "import numpy as np\nfrom filters.system import System",
    "f": "def f(j, x, u, p, out):\n    out[0] = x[0] + 0.01 * x[1]\n    out[1] = x[1] + 0.01 * u[0]",
    "F": "def F(j, x, u, p):\n    return np.array([[1.0, 0.01], [0.0, 1.0]])",
    "h": "def h(k, x, p, out):\n    out[0] = np.sin(x[0])",
    "H": "def H(k, x, p):\n    return np.array([[np.cos(x[0]), 0.0]])",
    "Q": "def Q(j, p):\n    return np.diag(np.array([1e-8, 1e-5]))",
    "R": "def R(k, p):\n    return np.array([[1e-4]])",
    "given": "states, inputs, measurements, x0 = 2, 1, 1, [0.0, 0.0]",
    "made": "def made():\n    return System(states, inputs, measurements, f, F, Q, h, H, R, ()), x0",
}
FILTER = {
    "head": "import numpy as np\nfrom filters.modular import *",
    "f": "def f(x, u, dt, out):\n    out[0] = x[0] + dt * x[1]\n    out[1] = x[1] + dt * u[0]",
    "h": "def h(x, out):\n    out[0] = np.sin(x[0])",
    "Q": "Q = np.diag([1e-6, 1e-6])",
    "R": "R = np.eye(1)",
    "gps": "gps = Sensor('gps', linear_corrector(H=np.eye(1, 2), R=R), every=8, delay=4, dropout=0.1)",
    "radio": "radio = Sensor('radio', extended_corrector(h, R=R), every=2)",
    "start": "start = np.array([0.1, 0.2]), np.eye(2), np.array([0.1])",
    "made": "def made():\n    return ModularFilter(extended_predictor(f, Q=Q), [gps, radio], dt=0.01), *start",
}
MODULES = {"system.py": SYSTEM, "filter.py": FILTER}


def toml(document: Document) -> str:
    return "".join(f"{_key(key)} = {_value(value)}\n" for key, value in document.items())


def python(parts: dict[str, str]) -> str:
    return "\n\n".join(parts.values()) + "\n"


def _key(key: str) -> str:
    return json.dumps(key, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    match value:
        case Raw(text):
            return text
        case dict():
            return "{ " + ", ".join(f"{_key(key)} = {_value(item)}" for key, item in value.items()) + " }"
        case list():
            return f"[{', '.join(map(_value, value))}]"
        case str():
            return _key(value)
        case bool():
            return str(value).lower()
        case _:
            return str(value)
