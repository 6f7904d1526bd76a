"""Docstrings are plain text: here they become reStructuredText, and what they say of an argument its description."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from operator import itemgetter
from typing import Any

from docutils import nodes
from sphinx.addnodes import desc_addname, desc_parameter, desc_signature

NAME = r"(\w+)(\([^)]*\)| \([^)]*\))?"  # of an argument, perhaps with how it is called, f(x), or its shape, P0 (n, n)
ITEM = re.compile(rf"(?:^|(?<=[;.] ))({NAME}(?:, {NAME})*): |^(\w+)\([^)]*\) (?=\w)", re.MULTILINE)
FLOATS = r"~?numpy\.ndarray\[tuple\[~?typing\.Any, \.\.\.\], ~?numpy\.dtype\[~?numpy\.float64\]\]"
UNSAID = re.compile(r"<[^<>]*>|lambda \w*: [^,)]+")
"""Default values that are no Python that one could write."""

RAISES = re.compile(r"^Raises:\n((?: {4}.*\n?)+)", re.MULTILINE)


def markup(text: str) -> str:
    """Plain text, with code between single backquotes."""
    return re.sub(r"`([^`]+)`", r"``\1``", re.sub(r"([*|\\]|_\b)", r"\\\1", text))


def described(paragraph: str, arguments: set[str]) -> Iterator[str]:
    """The paragraph, and a field for each argument that it describes; code if it is indented."""
    if paragraph.startswith("    "):
        yield f".. code-block:: python\n\n{paragraph}"
        return
    items = [item for item in ITEM.finditer(paragraph) if arguments.issuperset(names(item))]
    ends = [*(item.start() for item in items), len(paragraph)]
    yield markup(sentence(paragraph[: ends[0]]))
    for item, end in zip(items, ends[1:], strict=True):
        words = markup(sentence(paragraph[item.end() : end]))
        for name, behind in names(item).items():
            shape = f"{markup(behind.strip())}; " if behind.startswith(" ") else ""
            call = f"``{name}{behind}``{':' if item[1] else ''} " if behind and not shape else ""
            yield f":param {name}: {shape or call}{words}"


def names(item: re.Match[str]) -> dict[str, str]:
    """The arguments that an item is about, each with what is in parentheses behind it."""
    return dict(re.findall(NAME, item[1] or item[0]))


def sentence(text: str) -> str:
    return re.sub(r";$", ".", " ".join(text.split()))


def raises(text: str) -> str:
    """`Raises:` with a list below it, as sentences."""
    return RAISES.sub(lambda found: "Raises " + re.sub(r"\n? {4}(?=\w+: )", "\n\nRaises ", found[1])[9:], text)


def as_text(_app: Any, what: str, _name: str, documented: Any, _options: Any, lines: list[str]) -> None:
    text = re.sub(r"\n(?=Raises )", "\n\n", raises("\n".join(lines)))
    if what == "module":
        text = text.partition("\n\n")[0]
    try:
        arguments = set(inspect.signature(documented).parameters)
    except (TypeError, ValueError):
        arguments = set()
    parts = [part for paragraph in text.split("\n\n") for part in described(paragraph, arguments)]
    lines[:] = "\n\n".join(parts).split("\n")


def is_no_alias(_app: Any, _what: str, _name: str, member: Any, _skip: bool, _options: Any) -> bool | None:
    """Fields of named tuples say nothing of themselves."""
    return True if (getattr(member, "__doc__", None) or "").startswith("Alias for field number") else None


def types_as_written(app: Any, *_described: Any) -> None:
    """Names of types that stand for longer ones stay names."""
    for types in app.env.current_document.autodoc_annotations.values():
        for name, words in types.items():
            types[name] = re.sub(FLOATS, "FloatArray", re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", words))


def defaults_to_read(_app: Any, *described: Any) -> tuple[str | None, str | None]:
    """A default that only the code can write is an ellipsis."""
    *_, arguments, returned = described
    return UNSAID.sub("...", arguments) if arguments else arguments, returned


def in_order(_app: Any, domain: str, _kind: str, content: Any) -> None:
    """Arguments are listed as they are passed, those with words and those with a type alone."""
    signature = next(content.parent.findall(desc_signature)) if domain == "py" else nodes.Text("")
    names = [re.findall(r"\w+", argument.astext())[:1] for argument in signature.findall(desc_parameter)]
    for fields in content.findall(nodes.field_list):
        about = [(re.findall(r"\w+", field[0].astext()), field) for field in fields]
        ours = [(names.index(words[1:]), field) for words, field in about if words[1:] in names]
        for _, field in ours:
            fields.remove(field)
        fields[:0] = [field for _, field in sorted(ours, key=itemgetter(0))]


def with_dashes(_app: Any, doctree: nodes.document) -> None:
    """Between an argument and what is said of it Sphinx writes two hyphens."""
    for field in doctree.findall(nodes.field_body):
        for text in list(field.findall(nodes.Text)):
            if text == " -- ":
                text.parent.replace(text, nodes.Text(" \N{EN DASH} "))


def without_room(app: Any, domain: str, _kind: str, content: Any) -> None:
    """What is no public name of its package is shown without the module in which it happens to be."""
    for signature in content.parent.findall(desc_signature) if domain == "py" else ():
        if signature["module"] not in app.env.domains.python_domain.modules:
            for module in list(signature.findall(desc_addname)):
                signature.remove(module)


def to_public(app: Any, env: Any, reference: Any, words: Any) -> Any:
    """A type is linked to the public name that it has in the nearest package above its module."""
    package, _, name = reference["reftarget"].rpartition(".")
    python = env.domains.python_domain
    while package := package.rpartition(".")[0]:
        public = f"{package}.{name}"
        if public in python.objects:
            return python.resolve_xref(env, reference["refdoc"], app.builder, "class", public, reference, words)
    return None


def setup(app: Any) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", as_text)
    app.connect("autodoc-skip-member", is_no_alias)
    app.connect("object-description-transform", types_as_written, priority=400)  # autodoc's own comes after
    app.connect("object-description-transform", without_room)
    app.connect("object-description-transform", in_order, priority=600)  # and comes before this
    app.connect("autodoc-process-signature", defaults_to_read)
    app.connect("doctree-read", with_dashes)
    app.connect("missing-reference", to_public)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
