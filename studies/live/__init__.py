"""The generated filter on a real kernel, beside what was predicted of it: `sched-sim live`.

design      what is run: a design, a speed, a period, and the CPU time of each job
rights      the core, and the right to real-time priorities
alone       one run at a time on a core
program     the program, from the files of `sched-sim code` and live.c
jobs        what ran when, as the program says
probe       whether the period is one that clock and kernel resolve
landed      where corrections landed, and how late HR woke
taken       core time that something else had, and which cycles that has disturbed
agreement   measured against predicted, in a word
measure     one run, from the design to the word
stairs      several of them, at speeds through two steps of the staircase
slices      what ran as a schedule, as the simulated one is
both        both in one trace
"""
