"""The extended robust filter: costs, counts, the drive, singular values."""
