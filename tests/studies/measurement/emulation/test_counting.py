"""What is counted on an emulated core: known programs, to the instruction."""

from __future__ import annotations

import pytest

from studies.measurement.emulation.jobs import counted
from studies.measurement.emulation.targets import TARGETS
from studies.measurement.emulation.toolchain import run
from tests.boards import needs_board

pytestmark = needs_board

PROGRAM = """
__attribute__((naked)) static void loop(void)
{
    __asm__ volatile("movw r0, #1000\\n 1: subs r0, #1\\n bne 1b\\n bx lr");
}

__attribute__((naked)) static void nothing(void)
{
    __asm__ volatile("bx lr");
}

__attribute__((naked)) static void deep(void)
{
    __asm__ volatile("push {r4, lr}\\n sub sp, #400\\n str r4, [sp]\\n add sp, #400\\n pop {r4, pc}");
}

static const unsigned char bytes[] = {0, 1, 254};
static const Shown shown[] = {{bytes, sizeof bytes}, {bytes + 2, 1}};
const Job jobs[] = {{loop, 0, 0}, {nothing, shown, 2}, {deep, 0, 0}};
const int job_count = 3;
"""
OF_LOOP = 1 + 1000 * 2
"""It sets its counter, then subtracts and branches a thousand times; its return is in the call that is subtracted."""
OF_DEEP = 5 - 1
"""Its return is the last of its five."""


@pytest.mark.parametrize("name", TARGETS)
def test_a_known_loop_is_counted_exactly_and_a_stack_to_the_byte(name: str) -> None:
    counts, shown = counted(run(TARGETS[name], {"jobs.c": PROGRAM}), TARGETS[name])
    own = 8  # of the call itself, kept on the stack that is looked at
    loop, nothing, deep = counts
    assert loop == (OF_LOOP, nothing[1])
    assert nothing[0] == 0
    assert deep == (OF_DEEP, nothing[1] + 400 + own)
    assert shown == [b"", bytes([0, 1, 254, 254]), b""]


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ('FAULT("not positive definite");', "FAULT not positive definite"),
        ("*(volatile int *)0xE0100000 = 1;", "trapped"),
        ("no_such_thing;", "cannot compile.*no_such_thing"),
    ],
)
def test_what_fails_on_the_board_is_said(body: str, said: str) -> None:
    source = f"static void job(void) {{ {body} }}\nconst Job jobs[] = {{{{job, 0, 0}}}};\nconst int job_count = 1;\n"
    with pytest.raises(ValueError, match=said):
        run(TARGETS["cortex-m4f"], {"jobs.c": source})
