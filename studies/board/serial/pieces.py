"""Lines of C that several methods have."""

from __future__ import annotations


def kept_input(inputs: int, place: str, indent: str = "    ") -> str:
    """The input u in a place of its own; nothing for a model without inputs."""
    if not inputs:
        return ""
    return f"{indent}for (int i = 0; i < {inputs}; i++) {{\n{indent}    {place}[i] = u[i];\n{indent}}}\n"
