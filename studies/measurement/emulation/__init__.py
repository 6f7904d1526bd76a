"""What jobs take on a board's core, emulated: translated to C, cross-compiled, run by QEMU.

targets.TARGETS                 the cores
jobs.emulate(jobs, ...)         instructions and stack of each job
memory.memory_of(method, ...)   code and RAM of its tasks
table.emulated_table(...)       the cost table

Instructions, not cycles: the emulator has no pipeline, no caches and no wait states.
"""
