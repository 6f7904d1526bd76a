"""Public names of a package that are imported when they are first asked for, so that the package is there at once."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def lazily(package: str, names: Mapping[str, str]) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """`__getattr__` and `__dir__` of the package. names: by the module that they are in; of a package, its modules."""
    homes = {name: module for module, several in names.items() for name in several.split()}

    def public(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"{package} has no public name {name!r}: there are {', '.join(sorted(homes))}")
        home = vars(import_module(homes[name]))
        value = home[name] if name in home else import_module(f"{homes[name]}.{name}")
        setattr(sys.modules[package], name, value)
        return value

    return public, lambda: sorted({*vars(sys.modules[package]), *homes})
