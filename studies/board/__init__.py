"""A filter as a folder of C for a board: `sched-sim code`.

jobs        its jobs in C, see `filters.translation`, and how they are called
memory      the arrays of a task, and the records that point at them
dual_rate   the dual rate filter as two tasks, with the messages between them; in_flight: with several corrections on
            their way; examples: for POSIX and FreeRTOS
serial      methods that do all in the HR step, step by step
robust      the extended robust filter, step by step
composed    filters of several sensors, step by step
write       all files of a method; assembled: of any filter
bits        a program that compares what jobs and runs give with what Python gave
compiled    code and stack in bytes, where a cross compiler is installed
readme      what to do with the folder
folder      the folder itself
"""
