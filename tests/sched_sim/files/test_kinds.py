"""A file of another kind than that which is needed is known for what it is."""

from __future__ import annotations

from itertools import permutations

import pytest

from sched_sim.errors import InputError
from sched_sim.files.kinds import KINDS, refuse_other_kind

DOCUMENTS = {
    "scenario": {"name": "s", "costs": "counts.toml", "sensor": [{}], "task": [{}]},
    "processor": {"name": "p", "clock_mhz": 100, "cycles": {"add": 1}},
    "costs": {"name": "t", "unit": "operation", "operations": {"larsen": {}}},
    "tasks": {"task": [{}]},
}


@pytest.mark.parametrize(("wanted", "given"), [*permutations(KINDS, 2)])
def test_it_is_refused_with_the_argument_that_takes_it(wanted: str, given: str) -> None:
    with pytest.raises(InputError, match=rf"^file: this is {KINDS[given][0]}, and .* needed; give it to {given}$"):
        refuse_other_kind(DOCUMENTS[given], "file", wanted)


@pytest.mark.parametrize("wanted", [*KINDS])
def test_what_is_none_of_them_is_left_to_the_check_of_its_keys(wanted: str) -> None:
    refuse_other_kind(DOCUMENTS[wanted], "file", wanted)
    refuse_other_kind({}, "file", wanted)
    refuse_other_kind({"name": "n"}, "file", wanted)
