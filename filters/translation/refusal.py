"""What cannot be translated, and where it stands."""

from __future__ import annotations


class Untranslatable(ValueError):  # noqa: N818 - what it is, not that it is an error
    """file:line: the construct: why, and what to write instead."""
