"""Command lines and their files as users get them wrong: good ones, with a slip or two of the keyboard in them."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from typing import Any, NamedTuple

from hypothesis import strategies as st

from tests.fuzz.files import DOCUMENTS, MODULES, Document, Raw, python, toml
from tests.fuzz.words import BODIES, CODE, FUNCTIONS, HOSTILE_TEXT, INPUTS, NO_FILES, NUMBERS, OUTPUTS, VALUES, WORDS


class Case(NamedTuple):
    """arguments: of `sched-sim`; files: in the folder where it runs, by name."""

    arguments: Sequence[str]
    files: dict[str, bytes]


Options = list[tuple[str, str]]


def options(text: str) -> Options:
    """Pairs of an option and its value, of which those that have one are written -N=6."""
    return [(option, value) for option, _, value in (word.partition("=") for word in text.split())]


DESIGN = options("-N=6 -M=2")
SETTINGS = options(
    "-L=5 --method=larsen --method=dual-rate --method=recalculate --method=standard --costs=costs.toml --statistic=p95 "
    "--costs=counts.toml --costs=counted-9-3-3 --lr-propagate-by=l --feedback=same-step --gain=precomputed --cpus=2 "
    "--low-rate-noise=euler --processor=part.toml --processor=cortex-m4f --context-switch=0.01 --tasks=tasks.toml "
    "--hr-hz=400 --speed=1.5 --cycles=2 --format=json --format=csv"
)
TRACES = options("--trace=out.json --trace=out.csv")
FORMATS = options("--format=json --format=csv")
ACCURACY = options(
    "-N=6 -M=2 --output=position --output=0:1 --output=0,2 --unit=m --metric=rms --motion=1 --tau=0.1 --every=1:2 "
    "--measurement-hz=20 --delay-ms=30"
)
COUNTED = "measure --backend counted"
COMMANDS: dict[str, tuple[Options, Options]] = {
    "minimum": (DESIGN, SETTINGS),
    "simulate": ([*DESIGN, ("--speed", "2")], [*SETTINGS, *TRACES]),
    "simulate --scenario scenario.toml": ([], [*FORMATS, *TRACES]),
    "processors": ([], [*DESIGN, *SETTINGS]),
    "sweep": (
        options("-N=4 --results=out.sqlite"),
        [*options("-M=1,2 --simulate --export=out.csv --export=out.parquet --results=other.sqlite"), *SETTINGS],
    ),
    "sweep grid.toml": (options("--results=out.sqlite"), [*options("-N=4 --export=out.csv"), *SETTINGS]),
    "sweep parts.toml": (options("--results=out.sqlite"), [*options("--simulate --export=out.csv"), *SETTINGS]),
    COUNTED: (
        options("--states=2 --inputs=1 --measurements=1 --method=larsen"),
        [*options("--update=joseph --output=out.toml --robust=attitude --parallel=4 --thorough"), *FORMATS],
    ),
    f"{COUNTED} --system system:made": (options("--method=larsen"), [*options("--output=out.toml"), *FORMATS]),
    f"{COUNTED} --filter filter:made": ([], [*options("--output=out.toml"), *FORMATS]),
    "accuracy": (options("--model=camera"), [*ACCURACY, *SETTINGS, *options("--land-within-ms=40")]),
    "accuracy --model system:made": (options("-N=4 -M=1 --output=0"), [*ACCURACY, *SETTINGS]),
    "design": (options("--model=camera --within=0.03"), [*ACCURACY, *SETTINGS, *options("--all-methods")]),
    "design --model system:made": (options("--within=1 -N=4 -M=1 --output=0"), [*ACCURACY, *SETTINGS]),
    "explore --no-browser --port 0": (
        [],
        [*DESIGN, *ACCURACY, *SETTINGS, *options("--model=system:made --within=0.03")],
    ),
    "": ([], [*options("--version --help"), *SETTINGS]),
}
"""What each needs, and what else it may have."""
OFTEN = {"minimum": 6, "simulate": 5, "simulate --scenario scenario.toml": 5, "processors": 3}
"""Others count one: a sweep waits for its disk."""
DRAWN: dict[str, tuple[Options, Options]] = {
    "design": (options("--model=camera --within=0.03 --every=1 --figure=out.svg"), [*ACCURACY, *SETTINGS]),
    "gantt": (
        [*DESIGN, ("--output", "out.svg")],
        [*SETTINGS, *options("--output=out.png --output=out.pdf --width=88mm --from=2 --until=5")],
    ),
    "simulate": ([*DESIGN, ("--gantt", "out.svg")], SETTINGS),
    "simulate --scenario scenario.toml": (options("--gantt=out.svg"), options("--histogram=out.svg --histogram=a.png")),
}
"""Those that make pictures, which take a hundred times as long."""

NAMES = {"scenario.toml": ["samples.toml"], "parts.toml": ["part.toml", "tasks.toml"]}
"""Files by those that name them."""
INPUT_OPTIONS = {"--costs", "--processor", "--tasks", "--scenario"}
OUTPUT_OPTIONS = {"--output", "--gantt", "--trace", "--histogram", "--results", "--export", "--figure"}
FUNCTION_OPTIONS = {"--system", "--filter", "--model"}

numbers = st.sampled_from(NUMBERS)
texts = st.sampled_from(HOSTILE_TEXT) | st.text(max_size=6)
NESTED = "[" * 3000 + "]" * 3000
ODD = [True, [], {}, [[]], [1, "a"], {"a": 1}, *map(Raw, ("1979-05-27", "07:32:00", "x", NESTED))]
values = st.one_of(
    numbers.map(Raw), numbers, texts, st.sampled_from([*WORDS, *DOCUMENTS, *NO_FILES]), st.sampled_from(ODD)
)


@st.composite
def slipped(draw: st.DrawFn, document: Document) -> Document:
    """One entry of the document changed, deleted, renamed, doubled or exchanged with another."""
    found = deepcopy(document)
    places = list(_places(found))
    table, key = draw(st.sampled_from(places))
    match draw(st.sampled_from(["change", "change", "change", "delete", "rename", "add", "double", "exchange"])):
        case "change":
            table[key] = draw(values)
        case "delete":
            del table[key]
        case "rename" if isinstance(table, dict):
            table[draw(texts)] = table.pop(key)
        case "add" if isinstance(table, dict):
            table[draw(st.sampled_from([key + "s", "x", "", "a.b", "\n"]))] = draw(values)
        case "double" if isinstance(table, list):
            table.append(deepcopy(table[key]))
        case "exchange":
            other, at = draw(st.sampled_from(places))
            table[key] = deepcopy(other[at])
    return found


def _places(value: Any) -> Any:
    """(table or list, key or number) of everything in a document."""
    if isinstance(value, dict | list):
        for key in list(value) if isinstance(value, dict) else range(len(value)):
            yield value, key
            yield from _places(value[key])


@st.composite
def spoilt(draw: st.DrawFn, text: str) -> bytes:
    """Bytes cut off, put in or turned round."""
    content = text.encode()
    at = draw(st.integers(0, len(content)))
    put = draw(st.sampled_from([b"", b"\x00", b"\xff", b"\xef\xbb\xbf", b"\r", b'"', b"[", b"\x1b", b"\\", b"#"]))
    return content[:at] + put + (b"" if draw(st.booleans()) else content[at:])


@st.composite
def modules(draw: st.DrawFn, parts: dict[str, str], slips: int) -> bytes:
    found = dict(parts)
    for _ in range(slips):
        name = draw(st.sampled_from(list(found)))
        if found[name].startswith("def ") and draw(st.booleans()):
            found[name] = found[name].partition("\n")[0] + "\n    " + draw(st.sampled_from(BODIES))
        elif " = " in found[name] and draw(st.booleans()):
            left, _, right = found[name].partition(" = ")
            given = right.split(", ")
            given[draw(st.integers(0, len(given) - 1))] = draw(st.sampled_from(VALUES))
            found[name] = f"{left} = {', '.join(given)}"
        else:
            found[name] = draw(st.sampled_from(CODE))
    return python(found).encode("utf-8", "surrogatepass")


def arguments_for(option: str) -> st.SearchStrategy[str]:
    """Values that someone might give, hardly ever the right ones."""
    wrong = numbers | texts | st.sampled_from(WORDS)
    if option in OUTPUT_OPTIONS:
        return st.sampled_from(OUTPUTS)
    if option in FUNCTION_OPTIONS:
        return st.sampled_from(FUNCTIONS) | wrong
    return st.sampled_from(INPUTS) | wrong if option in INPUT_OPTIONS else wrong


@st.composite
def cases(draw: st.DrawFn, *, drawn: bool = False) -> Case:
    """Mostly good ones: at most two slips, of which all, some or none are in files."""
    commands = DRAWN if drawn else COMMANDS
    command = draw(st.sampled_from([command for command in commands for _ in range(OFTEN.get(command, 1))]))
    needed, possible = commands[command]
    given = [*needed, *draw(st.lists(st.sampled_from(possible), max_size=4))]
    slips = draw(st.sampled_from([0, 1, 1, 1, 2, 2]))
    in_files = draw(st.integers(0, slips))
    words = command.split()
    for _ in range(slips - in_files):
        given, words = _slip(draw, given, words)
    arguments = [*words, *(part for option, value in given for part in ((option, value) if value else (option,)))]
    return Case([text.replace("\x00", "\\0") for text in arguments], _files(draw, arguments, in_files))


def _slip(draw: st.DrawFn, options: list[tuple[str, str]], words: list[str]) -> tuple[list[tuple[str, str]], list[str]]:
    """In the command line."""
    what = draw(st.sampled_from(["value", "value", "value", "drop", "stray", "unknown", "word"]))
    at = draw(st.integers(0, max(len(options) - 1, 0)))
    if what == "stray" or not options:
        return [*options, (draw(texts | numbers | st.sampled_from(INPUTS)), "")], words
    option = options[at][0]
    if what == "value":
        return [*options[:at], (option, draw(arguments_for(option))), *options[at + 1 :]], words
    if what == "drop":
        return options[:at] + options[at + 1 :], words
    if what == "word" and len(words) > 1 and "counted" not in words[-1]:
        return options, [*words[:-1], draw(arguments_for(words[-2]))]
    return [*options, (draw(st.sampled_from(["--unknown", "-x", "--N", "--Method", "--\x1b[2J", "-"])), "1")], words


def _files(draw: st.DrawFn, arguments: Sequence[str], slips: int) -> dict[str, bytes]:
    """Those that the arguments name, and that those name."""
    named = " ".join(arguments)
    wanted = [name for name in DOCUMENTS if name in named or any(name in NAMES[by] for by in NAMES if by in named)]
    owned = [name for name in MODULES if f"{name.removesuffix('.py')}:" in named]
    slipping = draw(st.sampled_from([*wanted, *owned])) if wanted or owned else ""
    found = {}
    for name in wanted:
        document = DOCUMENTS[name]
        for _ in range(slips if name == slipping else 0):
            document = draw(slipped(document)) if _places_in(document) else document
        text = toml(document)
        spoil = name == slipping and slips and draw(st.integers(0, 9)) == 0
        found[name] = draw(spoilt(text)) if spoil else text.encode("utf-8", "replace")
    for name in owned:
        found[name] = draw(modules(MODULES[name], slips if name == slipping else 0))
    return found


def _places_in(document: Document) -> bool:
    return next(_places(document), None) is not None
