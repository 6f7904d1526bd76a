"""The compiled engine: a filter and tasks on the simulated processor, in whole numbers and machine code."""
