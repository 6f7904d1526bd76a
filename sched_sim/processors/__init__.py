"""Processors by their data sheets."""
