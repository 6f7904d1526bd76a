"""A scenario that names the filter which it simulates has its sensors from there."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim import InputError, Scenario, read_scenario, run_scenario
from studies import describe_filter
from tests.command_line import Run, is_refused

VEHICLE = """
from fractions import Fraction

import numpy as np

from filters.modular import ModularFilter, Sensor, linear_corrector, linear_predictor

one = np.eye(1)
seen = linear_corrector(one, one)
GPS = Sensor("gps", seen, every=80, delay=range(30, 51), dropout=0.1)
CAMERA = Sensor("camera", seen, every=Fraction(40, 3), delay=[4, 6])


def vehicle():
    return ModularFilter(linear_predictor(one, one), [GPS, CAMERA, Sensor("radio", seen, every=8)], dt=1 / 400)


def of_any_rate():
    return ModularFilter(linear_predictor(one, one), [GPS]), np.zeros(1)


def nothing():
    return None
"""
HEAD = 'name = "v"\nfilter = "craft:vehicle"\nhr_hz = 400\nduration_s = 2\nunit = "ms"\n[predictor]\ncost = 0.1\n'
COSTS = "".join(f'[[sensor]]\nname = "{name}"\ncost = 0.2\n' for name in ("radio", "gps", "camera"))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "craft.py").write_text(VEHICLE)
    return tmp_path


def read(folder: Path, text: str = HEAD + COSTS) -> Scenario:
    (folder / "v.toml").write_text(text)
    return read_scenario(folder / "v.toml", describe_filter)


def test_sensors_are_the_filters_in_its_order(folder: Path) -> None:
    gps, camera, radio = read(folder).sensors
    assert (gps.name, gps.every, gps.delays, gps.dropout) == ("gps", 80, range(30, 51), 0.1)
    assert (camera.name, camera.every, camera.delays, camera.land_by) == ("camera", Fraction(40, 3), (4, 6), 6 + 12)
    assert (radio.name, radio.every, radio.delays, radio.dropout) == ("radio", 8, (0,), 0)
    assert run_scenario(read(folder)).sensors["camera"].taken == 60


def test_what_both_say_may_agree(folder: Path) -> None:
    delay = "delay_ms = { least = 75, most = 125 }\ndelay = { least = 30, most = 50 }\n"
    gps = read(folder, HEAD + COSTS.replace('"gps"\n', f'"gps"\nhz = 5\n{delay}dropout = 0.1\npriority = 5\n')).sensors[
        0
    ]
    assert (gps.every, gps.priority) == (80, 5)


def test_sensors_need_no_entry_where_a_file_has_their_costs(folder: Path) -> None:
    costs = "".join(f"{name} = [0.2]\n" for name in ("gps", "camera", "radio"))
    (folder / "costs.toml").write_text(
        f'name = "c"\nunit = "ms"\n[samples]\npredict = [0.1]\n[samples.correct]\n{costs}'
    )
    found = read(folder, 'costs = "costs.toml"\n' + HEAD.split("[predictor]")[0])
    assert found.sensors == read(folder).sensors
    assert found.costs == read(folder).costs


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (('"gps"\n', '"gps"\nevery = 40\n'), "sensor 'gps': every = 40 and the filter's every = 80 do not agree"),
        (('"gps"\n', '"gps"\nhz = 4\n'), "hz = 4 (every 100 steps) and the filter's every = 80 do not agree"),
        (
            ('"gps"\n', '"gps"\ndelay_ms = 110\n'),
            "delay_ms = 110 (44 steps) and the filter's delay = { least = 30, most = 50 } do not agree",
        ),
        (('"camera"\n', '"camera"\ndelay = 4\n'), "delay = 4 and the filter's delay = [4, 6] do not agree"),
        (('"gps"\n', '"gps"\ndropout = 0.2\n'), "dropout = 0.2 and the filter's dropout = 0.1 do not agree"),
        (('"gps"', '"gsp"'), "sensor 'gsp': it is none of the filter's, which are gps, camera, radio: give the name"),
        (("hr_hz = 400", "hr_hz = 100"), "hr_hz = 100 and the filter's dt = 0.0025 (400 Hz) do not agree: mend the"),
        (
            ("craft:vehicle", "craft:car"),
            "module 'craft' (craft.py) has no function 'car': it has vehicle, of_any_rate, nothing; name a",
        ),
        (("craft:vehicle", "craft:nothing"), "filter 'craft:nothing': nothing() returned a NoneType; name a"),
        (("craft:vehicle", "car:car"), "filter 'car:car': module 'car' cannot be imported"),
        (("craft:vehicle", "craft"), 'as in filter = "mymodule:my_filter" for a file mymodule.py in the folder of'),
        (('"craft:vehicle"', "3"), 'filter: must name a function that returns a filter: write filter = "module:func'),
        (("craft:vehicle", ""), 'filter: must name a function that returns a filter: write filter = "module:func'),
    ],
)
def test_what_does_not_agree_is_refused_with_both_values(folder: Path, change: tuple[str, str], said: str) -> None:
    with pytest.raises(InputError, match=re.escape(said)) as caught:
        read(folder, (HEAD + COSTS).replace(*change))
    assert str(caught.value).startswith("scenario '")


def test_a_filter_without_dt_is_of_any_rate(folder: Path) -> None:
    text = (HEAD + COSTS).replace("craft:vehicle", "craft:of_any_rate").replace("400", "100")
    only_gps = re.sub(r'\[\[sensor\]\]\nname = "(radio|camera)"\ncost = 0.2\n', "", text)
    assert [sensor.name for sensor in read(folder, only_gps).sensors] == ["gps"]


def test_reading_runs_no_code_unless_it_is_told_to(folder: Path) -> None:
    read(folder)
    with pytest.raises(InputError, match=r"filter = 'craft:vehicle' names a function, .* describe=studies.describe_"):
        read_scenario(folder / "v.toml")


def test_the_command_looks_in_the_folder_of_the_scenario(sched_sim: Run, folder: Path) -> None:
    below = folder / "below"
    below.mkdir()
    (folder / "craft.py").rename(below / "craft.py")
    (below / "v.toml").write_text(HEAD + COSTS)
    document = json.loads(sched_sim("simulate --scenario below/v.toml --format json").out)
    assert document["sensors"]["camera"]["every"] == 40 / 3
    (folder / "out.csv").symlink_to(below / "craft.py")
    said = ["--trace out.csv would write over what --scenario", "craft.py reads"]
    is_refused(sched_sim("simulate --scenario below/v.toml --trace out.csv"), said)
