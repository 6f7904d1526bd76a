"""What the numbers of a plan, and of a job, stand for."""

from __future__ import annotations

HR_JOB, HR_UPDATE, LR_GAIN, LR_PROPAGATE, LR_STEP, LR_UPDATE, FIRST_TASK = range(7)
"""Kinds of job, in the order of their names; then the tasks, in that of theirs."""

(NOTHING, LANDS, SENDS, MEASURED, RELEASES_LOW, LOW_DONE, PROPAGATED, FREES, UPDATED, FED_BACK, REPLAYED) = range(11)
"""What it means that a job has finished."""
