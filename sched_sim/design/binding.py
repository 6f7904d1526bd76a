"""Which demand fixes the least speed of a design."""

from __future__ import annotations

from enum import IntEnum


class Binding(IntEnum):
    """Which demand fixes the least speed.

    hr: one HR job; lr_propagate: LR propagate by its deadline, of a delayed horizon all LR work of a cycle; lr_update:
    the LR update between m and l; lr_total: all LR work between k and l; lr_gain: covariance and gain of a multirate
    method by l; lr_step: the robust step by l.
    """

    hr = 0
    lr_propagate = 1
    lr_update = 2
    lr_total = 3
    lr_gain = 4
    lr_step = 5


BINDING_WORDS = {
    "hr": "one HR job",
    "lr_propagate": "LR propagate",
    "lr_update": "LR update, m to l",
    "lr_total": "all LR work, k to l",
    "lr_gain": "covariance and gain",
    "lr_step": "robust step",
}
"""The bindings as a person reads them."""
