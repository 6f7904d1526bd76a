"""The report on counts, emulated cores, times here and published timings side by side."""
