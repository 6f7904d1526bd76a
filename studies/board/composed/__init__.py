"""A composed filter, of several sensors, step by step: back to where a late measurement was taken, and on from there.

wanted   which is to be written
memory   its arrays
record   a record of data, and its run on it
files    all files
"""
