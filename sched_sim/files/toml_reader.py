"""Reading the user's TOML files: numbers as exact decimals, every error on one line."""

from __future__ import annotations

import re
import stat
import tomllib
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

from sched_sim.bounds import MOST_BYTES, MOST_DIGITS, check_digits
from sched_sim.errors import InputError

_DEEP = re.compile(r"""(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')\s*+\.\s*+){100}""")
"""A key in a hundred tables, which `tomllib` takes long for."""


def read_toml(path: Path, what: str, remedy: str) -> dict[str, Any]:
    """The document in `path`. what: how messages name the file; remedy: what to do if there is none.

    Raises InputError if the file is not there, is a folder or a device, is too large, cannot be read, is no TOML, or
    holds a number that is out of bounds (`sched_sim.bounds`).
    """
    text = read_text(path, what, remedy)
    too_deep = f"{what} is nested too deep: no table of this program is in more than a few others"
    if _DEEP.search(text):
        raise InputError(too_deep)
    try:
        document = tomllib.loads(text, parse_float=Decimal)
        if problems := list(_out_of_bounds(document, "")):
            raise InputError(f"{what}: {'; '.join(problems)}")
        return document
    except RecursionError:
        raise InputError(too_deep) from None
    except InputError:
        raise
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{what} is not valid TOML: {error}") from None
    except (ValueError, ArithmeticError):
        raise InputError(f"{what} holds a number that is too long: give at most {MOST_DIGITS} digits") from None


def read_text(path: Path, what: str, remedy: str) -> str:
    """Text of a regular file: a device or a pipe may have no end. Some editors begin one with a byte order mark."""
    try:
        about = path.stat()
        if not stat.S_ISREG(about.st_mode):
            problem = "is a folder, not a file" if stat.S_ISDIR(about.st_mode) else "is no regular file"
            raise InputError(f"{what} {problem}: {remedy}")
        if about.st_size > MOST_BYTES:
            raise InputError(f"{what} has {about.st_size:,} bytes: at most {MOST_BYTES:,} are read; give a smaller one")
        with path.open("rb") as file:
            return file.read(MOST_BYTES).decode("utf-8-sig")
    except InputError:
        raise
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(f"{what} not found: {remedy}") from None
    except OSError as error:
        raise InputError(f"{what} cannot be read: {error.strerror}; {remedy}") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{what} cannot be read: {error}; save it as UTF-8") from None
    except ValueError:  # a name with a null character
        raise InputError(f"{what} is no name of a file: {remedy}") from None


def _out_of_bounds(value: Any, where: str) -> Iterator[str]:
    """What to say of the numbers in a document that are too long to be computed with."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _out_of_bounds(item, f"{where}.{key}" if where else key)
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _out_of_bounds(item, f"{where}.{number}")
    elif isinstance(value, int | Decimal) and not isinstance(value, bool):
        try:
            check_digits(value, where)
        except InputError as error:
            yield str(error)
