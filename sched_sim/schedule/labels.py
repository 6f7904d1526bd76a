"""The labels of the work that schedules are made of, and what they mean."""

from __future__ import annotations

from collections.abc import Mapping

MEANINGS: Mapping[str, str] = {
    "P": "propagate",
    "U": "update",
    "G": "gain and covariance",
    "R": "replayed steps",
    "ST": "start",
    "CA": "carry",
    "LA": "land",
    "HRP": "high-rate propagate",
    "HRU": "high-rate update",
    "LRP": "low-rate propagate",
    "LRG": "gain, precomputed",
    "LRU": "low-rate update",
    "SU": "state update",
    "CG": "covariance and gain",
    "OC": "output correction",
    "IP": "inertial propagation",
    "RS": "robust step",
    "PR": "predict",
    "CO": "correct",
    "RP": "replayed steps",
    "CU": "catch-up",
    "switch": "context switch",
}
