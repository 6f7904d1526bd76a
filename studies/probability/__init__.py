"""How often deadlines are missed by random costs: exact, and what finite samples leave open."""
