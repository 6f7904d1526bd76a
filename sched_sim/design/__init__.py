"""One filter design: its timing, options and jobs, least speed in closed form and by simulation, whether it fits."""
