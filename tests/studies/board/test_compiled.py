"""The deepest stack, from the frames of functions and who calls whom."""

from __future__ import annotations

from filters.registry import ALL_METHODS
from filters.systems.example import example_system
from studies.board.compiled import stack_of
from studies.board.jobs import translated


def test_the_deepest_chain_of_calls() -> None:
    jobs = ALL_METHODS["dual-rate"].jobs(example_system(3, 1, 2))
    in_c = translated({"lr_propagate": jobs["lr_propagate"]}, "double")
    functions = in_c.unit.functions()
    assert list(functions) == [
        "matmul_3",
        "transpose_3",
        "matmul_transposed_3",
        "add_3",
        "mirror_3",
        "propagation_3",
        "lr_propagate",
    ]
    frames = {"lr_propagate": 8, "propagation_3": 16, "add_3": 100, "matmul_transposed_3": 64, "transpose_3": 40}
    assert stack_of(in_c.by_kind["lr_propagate"], functions, frames) == 8 + 16 + 64 + 40
    assert stack_of(in_c.by_kind["lr_propagate"], functions, {**frames, "add_3": 200}) == 8 + 16 + 200
