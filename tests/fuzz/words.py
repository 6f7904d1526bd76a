"""What users give where something else is wanted."""

from __future__ import annotations

from tests.fuzz.files import DOCUMENTS


def each(text: str) -> list[str]:
    return text.split()


LONG_NAME = "a" * 300
HOSTILE_TEXT = [
    *("", " ", "[/x]", "imu [a]", ":bug:", r"$\foo$", "$", "a$b", "\\", "\x1b[2J", "\x00", "a\nb", "\t=1", "=1+1"),
    *("@SUM(A1)", "-2+3", "日本", "🚀", "\u202ex", "\x85", "--", "a/b", "'", '"', "%s", "{0}", LONG_NAME, "x" * 3000),
]
NUMBERS = [
    *each("0 1 2 3 7 -1 -0.0 0.5 1.5 1e-3 40/3 1/3 77/100 1/0 nan -inf inf 1_0 ０１ +4 0x10 1e1 1,2 1:3 3:1 1:3:0"),
    *each("1e18 1e-18 1e19 1e99 1e400 1e999999999 1e-999999999 9223372036854775807 9223372036854775808"),
    *each("1:1000000 1:10000001 1:2:3:4 , :"),
    *(" 3 ", "1" * 30, "0." + "3" * 30, "1" * 400, "1" * 5000),
]
WORDS = each(
    "all m l m,l same-step next-step precomputed sum euler p95 median json csv table standard recalculate larsen 1,2 "
    "dual-rate multirate robust-lu steffes2014 counted-9-3-3 erkf-position cortex-m4f desktop counted joseph"
)
NO_FILES = [
    *each("missing.toml folder.toml loop.toml fifo.toml empty.toml latin.toml deep.toml /dev/zero /dev/null . /"),
    *("long/" * 100, LONG_NAME, "", "\x1b[2J"),
]
INPUTS = [*DOCUMENTS, *NO_FILES, "\udcff.toml"]
OUTPUTS = [
    *each("out.svg out.pdf out.png out.json out.csv out.toml out.parquet out.sqlite out.gif out.SVG out .svg ."),
    *each("no/where.svg folder.toml folder.toml/out.csv loop.toml costs.toml scenario.toml =1.json $x$.svg"),
    *("", "\udcff.svg", "\x1b[2J.csv", f"{LONG_NAME}.svg"),
]
FUNCTIONS = [
    *each("system:made filter:made system:f system:states system:none system missing:made :made system:"),
    *(".system:made", "a.b:c", "numpy:array", "sys:exit", "os:getcwd", "system:made:x", "", "\x1b:x"),
]
CODE = [
    *("", "pass", "raise", "raise RecursionError", "raise SystemExit", "1/0", "def", "\ud800", "x" * 3000),
    *("import sys; sys.exit(3)", "import sys; sys.exit('bye')", "import numba", "import missing_module"),
    "raise type('Error', (Exception,), {'__str__': lambda self: 1 / 0})",
]
BODIES = [
    *("pass", "raise ValueError('a\\nb \\x1b[2J')", "import sys; sys.exit(3)", "while True: raise KeyError('x')"),
    *("return None", "return 1", "return 'text'", "return {}", "return made()", "return np.zeros(0)"),
    *("return np.zeros((3, 3))", "return np.full((2, 2), np.nan)", "return np.array([['a']])", "return -np.eye(2)"),
    *("return [[1.0], [1.0, 2.0]]", "out[9] = 1", "out[0] = 'a'", "out[:] = np.inf"),
]
VALUES = each("'2' 2.0 None -1 0 10**30 True [1,2] np.nan np.int64(2) 'a' np.eye(3) {} 1000")
"""Expressions of Python."""
