"""The user's TOML files, as editors write them."""

from __future__ import annotations

from pathlib import Path

import pytest

from sched_sim.errors import InputError
from sched_sim.files.toml_reader import read_toml


def test_a_byte_order_mark_is_no_part_of_the_document(tmp_path: Path) -> None:
    path = tmp_path / "f.toml"
    path.write_bytes(b"\xef\xbb\xbfname = 'gps'\r\n")
    assert read_toml(path, "f", "give one") == {"name": "gps"}


@pytest.mark.parametrize("content", ["name = 'gps'".encode("utf-16"), b"name = '\xff'"])
def test_another_encoding_is_refused_with_the_remedy(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "f.toml"
    path.write_bytes(content)
    with pytest.raises(InputError, match="save it as UTF-8"):
        read_toml(path, "f", "give one")
