"""The report on what late measurements cost at the output."""
