"""The one error that is the user's to mend."""


class InputError(ValueError):
    """Something the user gave cannot be used: the message names it, its value and the remedy."""
