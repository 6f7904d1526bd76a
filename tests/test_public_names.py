"""Each package gives its public names, when they are asked for and not before; types know the same names."""

from __future__ import annotations

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

PUBLIC = {
    "sched_sim": "Timing Times Options Task read_tasks CostTable load_costs read_costs write_costs Part load_part "
    "on_part select least_speed less_work achieved_l staircase simulate Schedule Slice fit Fit Sensor Scenario "
    "read_scenario run_scenario Outcome rare_misses RareMisses open_trace InputError CostDistribution probabilities "
    "Probabilities",
    "filters": "System Structure linear_system example_system standard recalculate larsen dual_rate delayed_horizon "
    "px4_predictor augmentation fuse_as_fresh clone clone_split carried_gain multirate_gain History "
    "true_covariance modular count Operations accuracy",
    "studies": "Design ScenarioAsked ScenarioView View choose_filter compare_accuracy describe_filter explore "
    "explore_scenario measure measure_filter run_sweep",
    "reports": "Explorer gantt method_panel scenario_panel save",
}


@pytest.mark.parametrize("package", PUBLIC)
def test_the_public_names_are_these(package: str) -> None:
    module = import_module(package)
    assert module.__all__ == sorted(PUBLIC[package].split())
    assert all(getattr(module, name) is not None and name in dir(module) for name in module.__all__)
    with pytest.raises(AttributeError, match=rf"{package} has no public name 'nothing': there are "):
        module.nothing  # noqa: B018


@pytest.mark.parametrize("package", PUBLIC)
def test_types_know_the_same_names(package: str) -> None:
    source = Path(import_module(package).__file__ or "").read_text(encoding="utf-8")
    for_types = next(node for node in ast.parse(source).body if isinstance(node, ast.If))
    known = [alias.name for node in for_types.body if isinstance(node, ast.ImportFrom) for alias in node.names]
    assert sorted(known) == sorted(PUBLIC[package].split())


def test_a_package_is_imported_at_once() -> None:
    code = f"import sys, {', '.join(PUBLIC)}; print(*sorted({{'numpy', 'matplotlib', 'pydantic'}} & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == []
