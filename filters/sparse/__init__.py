"""Filters whose products leave out what is always zero or one.

structure        which entries of F, H, Q and R are so, and what that says of their products
found            what the matrices of a linear system say of it, and what probing a model at many states does
symbols          numbers that remember what was done with them
straight_line    a kernel run on such numbers, written out again as Python without what makes no difference
writing          how that is written
form             a covariance form for a structure, each of its functions from that of the dense form
"""

ALLOCATION_FREE = OPTIMISED_ALONE = True
