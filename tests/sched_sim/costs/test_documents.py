"""A file of costs given where the other kind is needed."""

from __future__ import annotations

from pathlib import Path

import pytest

from sched_sim.costs.table_file import TABLES
from tests.command_line import Run, is_refused

HEAD = 'name = "c"\nunit = "operation"\n'
COUNTED = HEAD + "[operations]\npredict = { multiply = 202 }\n[operations.correct]\ngps = { add = 3 }\n"
TIMED = HEAD + "[samples]\npredict = [1.0, 2.0]\n"
TABLE = HEAD + "[operations.larsen]\nupdate = { add = 3 }\n"


@pytest.mark.parametrize("text", [COUNTED, TIMED])
def test_samples_are_no_cost_table(sched_sim: Run, tmp_path: Path, text: str) -> None:
    (tmp_path / "samples.toml").write_text(text, encoding="utf-8")
    result = sched_sim("minimum -N 10 -M 4 --costs samples.toml")
    is_refused(result, ["cost table 'samples.toml' is a samples file", "simulate --scenario FILE`", "[costs.METHOD]"])


@pytest.mark.parametrize("text", [TABLE, (TABLES / "counted-9-3-3.toml").read_text(encoding="utf-8")])
def test_a_cost_table_is_no_file_of_samples(sched_sim: Run, tmp_path: Path, text: str) -> None:
    (tmp_path / "table.toml").write_text(text, encoding="utf-8")
    (tmp_path / "s.toml").write_text(
        'name = "s"\nspeed = 10\nsteps = 40\ncosts = "table.toml"\n[[sensor]]\nname = "gps"\nevery = 10\n'
        "priority = 10\n",
        encoding="utf-8",
    )
    result = sched_sim("simulate --scenario s.toml")
    is_refused(result, ["table.toml' is a cost table, of methods", "--costs of `minimum`", "measure --filter` writes"])
