"""Ratios of two things measured in one run; `make bench` prints them beside what they should be."""
