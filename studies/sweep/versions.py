"""What processes that share a sweep must have in common, so that its rows do not depend on who computes them."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

PACKAGES = ("numpy", "scipy", "numba", "distributed", "sched-sim")

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("filters", "sched_sim", "studies")

DIGEST = "sched-sim's source, by digest,"

REMEDY = "install the same Python, packages and sched-sim there as here"


@cache
def versions() -> Mapping[str, str]:
    """By name: of Python, of the packages, and the digest of this source (SHA-256, its first 12 hexadecimal digits)."""
    return {"Python": platform.python_version(), **{name: _version(name) for name in PACKAGES}, DIGEST: _digest()}


def refusal(theirs: Mapping[str, str] | Exception, ours: Mapping[str, str]) -> str:
    """What to say of a process that has those versions, or of one that failed to tell; empty if they are these."""
    if isinstance(theirs, Exception):
        return f"cannot run this sched-sim ({theirs}): {REMEDY}"
    differ = [name for name in ours if theirs.get(name) != ours[name]]
    if not differ:
        return ""
    told = "; ".join(f"{name} is {theirs.get(name, 'unknown')} there and {ours[name]} here" for name in differ)
    return f"differs: {told}: {REMEDY}"


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "missing"


def _digest() -> str:
    found = sha256()
    for file in sorted(file for name in SOURCES for file in (ROOT / name).rglob("*.py")):
        found.update(f"{file.relative_to(ROOT).as_posix()}\0".encode() + file.read_bytes())
    return found.hexdigest()[:12]
