"""Command lines and their files as users get them wrong: good ones, with a slip or two of the keyboard in them."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from typing import Any, NamedTuple

from hypothesis import strategies as st

from tests.fuzz.files import DOCUMENTS, MODULES, Document, Raw, python, toml


class Case(NamedTuple):
    """arguments: of `sched-sim`; files: in the folder where it runs, by name."""

    arguments: Sequence[str]
    files: dict[str, bytes]


HOSTILE_TEXT = ("", " ", "[/x]", "imu [a]", ":bug:", r"$\foo$", "$", "a$b", "\\", "\x1b[2J", "\x00", "a\nb", "\t=1", "=1+1",
                "@SUM(A1)", "-2+3", "日本", "🚀", "\u202ex", "\x85", "a" * 300, "x" * 3000, "--", "a/b", "'", '"', "%s", "{0}")  # fmt: skip
NUMBERS = ("0", "1", "2", "3", "7", "-1", "-0.0", "0.5", "1.5", "1e-3", "40/3", "1/3", "77/100", "1/0", "nan", "-inf", "inf", "1e18",
           "1e-18", "1e19", "1e99", "1e400", "1e999999999", "1e-999999999", "9223372036854775807", "9223372036854775808",
           "1" * 30, "0." + "3" * 30, "1" * 400, "1" * 5000, "1_0", "０１", "+4", "0x10", "1e1", " 3 ", "1,2", "1:3",
           "3:1", "1:3:0", "1:1000000", "1:10000001", "1:2:3:4", ",", ":")  # fmt: skip
WORDS = ("all", "m", "l", "m,l", "same-step", "next-step", "precomputed", "sum", "euler", "p95", "median", "json", "csv",
         "table", "standard", "recalculate", "larsen", "dual-rate", "multirate", "robust-lu", "steffes2014",
         "counted-9-3-3", "erkf-position", "cortex-m4f", "desktop", "1,2", "counted", "joseph")  # fmt: skip
INPUTS = (*DOCUMENTS, "missing.toml", "folder.toml", "loop.toml", "fifo.toml", "/dev/zero", "/dev/null", "empty.toml",
          "latin.toml", "deep.toml", "long/" * 100, "a" * 300, ".", "/", "", "\udcff.toml", "\x1b[2J")  # fmt: skip
OUTPUTS = ("out.svg", "out.pdf", "out.png", "out.json", "out.csv", "out.toml", "out.parquet", "out.sqlite", "out.gif",
           "out", ".svg", "no/where.svg", "folder.toml", "folder.toml/out.csv", "loop.toml", "a" * 300 + ".svg", ".", "",
           "\udcff.svg", "\x1b[2J.csv", "=1.json", "$x$.svg", "out.SVG", "costs.toml", "scenario.toml")  # fmt: skip
FUNCTIONS = ("system:made", "filter:made", "system:f", "system:states", "system:none", "system", "missing:made", ":made", "system:",
             ".system:made", "a.b:c", "numpy:array", "sys:exit", "os:getcwd", "system:made:x", "", "\x1b:x")  # fmt: skip
PYTHON = ("", "pass", "raise", "1/0", "import sys; sys.exit(3)", "import sys; sys.exit('bye')", "import numba", "def",
          "raise RecursionError", "raise KeyboardInterrupt" if False else "raise SystemExit", "\ud800", "x" * 3000,
          "raise type('Error', (Exception,), {'__str__': lambda self: 1 / 0})", "import missing_module")  # fmt: skip
BODIES = ("pass", "raise ValueError('a\\nb \\x1b[2J')", "import sys; sys.exit(3)", "return None", "return 1", "return 'text'",
          "return np.zeros((3, 3))", "return np.full((2, 2), np.nan)", "return np.array([['a']])", "return [[1.0], [1.0, 2.0]]",
          "return made()", "return np.zeros(0)", "out[9] = 1", "out[0] = 'a'", "out[:] = np.inf", "return {}", "return -np.eye(2)",
          "while True: raise KeyError('x')")  # fmt: skip
VALUES = (
    "'2'",
    "2.0",
    "None",
    "-1",
    "0",
    "10**30",
    "True",
    "[1, 2]",
    "np.nan",
    "np.int64(2)",
    "'a'",
    "np.eye(3)",
    "{}",
    "1000",
)

DESIGN = [("-N", "6"), ("-M", "2")]
SETTINGS = [("-L", "5"), ("--method", "larsen"), ("--method", "dual-rate"), ("--method", "recalculate"), ("--method", "standard"),
            ("--costs", "costs.toml"), ("--costs", "counts.toml"), ("--costs", "counted-9-3-3"), ("--statistic", "p95"),
            ("--lr-propagate-by", "l"), ("--feedback", "same-step"), ("--gain", "precomputed"),
            ("--low-rate-noise", "euler"), ("--processor", "part.toml"), ("--processor", "cortex-m4f"), ("--cpus", "2"),
            ("--context-switch", "0.01"), ("--tasks", "tasks.toml"), ("--hr-hz", "400"), ("--speed", "1.5"),
            ("--cycles", "2"), ("--format", "json"), ("--format", "csv")]  # fmt: skip
FILES_OUT = [("--gantt", "out.svg"), ("--trace", "out.json"), ("--trace", "out.csv"), ("--histogram", "out.png")]
COMMANDS: dict[str, tuple[list[tuple[str, str]], list[tuple[str, str]]]] = {
    "minimum": (DESIGN, SETTINGS),
    "simulate": ([*DESIGN, ("--speed", "2")], [*SETTINGS, *FILES_OUT[1:3]]),
    "simulate --scenario scenario.toml": ([], [("--format", "json"), ("--format", "csv"), *FILES_OUT[1:3]]),
    "processors": ([], [*DESIGN, *SETTINGS]),
    "sweep": ([("-N", "4:6"), ("--results", "out.sqlite")],
              [("-M", "1,2"), ("--simulate", ""), ("--export", "out.csv"), ("--export", "out.parquet"),
               ("--results", "other.sqlite"), *SETTINGS]),
    "sweep grid.toml": ([("--results", "out.sqlite")], [("-N", "4"), ("--export", "out.csv"), *SETTINGS]),
    "measure --backend counted": ([("--states", "2"), ("--inputs", "1"), ("--measurements", "1"), ("--method", "larsen")],
                                  [("--update", "joseph"), ("--output", "out.toml"), ("--robust", "attitude"),
                                   ("--parallel", "4"), ("--format", "json"), ("--thorough", "")]),
    "measure --backend counted --system system:made": ([("--method", "larsen")], [("--output", "out.toml"), ("--format", "csv")]),
    "measure --backend counted --filter filter:made": ([], [("--output", "out.toml"), ("--format", "json")]),
    "": ([], [("--version", ""), ("--help", ""), *SETTINGS]),
}  # fmt: skip
DRAWN = {
    "gantt": ([*DESIGN, ("--output", "out.svg")], [*SETTINGS, ("--output", "out.png"), ("--output", "out.pdf")]),
    "simulate": ([*DESIGN, ("--gantt", "out.svg")], SETTINGS),
    "simulate --scenario scenario.toml": ([("--gantt", "out.svg")], [("--histogram", "out.svg")]),
}
"""Those that make pictures, which take a hundred times as long."""

INPUT_OPTIONS = {"--costs", "--processor", "--tasks", "--scenario"}
OUTPUT_OPTIONS = {"--output", "--gantt", "--trace", "--histogram", "--results", "--export"}
FUNCTION_OPTIONS = {"--system", "--filter"}

numbers = st.sampled_from(NUMBERS)
texts = st.sampled_from(HOSTILE_TEXT) | st.text(max_size=6).filter(lambda text: text < "\ud800" or text > "\udfff")
values = st.one_of(
    numbers.map(Raw),
    numbers,
    texts.map(lambda text: text.encode("utf-8", "replace").decode()),
    st.sampled_from(WORDS + INPUTS[:-2]),
    st.sampled_from(
        [
            True,
            [],
            {},
            [[]],
            [1, "a"],
            {"a": 1},
            Raw("1979-05-27"),
            Raw("07:32:00"),
            Raw("x"),
            Raw('"""'),
            Raw("[" * 3000 + "]" * 3000),
        ]
    ),
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
    put = draw(
        st.sampled_from([b"", b"\x00", b"\xff", b"\xef\xbb\xbf", b"\r", b'"', b"[", b"=", b"\x1b", b"'''", b"\\", b"#"])
    )
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
            found[name] = draw(st.sampled_from(PYTHON))
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
    command = draw(st.sampled_from(list(commands)))
    needed, possible = commands[command]
    options = [*needed, *draw(st.lists(st.sampled_from(possible), max_size=4))]
    slips = draw(st.sampled_from([0, 1, 1, 1, 2, 2]))
    in_files = draw(st.integers(0, slips))
    words = command.split()
    for _ in range(slips - in_files):
        options, words = _slip(draw, options, words)
    arguments = [*words, *(part for option, value in options for part in ((option, value) if value else (option,)))]
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
    wanted = [name for name in DOCUMENTS if name in named] + ["samples.toml"] * ("scenario.toml" in named)
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
