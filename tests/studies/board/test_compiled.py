"""The deepest stack, from the frames of functions and who calls whom."""

from __future__ import annotations

from filters.registry import ALL_METHODS
from filters.systems.example import example_system
from studies.board.compiled import stack_of, stacks_of
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


def test_what_is_called_by_others_takes_its_own_frame_too() -> None:
    jobs = ALL_METHODS["dual-rate"].jobs(example_system(3, 1, 2))
    in_c = translated({"lr_propagate": jobs["lr_propagate"]}, "double")
    text = """/* a file (of two functions) */
static void copy(int from[3],
                 int to[3])
{
    for (int i = 0; i < 3; i++) {
        to[i] = from[i];
    }
}

int lr_receive(void)
{
    copy(a, b);
    lr_propagate(a, b);
    return 1;
}

const real *lr_state(void)
{
    return a;
}
"""
    frames = {"lr_receive": 32, "copy": 900, "lr_propagate": 8, "add_3": 100}
    functions = in_c.unit.functions()
    assert stacks_of(text, functions, frames) == {"lr_receive": 932, "lr_state": 0}
    assert stacks_of(text, functions, {**frames, "copy": 4}) == {"lr_receive": 140, "lr_state": 0}
