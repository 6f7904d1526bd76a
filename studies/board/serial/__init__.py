"""Methods that do all in the HR step: a function for it, one for a measurement that arrives, and their memory.

method        what is to be known of one
at_once, recalculate, larsen, cloning, carried_gain, horizon, augmentation, multirate: what is known
methods       all of them, and which steps each can have
files         steps.h, steps.c and state.h
"""
