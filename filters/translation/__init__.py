"""C99 from kernels and jobs: the functions that are costed, translated for the types and shapes of their arguments.

unit.function(job, kinds)       one function and all that it calls, see `unit`
unit.header(), unit.source()    the files

Operations are done in the order of the source, so that the numbers are the same to the last bit where the C compiler
neither reorders nor fuses them (-ffp-contract=off). What is not understood is refused with its file and line.
"""
