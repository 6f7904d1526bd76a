"""What is refused of a scenario file, and of the command lines that run one."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.command_line import Run, is_refused
from tests.sched_sim.cli.test_scenario_commands import REST, SHORT, write


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("every = 10", "every = 0"), ["sensor 'gps'", "every 0 must be at least 1"]),
        (("every = 10", "every = true"), ["sensor 'gps'.every", "must be a number", "True"]),
        (("every = 10", 'every = "2/3"'), ["sensor 'gps'", "every 2/3 must be at least 1"]),
        (
            ("every = 10\n", ""),
            ["sensor 'gps'.every: is missing: write `every = ...` in steps, or `hz = ...` beside hr_hz"],
        ),
        (("every = 10", "every = 10\ndropout = 1.5"), ["sensor 'gps'", "dropout 1.5", "from 0 to 1"]),
        (("delay = 2", "delay = -2"), ["sensor 'gps'", "delay -2", "0 or more"]),
        (("delay = 2", "delay = []"), ["sensor 'gps'.delay", "empty"]),
        (("delay = 2", "delay = [2, true]"), ["sensor 'gps'.delay", "entry 1"]),
        (("delay = 2", "delay = { least = 5, most = 3 }"), ["sensor 'gps'.delay", "least = 5", "most = 3"]),
        (("delay = 2", "delay = { least = 5 }"), ["sensor 'gps'.delay: has no most: give both, as { least = 3, most"]),
        (("delay = 2", "delay = { least = 5, mots = 7 }"), ["sensor 'gps'.delay: has no most"]),
        (
            ("delay = 2", "delay = { least = 5, most = 7, step = 2 }"),
            ["sensor 'gps'.delay", "step: this key is not permitted; the keys here are least, most"],
        ),
        (("delay = 2", "delay = { least = 0, most = 10000000000 }"), ["sensor 'gps'", "delay 10000000000 is above"]),
        (("delay = 2", "delay = [50, 40]"), ["sensor 'gps': the least delay 40", "steps = 40", "none arrives"]),
        (("delay = 2", "offset = 40"), ["sensor 'gps': the offset 40 is not less than steps = 40: none arrives; give"]),
        (
            ("delay = 2", "offset = 30\ndelay = [20, 10]"),
            ["sensor 'gps': offset 30 and the least delay 10 together are not less than steps = 40: none arrives"],
        ),
        (("delay = 2", "delay = 2\nland_by = 1"), ["sensor 'gps'", "land_by 1", "least delay 2"]),
        (("delay = 2", "delay = 2\ncost = 0"), ["sensor 'gps'.cost", "greater than 0"]),
        (("delay = 2", "delay = 2\ncost = [1, -1]"), ["sensor 'gps'.cost", "entry 1", "-1"]),
        (
            ("delay = 2", "latency = 2"),
            [
                "sensor 'gps'.latency: this key is not permitted; the keys here are name, hz, every, delay_ms, delay",
                "(given: 2)",
            ],
        ),
        (("delay = 2", "dealy = 2"), ["sensor 'gps'.dealy", "did you mean delay? the keys here are name, hz, every"]),
        (
            ("[predictor]", "[predictor]\ncosts = 3"),
            ["predictor.costs", "did you mean cost_s?", "are priority, cost, cost_us, cost_ms, cost_s"],
        ),
        (
            ("steps = 40", "step = 40"),
            [
                "step: this key is not permitted; did you mean steps?",
                "steps: is missing: write `steps = ...`, or `duration_s = ...` beside hr_hz",
            ],
        ),
        (("[[sensor]]", "[sensor]"), ["sensor: this is one table", "write [[sensor]], in two pairs of brackets"]),
        ((SHORT[SHORT.index("[[sensor]]") :], ""), ["sensor: there is none", "[[sensor]], with name and every"]),
        (
            (SHORT[SHORT.index("[predictor]") :], "sensor = []"),
            ["sensor: there is none: give at least one [[sensor]], with name and every"],
        ),
        ((SHORT[SHORT.index("[[sensor]]") :], "sensor = 3"), ["predictor.sensor: this key is not permitted"]),
        (("priority = 10\n", "[task]"), ["task: this is one table", "write [[task]], in two pairs of brackets"]),
        (('name = "short"', 'name = ""'), ['name: is empty: write name = "..."']),
        (("steps = 40", 'steps = "40"'), ["steps: must be a whole number", '"40", which is text: write 40, without']),
        (("speed = 10", 'speed = "1.5"'), ['speed: must be a number (given: "1.5", which is text: write 1.5, without']),
        (("steps = 40", "steps = 99999999999"), ["steps: must be at most 10,000,000 (given: 99999999999)"]),
        (('name = "gps"', 'name = ""'), ["sensor", "name is empty"]),
        (('name = "gps"', 'name = "radar"'), ["no costs of correct.radar", "give sensor 'radar' a cost"]),
        (("[[sensor]]", '[[sensor]]\nname = "gps"\nevery = 3\n[[sensor]]'), ["sensor 'gps'", "2 times", "own name"]),
        (("[predictor]", '[predictor]\npriority = "high"'), ["predictor.priority", "high"]),
        (("[predictor]", "[predictor]\ncost = []"), ["predictor.cost", "empty"]),
        (
            ("[predictor]", "[predictor]\ncost = { minimum = 1, median = 2, p95 = 3 }"),
            ["predictor.cost: must be a number, or a list to draw from, such as [0.3, 0.5]"],
        ),
        (
            ("[predictor]", "predictor = 1"),
            [
                "predictor: must be a table: write [predictor], which may have priority, cost, cost_us, cost_ms, "
                "cost_s (given: 1)"
            ],
        ),
        (("[predictor]", "[[predictor]]"), ["predictor: this is a list", "write [predictor], in one pair of brackets"]),
        (
            (SHORT[SHORT.index("[predictor]") :], "sensor = [1, 2]"),
            [
                "sensor.0: must be a table: write [[sensor]] for each, with name and every (or hz) (given: 1)",
                "sensor.1",
            ],
        ),
        (('costs = "costs.toml"', "costs = 0.3"), ["costs: must be the path", "`cost` of [predictor]", "(given: 0.3)"]),
        (('costs = "costs.toml"', "[costs]\npredict = 1"), ["costs: must be the path of a file"]),
        (('costs = "costs.toml"', 'processor = ""'), ["processor: the name is empty: give the path"]),
        (('costs = "costs.toml"', "processor = 7"), ["processor: must be the path of a file, or one of "]),
        (("speed = 10", ""), ["neither is given of hr_hz and speed"]),
        (("speed = 10", "speed = 10\nhr_hz = 400"), ["both are given of hr_hz and speed"]),
        (("speed = 10", "speed = 0"), ["speed", "greater than 0"]),
        (("speed = 10", "hr_hz = 400"), ["'operation'", "second, seconds, s, ms", "processor", "speed"]),
        (("speed = 10", 'speed = 10\nprocessor = "cortex-m7"'), ["processor 'cortex-m7'", "hr_hz"]),
        (("speed = 10", 'hr_hz = 9\nprocessor = "z80"'), ["z80", "cortex-m7"]),
        (("speed = 10", 'hr_hz = 9\ntimes_slower = 2\nprocessor = "cortex-m7"'), ["times_slower", "one of them"]),
        (
            ('costs = "costs.toml"', "times_slower = 2"),
            ["times_slower is for what a costs file says, and there is none: give costs = ..., or delete times_slower"],
        ),
        (('costs = "costs.toml"', 'costs = "none.toml"'), ["none.toml", "not found", "measure --filter"]),
        (('costs = "costs.toml"', ""), ["no costs of predict", "give [predictor] a cost"]),
        (("steps = 40", "steps = 0"), ["steps: must be at least 1 (given: 0)"]),
        (("steps = 40", "steps = 40\nseed = -1"), ["seed: must be at least 0 (given: -1)"]),
        (("steps = 40", "steps = 40\ncpus = 3"), ["cpus", "1 or 2"]),
        (("steps = 40", "steps = 40\ncpus = true"), ["cpus: must be a whole number"]),
        (("steps = 40", "steps = 40\ncontext_switch = -1"), ["context_switch: must be at least 0 (given: -1)"]),
        (
            ("steps = 40", 'steps = 40\nlate = "newest"'),
            ["late", "'recalculate', 'larsen', 'carried-gain' or 'dual-rate'", "newest"],
        ),
        (
            ("steps = 40", 'steps = 40\nlate = "dual-rate"'),
            [
                "no costs of hr_propagate, hr_restart, hr_update, lr_propagate, gain.gps",
                "[samples.hr_pass] gps = [...]",
            ],
        ),
        (
            (REST, REST.replace("costs =", 'late = "larsen"\ncosts =').replace("delay = 2", "delay = 12")),
            [
                "no costs of carry_product, beside_product.gps",
                "with several measurements in flight",
                'late = "recalculate"',
            ],
        ),
        (('costs = "costs.toml"', 'costs = ""'), ["costs: the name is empty: give the path"]),
        (('costs = "costs.toml"', 'costs = ".."'), ["'..' is a folder, not a file: give the path"]),
        (
            ("priority = 10\n", 'priority = 10\n[[task]]\nname = "t"\nperiod = -1\ncost = 1\npriority = 5'),
            ["task 't'.period", "-1"],
        ),
        (
            ("priority = 10\n", 'priority = 10\n[[task]]\nname = "t"\nperiod = 1\ncost = 1\npriority = 5\ncpu = 2'),
            ["cpus = 2"],
        ),
        (
            ("priority = 10\n", 'priority = 10\n[[task]]\nname = "t"\nperiod = 1e-10\ncost = 1\npriority = 5'),
            [
                "--scenario 's.toml': steps = 40 release 400000000040 jobs",
                "task 't' with period 1e-10",
                "check its period",
            ],
        ),
        (("steps = 40", "steps ="), ["s.toml", "not valid TOML"]),
    ],
)
def test_a_wrong_entry_is_refused_by_name(
    sched_sim: Run, tmp_path: Path, change: tuple[str, str], said: list[str]
) -> None:
    write(tmp_path, SHORT.replace(*change))
    is_refused(sched_sim("simulate --scenario s.toml"), ["s.toml", *said])


def test_every_wrong_entry_is_listed(sched_sim: Run, tmp_path: Path) -> None:
    write(
        tmp_path, SHORT.replace("delay = 2", "delay = -2\ndropout = 2").replace("steps = 40", "steps = 4.5\nseeds = 1")
    )
    said = ["steps: must be a whole number (given: 4.5)", "seeds", "dropout 2 must be", "delay -2 must be"]
    is_refused(sched_sim("simulate --scenario s.toml"), said)


def test_entries_out_of_bounds_are_listed_with_those_that_cannot_be_read(sched_sim: Run, tmp_path: Path) -> None:
    task = '[[task]]\nname = "t"\nperiod = 2\ncost = 1\npriority = 5\noffset = -1\ncpu = 3\n'
    wrong = SHORT.replace("every = 10", "every = 0").replace("steps = 40", "steps = -1\nseed = -3\ncontext_switch = -1")
    write(tmp_path, wrong.replace('"short"', '""') + task)
    said = [
        "name: is empty",
        "steps: must be at least 1",
        "seed: must be at least 0",
        "context_switch: must be at least 0",
    ]
    said += ["sensor 'gps': every 0 must", "task 't': offset -1 must be 0 or more HR periods; cpu 3 must be 1 or 2"]
    is_refused(sched_sim("simulate --scenario s.toml"), said)


def test_all_that_does_not_go_together_is_listed(sched_sim: Run, tmp_path: Path) -> None:
    write(
        tmp_path,
        SHORT.replace("speed = 10", "times_slower = 2\nprocessor = 'leon3'").replace("delay = 2", "delay = 40"),
    )
    said = [
        "neither is given of hr_hz and speed",
        "times_slower is for measured costs",
        "the least delay 40 is not less",
    ]
    is_refused(sched_sim("simulate --scenario s.toml"), said)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("--scenario .", ["--scenario '.' is a folder, not a file: give the path"]),
        ("--scenario none.toml", ["none.toml", "not found", "[[sensor]]"]),
        ("--scenario s.toml -N 10 -M 4", ["-N, -M", "--scenario s.toml", "leave them out"]),
        ("--scenario s.toml -L 8", ["-L", "leave it out"]),
        ("--scenario s.toml --method larsen", ["--method"]),
        ("--scenario s.toml --costs steffes2014", ["--costs"]),
        ("--scenario s.toml --tasks tasks.toml", ["--tasks"]),
        ("--scenario s.toml --speed 3", ["--speed"]),
        ("--scenario s.toml --processor cortex-m7 --hr-hz 400", ["--hr-hz, --processor"]),
        ("--scenario s.toml --cycles 3", ["--cycles"]),
        ("--scenario s.toml --histogram h.gif", ["--histogram 'h.gif': suffix '.gif' is no picture format", ".svg"]),
        ("--scenario s.toml --gantt none/g.svg", ["--gantt 'none/g.svg'", "folder"]),
        ("--scenario s.toml --histogram .", ["--histogram '.': suffix '' is no picture format"]),
        ("--scenario s.toml --trace t.txt", ["t.txt", ".json"]),
        ("--scenario s.toml --histogram v.svg --gantt v.svg", ["--histogram v.svg and --gantt v.svg", "one file"]),
        ("--scenario s.toml --gantt v.svg --histogram ./sub/../v.svg", ["--gantt v.svg", "one file"]),
        ("--scenario s.toml --trace t.csv --trace t.csv", ["--trace t.csv and --trace t.csv", "one file"]),
        ("-N 10 -M 4 --trace t.csv --trace t.csv", ["--trace t.csv and --trace t.csv", "one file"]),
        ("-N 10 -M 4 --histogram h.svg", ["--histogram h.svg", "--scenario"]),
        ("-M 4", ["-N is missing", "--scenario"]),
    ],
)
def test_a_wrong_command_line_is_refused(sched_sim: Run, tmp_path: Path, line: str, said: list[str]) -> None:
    write(tmp_path)
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    is_refused(sched_sim(f"simulate {line}"), said)
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before
