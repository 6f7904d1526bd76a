"""Scheduling of real-time filter jobs on a simulated preemptive processor; knows nothing of estimation."""
