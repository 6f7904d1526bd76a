"""Figures of a scenario."""
