"""Which filter is accurate enough, and what it needs: accuracy by where corrections land, and power by when."""
