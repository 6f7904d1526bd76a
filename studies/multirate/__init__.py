"""The multirate gain: the example of the patent, and what a rare gain costs in accuracy."""
