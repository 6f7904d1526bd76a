"""The examples around the two tasks: threads of POSIX, and tasks of FreeRTOS."""

from __future__ import annotations

from collections.abc import Iterable

from filters.system import System
from studies.board.assembled import USUAL
from studies.board.template import filled


def posix_c(system: System, several: bool) -> str:
    """Two threads on the record. several: measurements may be on their way at once."""
    return filled(
        "posix.c",
        {
            "u": "record_u[j - 1]" if system.inputs else "",
            **_awaited(several, "j + DELAY_STEPS", 16),
            "tolerance": USUAL,
        },
    )


def freertos_c(system: System, stacks: Iterable[int], several: bool) -> str:
    """The example for FreeRTOS, with room for the deepest call. stacks: of the functions of tasks.c in bytes; nothing
    where they are not known."""
    m, deepest = system.inputs, max(stacks, default=None)
    return filled(
        "freertos.c",
        {
            "n": system.states,
            "p": system.measurements,
            "u": "u" if m else "",
            "read_u": f"/* The input u of the step that begins. */\nextern void read_inputs(real u[{m}]);\n\n"
            if m
            else "",
            "read_call": f"        real u[{m}];\n        read_inputs(u);\n" if m else "",
            "stack_words": 256 + 8 * (-(-deepest // 32)) if deepest is not None else 1024,
            "stack_words_are": "what the deepest call takes and some for FreeRTOS itself"
            if deepest is not None
            else "a guess: no arm-none-eabi-gcc, which says what a call takes, was found when this was written",
            **_awaited(several, "j + 1 + DELAY_STEPS", 12),
            **_notifications(several),
        },
    )


def _awaited(several: bool, m: str, indent: int) -> dict[str, str]:
    """How HR knows when a measurement arrives. m: the step in which one does that is taken now. indent: of the line."""
    at = " " * indent
    if several:
        return {
            "awaited": "    int arrives[SLOTS] = {DELAY_STEPS}; /* the steps m of measurements on their way */\n"
            "    int first = 0;\n"
            "    int count = 1;\n",
            "await": f"{at}arrives[(first + count) % SLOTS] = {m};\n{at}count++;\n",
            "arrives": "count > 0 && j == arrives[first]",
            "arrived": "            first = (first + 1) % SLOTS;\n            count--;\n",
        }
    return {
        "awaited": "    int arrives = DELAY_STEPS; /* the step m of the measurement that is awaited */\n",
        "await": f"{at}arrives = {m};\n",
        "arrives": "j == arrives",
        "arrived": "",
    }


def _notifications(several: bool) -> dict[str, str]:
    """How LR is told of k and of m: with several on their way by two notifications."""
    if several:
        return {
            "notifications": "#define AT_K 0u /* notifications of LR: configTASK_NOTIFICATION_ARRAY_ENTRIES is 2 */\n"
            "#define AT_M 1u\n",
            **{f"give_at_{at}": f"xTaskNotifyGiveIndexed(lr_handle, AT_{at.upper()})" for at in "km"},
            **{f"take_at_{at}": f"ulTaskNotifyTakeIndexed(AT_{at.upper()}, pdFALSE, portMAX_DELAY)" for at in "km"},
        }
    return {
        "notifications": "",
        **{f"give_at_{at}": "xTaskNotifyGive(lr_handle)" for at in "km"},
        **{f"take_at_{at}": "ulTaskNotifyTake(pdFALSE, portMAX_DELAY)" for at in "km"},
    }
