"""The report on the multirate gain."""
