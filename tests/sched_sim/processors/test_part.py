"""Operation counts on a processor of known operation times."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.operations import OPERATION_KINDS
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import costs_text, load_costs, read_costs
from sched_sim.errors import InputError
from sched_sim.processors.part import Calibration, Part, at_clock, on_part
from sched_sim.processors.part_file import SHIPPED, load_part, shipped_parts

MICROSECOND = Fraction(1, 10**6)

BOARD = """
name = "board"
title = "my board"
precision = "single"
clock_mhz = 2
logic_per_arithmetic = 0.5
[cycles]
multiply = 3
add = { cycles = 2, is = "latency", source = "my data sheet, Table 4" }
divide = "29/2"
logic = 1
"""

TIMES = """
name = "board"
title = "my board"
precision = "double"
logic_per_arithmetic = 0
[microseconds]
multiply = 0.3
add = 0.2
"""

counts = st.fixed_dictionaries(
    {"multiply": st.integers(1, 10**6)}, optional={kind: st.integers(0, 10**6) for kind in OPERATION_KINDS[1:]}
)
positive = st.fractions(min_value=Fraction(1, 1000), max_value=1000)
processors = st.builds(
    Part,
    name=st.just("any"),
    title=st.just("any"),
    precision=st.just("double"),
    clock_hz=positive,
    seconds=st.fixed_dictionaries(dict.fromkeys(OPERATION_KINDS, positive)),
    logic_per_arithmetic=st.fractions(min_value=0, max_value=10),
    sources=st.just({}),
)


def table(operations: dict[str, int]) -> CostTable:
    """A table with one job."""
    return CostTable("mine", "operation", {}, operations={"standard": {"update": operations}})


def seconds(operations: dict[str, int], processor: Part) -> Fraction:
    """What that job takes on `processor`."""
    return on_part(table(operations), processor).entry("standard", "update").minimum


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "board.toml"
    path.write_text(BOARD)
    return path


def test_the_patents_filter_takes_the_patents_times_on_the_patents_processor() -> None:
    # "Optimal covariance filtering": "the conventional Kalman filter would require 166,870 microseconds per cycle";
    # 139 x 20 + 128 x 10 + 1783 x 2 for the state update
    costs = on_part(load_costs("patent-multirate"), load_part("patent")).costs["multirate"]
    assert costs["covariance_gain"] == Cost.of(166870 * MICROSECOND)
    assert costs["state_update"] == Cost.of(7626 * MICROSECOND)


def test_the_patents_overhead_factor_is_that_of_its_covariance_cycle() -> None:
    counted = dict(load_costs("patent-multirate").operations["multirate"]["covariance_gain"])
    del counted["logic"]
    assert seconds(counted, load_part("patent")) == 166870 * MICROSECOND


@pytest.mark.parametrize("name", shipped_parts())
def test_every_shipped_processor_says_where_each_figure_is_from(name: str) -> None:
    processor = load_part(name)
    assert processor.name == name
    figures = {*processor.seconds, "logic_per_arithmetic", *(["clock_mhz"] if processor.clock_hz else [])}
    assert set(processor.sources) == figures
    assert all(processor.sources.values())
    for kind in processor.seconds:
        assert processor.sources[kind].startswith(("latency: ", "throughput: ", "time: "))


@pytest.mark.parametrize("name", shipped_parts())
def test_every_shipped_processor_runs_the_counted_filters(name: str) -> None:
    counted = load_costs("counted-9-3-3")
    timed = on_part(counted, load_part(name))
    assert timed.unit == "second"
    for method in DELAYED_METHODS:
        assert list(timed.costs[method]) == list(counted.costs[method])
    assert timed.provenance["update_form"] == "textbook"
    assert timed.provenance["processor"]["name"] == name
    assert timed.provenance["machine"] == load_part(name).title


@pytest.mark.parametrize(
    ("name", "cycles"),
    [
        ("cortex-m4f", 14),
        ("cortex-m7-single", 9),
        ("cortex-m33", 10),
        ("cortex-m0plus", 166 + 108 + 11),
        ("rp2040", 62 + 78 + 2 * 6 + 11),
        ("esp32", 12),
    ],
)
def test_a_turn_of_the_inner_loop_of_a_matrix_product_takes_its_cycles(name: str, cycles: int) -> None:
    """A multiply, an add, and the instructions around them that the file's sources list."""
    part = load_part(name)
    assert part.clock_hz is not None
    assert part.precision == "single"
    assert seconds({"multiply": 1, "add": 1}, part) * part.clock_hz == cycles


def test_a_file_with_cycles_is_read_exactly(file: Path) -> None:
    board = load_part(file)
    assert board.clock_hz == 2_000_000
    assert board.seconds == {
        "multiply": Fraction(3, 2) * MICROSECOND,
        "add": MICROSECOND,
        "divide": Fraction(29, 4) * MICROSECOND,
        "logic": MICROSECOND / 2,
    }
    assert board.logic_per_arithmetic == Fraction(1, 2)
    assert board.sources["add"] == "latency: my data sheet, Table 4"


def test_a_file_with_times_has_no_clock(file: Path) -> None:
    file.write_text(TIMES)
    board = load_part(file)
    assert board.clock_hz is None
    assert seconds({"multiply": 10, "add": 5}, board) == 4 * MICROSECOND


def test_logic_is_the_jobs_own_or_the_processors_factor(file: Path) -> None:
    board = load_part(file)
    assert seconds({"multiply": 4, "add": 6}, board) == (6 + 6 + Fraction(5, 2)) * MICROSECOND
    assert seconds({"multiply": 4, "add": 6, "logic": 100}, board) == (6 + 6 + 50) * MICROSECOND
    assert seconds({"multiply": 4, "add": 6, "logic": 0}, board) == (6 + 6) * MICROSECOND


def test_costs_on_a_processor_survive_being_written_and_read(tmp_path: Path) -> None:
    timed = on_part(load_costs("patent-multirate"), load_part("patent"))
    path = tmp_path / "timed.toml"
    path.write_text(costs_text(timed))
    assert replace(read_costs(path), path=timed.path) == timed


@given(processors, counts, counts, st.integers(1, 1000))
def test_time_is_linear_in_the_counts(processor: Part, a: dict[str, int], b: dict[str, int], times: int) -> None:
    if ("logic" in a) != ("logic" in b):
        a, b = a | {"logic": 7}, b | {"logic": 8}
    both = {kind: a.get(kind, 0) + times * b.get(kind, 0) for kind in {*a, *b}}
    assert seconds(both, processor) == seconds(a, processor) + times * seconds(b, processor)


@pytest.mark.parametrize("clock_mhz", [1, 84, 5000])
def test_times_are_cycles_over_the_clock(file: Path, clock_mhz: int) -> None:
    file.write_text((SHIPPED / "cortex-m4f.toml").read_text().replace("value = 168", f"value = {clock_mhz}"))
    shipped, moved = load_part("cortex-m4f"), load_part(file)
    assert moved.seconds["divide"] == Fraction(15, clock_mhz) * MICROSECOND
    assert moved.seconds == {kind: time * 168 / clock_mhz for kind, time in shipped.seconds.items()}


def test_an_unknown_processor_lists_the_shipped_ones_and_says_that_a_path_works() -> None:
    said = r"'cortex' not found: did you mean cortex-\S+\? give one of cortex-a53, .*patent.*path of a TOML file"
    with pytest.raises(InputError, match=said):
        load_part("cortex")


def test_a_table_without_counts_names_the_remedy() -> None:
    with pytest.raises(InputError, match=r"steffes2014.*no operation counts.*'patent'.*costs counted-9-3-3.*measure"):
        on_part(load_costs("steffes2014"), load_part("patent"))


def test_a_function_that_is_not_timed_is_the_arithmetic_of_a_cosine(file: Path) -> None:
    """13 multiplies, 17 adds, and the logic around these 30."""
    file.write_text(TIMES)
    board = load_part(file)
    as_arithmetic = seconds({"multiply": 1 + 2 * 13, "add": 2 * 17}, board)
    assert seconds({"multiply": 1, "function": 2}, board) == as_arithmetic


@pytest.mark.parametrize("kind", ["divide", "sqrt", "logic"])
def test_a_kind_that_the_processor_lacks_is_named(file: Path, kind: str) -> None:
    file.write_text(TIMES)
    with pytest.raises(InputError) as error:
        seconds({"multiply": 1, kind: 2}, load_part(file))
    for words in [
        f"'board' ({file})",
        f"no time for {kind}",
        "[operations.standard] update",
        f"`{kind} = ...`",
        "[microseconds]",
    ]:
        assert words in str(error.value)


def test_only_the_job_that_needs_it_misses_a_kind() -> None:
    two = replace(
        table({"multiply": 1}), operations={"standard": {"propagate": {"add": 1, "logic": 0}, "update": {"sqrt": 1}}}
    )
    timed = on_part(two, load_part("patent"))
    assert timed.entry("standard", "propagate") == Cost.of(10 * MICROSECOND)
    with pytest.raises(InputError, match=r"'patent'.*no time for sqrt.*\[operations\.standard\] update"):
        timed.entry("standard", "update")
    with pytest.raises(InputError, match=r"cost table mine on patent has no entry \[operations\.larsen\] update"):
        timed.entry("larsen", "update")


def test_a_kind_that_no_job_needs_may_lack() -> None:
    assert seconds({"multiply": 1, "sqrt": 0, "logic": 0}, load_part("patent")) == 20 * MICROSECOND


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("multiply = 3", "multiply = 0", ["cycles.multiply", "is 0", "greater than 0"]),
        ("multiply = 3", "multiply = -3", ["cycles.multiply", "-3", "greater than 0"]),
        ("multiply = 3", 'multiply = "fast"', ["cycles.multiply", "fast", "finite number"]),
        ("multiply = 3", "multiply = true", ["cycles.multiply", "True", "must be a number"]),
        ("multiply = 3", "multiply = nan", ["cycles.multiply", "NaN", "finite number"]),
        ("multiply = 3", "subtract = 3", ["subtract is no kind of operation", "multiply, add"]),
        ("{ cycles = 2", "{ cycle = 2", ["cycles.add.cycles: is missing", "cycles.add.cycle:"]),
        ('"latency"', '"guess"', ["cycles.add.is", "guess", "latency", "throughput"]),
        ("clock_mhz = 2", "clock_mhz = 0", ["clock_mhz", "is 0", "greater than 0"]),
        ("clock_mhz = 2", "clock_mhz = -2", ["clock_mhz", "-2", "greater than 0"]),
        ("clock_mhz = 2", "", ["[cycles] need the clock", "`clock_mhz = ...`"]),
        ("clock_mhz = 2", "clock_ghz = 2", ["clock_ghz", "not permitted"]),
        ("[cycles]", "[microseconds]", ["microseconds.add.microseconds: is missing", "cycles: ", "not permitted"]),
        (BOARD[BOARD.index("[") :], "[microseconds]\nlogic = 1", ["clock_mhz has no meaning", "delete it"]),
        ("[cycles]", "[microseconds]\nadd = 1\n[cycles]", ["either [cycles] with clock_mhz, or [microseconds]"]),
        (BOARD[BOARD.index("[") :], "", ["either [cycles] with clock_mhz, or [microseconds]"]),
        ("arithmetic = 0.5", "arithmetic = -0.5", ["logic_per_arithmetic", "-1/2", "0 or more"]),
        ("logic_per_arithmetic = 0.5", "", ["logic_per_arithmetic: is missing: write `logic_per_arithmetic = ...`"]),
        ("\nlogic = 1", "", ["logic_per_arithmetic needs the time of one", "`logic = ...`"]),
        ('"single"', '"half"', ["precision", "half", "single"]),
        ('name = "board"', "", ['name: is missing: write `name = "..."`']),
        ("[cycles]", "[cycles", ["not valid TOML"]),
    ],
)
def test_what_is_wrong_in_a_file_is_named(file: Path, old: str, new: str, said: list[str]) -> None:
    file.write_text(BOARD.replace(old, new, 1))
    with pytest.raises(InputError) as error:
        load_part(file)
    for words in [str(file), *said]:
        assert words in str(error.value)


def test_a_folder_is_no_processor(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is a folder, not a file: give one of"):
        load_part(tmp_path)


def test_a_file_that_is_no_text_cannot_be_read(file: Path) -> None:
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(InputError, match="cannot be read"):
        load_part(file)


def test_a_processor_without_a_clock_has_no_other() -> None:
    with pytest.raises(InputError, match=r"'patent' has no clock.*clock_mhz in a copy"):
        at_clock(load_part("patent"), Fraction(10**6))


RANGE = 'calibration = { least = 0.9, most = "13/10", source = "larsen, -O2" }'


@pytest.mark.parametrize(
    ("line", "calibration", "text"),
    [
        (RANGE, Calibration(Fraction(9, 10), Fraction(13, 10), "larsen, -O2"), "0.9 to 1.3 (larsen, -O2)"),
        ("calibration = 1.25", Calibration(Fraction(5, 4), Fraction(5, 4)), "1.25"),
    ],
)
def test_a_calibration_is_read_and_changes_no_time(file: Path, line: str, calibration: Calibration, text: str) -> None:
    plain = load_part(file)
    file.write_text(f"{line}\n{BOARD}")
    board = load_part(file)
    assert board.calibration == calibration
    assert calibration.text == text
    assert replace(board, calibration=None) == plain
    assert on_part(table({"multiply": 1}), board).provenance["processor"]["calibration"] == text


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("calibration = 0", ["calibration", "least is 0", "greater than 0"]),
        ('calibration = "half"', ["calibration", "half", "finite number"]),
        ("calibration = [0.9, 1.3]", ["calibration", "must be a number"]),
        ("calibration = { least = 0.9 }", ["calibration.most: is missing: write `most = ...`"]),
        ("calibration = { least = 1.3, most = 0.9 }", ["calibration", "most is 9/10", "at least least, 13/10"]),
        ("calibration = { least = 1, most = 2, of = 3 }", ["calibration.of", "least, most, source"]),
    ],
)
def test_what_is_wrong_in_a_calibration_is_named(file: Path, line: str, said: list[str]) -> None:
    file.write_text(f"{line}\n{BOARD}")
    with pytest.raises(InputError) as error:
        load_part(file)
    for words in [str(file), *said]:
        assert words in str(error.value)
