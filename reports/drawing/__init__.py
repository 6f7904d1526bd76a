"""How figures look: style, axes, legends, placing, and the files they are written to."""
