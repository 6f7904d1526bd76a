"""The core that the threads run on, and the right to real-time priorities there."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

from sched_sim.errors import InputError, option

HIGH, LOW = 20, 10
"""Priorities of HR and LR."""


def check_rights() -> None:
    """Raises InputError where this process may have no SCHED_FIFO thread, with what to do."""
    if not hasattr(os, "sched_setscheduler") or not hasattr(os, "sched_getaffinity"):
        raise InputError("live needs Linux, for its SCHED_FIFO threads: run it there, or simulate")
    with ThreadPoolExecutor(1) as thread:
        refused = thread.submit(_refused).result()
    if refused:
        raise InputError(
            f"live needs the right to real-time priorities, which the kernel refuses ({refused}): run it as root, or "
            f"with CAP_SYS_NICE, or raise the limit, `ulimit -r {HIGH}` (rtprio in /etc/security/limits.conf); a "
            f"container needs --cap-add SYS_NICE"
        )


def _refused() -> str:
    """Why this thread, which ends then, may not have such a priority; empty if it may."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(HIGH))
    except OSError as error:
        return error.strerror or str(error)
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    return ""


def chosen_core(cpu: int | None) -> int:
    """The core, from 0; by default the last that this process may use. Raises InputError for another."""
    cores = sorted(os.sched_getaffinity(0))
    if cpu is None:
        return cores[-1]
    if cpu not in cores:
        raise InputError(f"{option('cpu')} {cpu} is no core that this process may use: give one of {_words(cores)}")
    return cpu


def _words(cores: list[int]) -> str:
    return ", ".join(map(str, cores))
