"""Gantt charts of schedules."""
