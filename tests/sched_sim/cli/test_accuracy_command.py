"""`sched-sim accuracy`: the golden values, as a user sees them, and what it refuses.

Golden values: a constant velocity model and an inertial one, computed apart from this project (by a prototype that was
checked against conditioning of the joint Gaussian).
"""

from __future__ import annotations

import csv
import io
import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from sched_sim.cli.accuracy_flags import MODELS
from studies.selection.methods import COMPARED, METHODS
from tests.command_line import Run, is_refused


@pytest.fixture(autouse=True)
def own_models(tmp_path: Path) -> None:
    shutil.copy(Path(__file__).parent / "mine.py", tmp_path)


CV = "--model mine:cv -N 10 -M 4 --output 0"


def rows_of(sched_sim: Run, line: str) -> list[dict[str, Any]]:
    result = sched_sim(f"{line} --format json")
    assert result.code == 0, result.err
    rows: list[dict[str, Any]] = json.loads(result.out)
    return rows


@pytest.mark.parametrize(
    ("L", "worst", "rms"),
    [(4, 4.3914193770, 3.0568604591), (8, 5.9356719208, 4.3796113341), (14, 8.5345602732, None)],
)
def test_the_golden_values_of_constant_velocity(sched_sim: Run, L: int, worst: float, rms: float | None) -> None:
    method = "larsen" if L == 4 else "dual-rate"
    (row,) = rows_of(
        sched_sim, f"accuracy {CV} --method {method} -L {L}" if L > 4 else f"accuracy {CV} --method larsen"
    )
    assert (row["L"], row["verdict"]) == (L, "exact")
    assert row["worst_std"] == pytest.approx(worst, abs=5e-11)
    if rms is not None:
        assert row["rms_std"] == pytest.approx(rms, abs=5e-11)
    assert row["oldest_age_steps"] == 10 + L - 1
    assert row["oldest_age_ms"] is None


@pytest.mark.parametrize("method", ["recalculate", "larsen", "clone", "carried-gain"])
def test_the_golden_value_of_two_on_their_way(sched_sim: Run, method: str) -> None:
    (row,) = rows_of(sched_sim, f"accuracy --model mine:cv -N 10 -M 14 --output 0 --method {method}")
    assert (row["L"], row["verdict"]) == (14, "exact")
    assert row["worst_std"] == pytest.approx(8.5345602732, abs=5e-11)


@pytest.mark.parametrize(("L", "worst"), [(44, 0.37293412), (60, 0.37905887), (80, 0.38684844)])
def test_the_golden_values_of_inertial_navigation(sched_sim: Run, L: int, worst: float) -> None:
    method = "recalculate" if L == 44 else "delayed-horizon"
    (row,) = rows_of(sched_sim, f"accuracy --model ins-gps --method {method} {'' if L == 44 else f'-L {L}'}")
    assert row["worst_std"] == pytest.approx(worst, abs=5e-9)
    assert (row["unit"], row["output"], row["N"], row["M"]) == ("m", "position", 80, 44)
    assert row["reaction_ms"] == pytest.approx(2.5 * L)
    assert row["oldest_age_ms"] == pytest.approx(2.5 * (80 + L - 1))


def test_a_fix_taken_for_a_new_one_is_biased(sched_sim: Run) -> None:
    (row,) = rows_of(sched_sim, "accuracy --model ins-gps --method fuse-as-fresh --motion 15,0,0")
    assert row["bias"] == pytest.approx(1.65, abs=1e-9)
    assert row["verdict"] == "approximate"
    (row,) = rows_of(sched_sim, f"accuracy {CV} --method fuse-as-fresh --motion 1 --hr-hz 1")
    assert row["bias"] == pytest.approx(4.0, abs=1e-9)
    assert row["worst_std"] == pytest.approx(3.0236226199, abs=5e-11)


def test_noise_that_is_only_summed(sched_sim: Run) -> None:
    """Q', Eq. 23: it believes less than is true."""
    (row,) = rows_of(sched_sim, f"accuracy {CV} --method dual-rate -L 8 --low-rate-noise sum")
    assert row["worst_std"] == pytest.approx(5.9479485258, abs=5e-11)
    assert (row["verdict"], row["believed_std"] is None) == ("approximate", False)


@pytest.mark.parametrize(
    ("model", "second", "late"),
    [("ins-gps", 36, 3.7), ("ins-rtk", 44, 13.8), ("star-tracker", 22, 0.09), ("camera", 83, 27.6)],
)
def test_landing_late_costs_less_than_leaving_measurements_out(
    sched_sim: Run, model: str, second: float, late: float
) -> None:
    rows = rows_of(sched_sim, f"accuracy --model {model} --every 1:2 --method larsen --method delayed-horizon")
    of = {(row["method"], row["every"]): row["worst_std"] for row in rows}
    assert 100 * (of["larsen", 2] / of["larsen", 1] - 1) == pytest.approx(second, abs=0.5)
    assert 100 * (of["delayed-horizon", 1] / of["larsen", 1] - 1) == pytest.approx(late, abs=0.05)


def test_px4s_smoothing(sched_sim: Run) -> None:
    """It costs accuracy, more of it with a longer time constant."""
    rows = rows_of(sched_sim, f"accuracy {CV} --hr-hz 100 --method larsen --method px4-predictor")
    (slower,) = rows_of(sched_sim, f"accuracy {CV} --hr-hz 100 --method px4-predictor --tau 0.5")
    assert rows[0]["worst_std"] < rows[1]["worst_std"] < slower["worst_std"]


def test_a_processor_says_where_corrections_land(sched_sim: Run) -> None:
    line = "accuracy --model ins-gps --method dual-rate --method recalculate --processor"
    late, none = rows_of(sched_sim, f"{line} cortex-m4f --low-rate-noise sum")
    (minimum,) = rows_of(
        sched_sim,
        "minimum -N 80 -M 44 --hr-hz 400 --method dual-rate --low-rate-noise sum --costs counted-9-3-3 "
        "--processor cortex-m4f",
    )
    assert late["L"] == minimum["achieved_l"]
    assert (none["L"], none["worst_std"], none["verdict"]) == (None, None, None)
    assert "misses deadlines on cortex-m4f" in none["remark"]
    table = sched_sim(f"{line} cortex-m4f").out
    assert "does not land" in table
    assert "recalculate: misses deadlines on cortex-m4f and does not land" in table
    (fast,) = rows_of(sched_sim, "accuracy --model ins-gps --method dual-rate --speed 2")
    assert fast["L"] == 45


def test_a_model_of_its_own_size_is_counted(sched_sim: Run) -> None:
    """Two states on a Cortex-M0+: the counts of nine would not run there."""
    (row,) = rows_of(sched_sim, f"accuracy {CV} --hr-hz 200 --method dual-rate --processor cortex-m0plus")
    assert row["L"] == 5


def test_a_system_is_linearised_where_it_says(sched_sim: Run) -> None:
    figures = [
        rows_of(sched_sim, f"accuracy --model mine:{name} -N 10 -M 4 --output 0 --method larsen")[0]["worst_std"]
        for name in ("cv", "cv_system", "cv_system_at")
    ]
    assert figures == [pytest.approx(4.3914193770, abs=5e-11)] * 3


def test_along_a_trajectory_of_a_constant_model_it_is_the_same(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "path.csv").write_text("position,velocity\n" + "0,1\n" * 200, encoding="utf-8")
    line = "accuracy --model mine:cv_system -N 10 -M 4 --output 0 --method larsen --method standard"
    constant = rows_of(sched_sim, line)
    along = rows_of(sched_sim, f"{line} --trajectory path.csv")
    assert [row["worst_std"] for row in along] == pytest.approx([row["worst_std"] for row in constant], rel=1e-9)
    assert all(row["median_std"] < row["p95_std"] <= row["worst_std"] for row in along)
    table = sched_sim(f"{line} --trajectory path.csv").out
    assert "over steps 4 to 199 of the trajectory" in table
    given = rows_of(sched_sim, f"{line} --trajectory path.csv --initial-std 100,0")
    assert given[0]["worst_std"] > along[0]["worst_std"]


def test_a_mode_that_is_not_seen_is_refused_but_not_along_a_trajectory(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "path.csv").write_text("0,0\n" * 100, encoding="utf-8")
    line = "accuracy --model mine:hover_system -N 10 -M 4 --output 0:2"
    is_refused(sched_sim(line), ["--output 0:2", "state 1", "give --trajectory"])
    is_refused(sched_sim(f"{line} --trajectory path.csv"), ["--initial-std is missing", "2 states"])
    rows = rows_of(sched_sim, f"{line} --trajectory path.csv --initial-std 1,0.1 --method larsen")
    assert rows[0]["worst_std"] ** 2 == pytest.approx(0.01 + 0.01 * 99, rel=0.5)
    assert len(rows_of(sched_sim, "accuracy --model mine:hover_system -N 10 -M 4 --output 0 --method larsen")) == 1


def test_csv_has_the_columns_of_json(sched_sim: Run) -> None:
    line = f"accuracy {CV} --hr-hz 10 --motion 1"
    rows = rows_of(sched_sim, line)
    table = list(csv.DictReader(io.StringIO(sched_sim(f"{line} --format csv").out)))
    assert list(table[0]) == list(rows[0])
    assert [row["method"] for row in table] == list(COMPARED)


def test_each_method_can_be_asked_for(sched_sim: Run) -> None:
    asked = " ".join(f"--method {name}" for name in METHODS)
    rows = rows_of(sched_sim, f"accuracy {CV} --hr-hz 10 --motion 1 {asked}")
    verdicts = {row["method"]: row["verdict"] for row in rows}
    assert verdicts.pop("discard") == "diverges"
    assert set(verdicts.values()) == {"exact", "approximate"}
    assert {row["method"]: row["L"] for row in rows}["discard"] is None
    assert "grows" in sched_sim(f"accuracy {CV} --method discard").out


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("-N 10 -M 4", ["--model is missing", MODELS]),
        ("--model nix", ["--model 'nix' is unknown", "ins-gps", "package.module:function"]),
        (
            "--model mine:gone -N 10 -M 4 --output 0",
            ["--model 'mine:gone'", "(mine.py) has no function 'gone': it has"],
        ),
        ("--model mine:hovers -N 10 -M 4 --output 0", ["no function 'hovers': did you mean hover?"]),
        ("--model mine:nothing -N 10 -M 4 --output 0", ["--model 'mine:nothing'", "returned a int"]),
        (
            "--model mine:fails -N 10 -M 4 --output 0",
            ["--model 'mine:fails'", "RuntimeError: the battery is flat (mine.py, line"],
        ),
        ("--model mine:singular -N 10 -M 4 --output 0", ["--model 'mine:singular'", ": R is not positive definite"]),
        ("--model mine:nan -N 10 -M 4 --output 0", ["--model 'mine:nan'", "Phi", "not finite", "give numbers"]),
        ("--model mine:infinite_system -N 10 -M 4 --output 0", ["--model 'mine:infinite_system'", "not finite"]),
        ("--model mine:wrong_shape -N 10 -M 4 --output 0", ["--model 'mine:wrong_shape'", "H has shape (1, 3)"]),
        ("--model mine:hover -N 10 -M 4 --output 0:2", ["--output 0:2", "a mode of yaw", "ask for other outputs"]),
        ("--model mine:cv -N 10 -M 4", ["--output is missing", "position=0:3", "the states 0 to 1"]),
        ("--model mine:cv -N 10 -M 4 --output p=0:5", ["--output p=0:5", "the states 0 to 1"]),
        ("--model mine:cv -N 10 -M 4 --output 3", ["--output 3 is not of this model", "the states 0 to 1"]),
        ("--model mine:cv -N 10 -M 4 --output -1", ["--output -1", "the states 0 to 1"]),
        ("--model mine:cv -N 10 -M 4 --output 0:99999999", ["--output 0:99999999", "at most 200"]),
        ("--model mine:cv -N 10 -M 4 --output 2:1", ["'2:1' holds no state"]),
        ("--model mine:cv -N 10 -M 4 --output 0,0", ["--output 0,0: state 0", "twice", "give each state once"]),
        ("--model ins-gps --output p=0:3,1", ["--output p=0:3,1: state 1", "twice", "give each state once"]),
        ("--model mine:cv -N 10 -M 4 --output =0", ["has no name before the = sign"]),
        ("--model ins-gps --output speed", ["'speed' are no states", "one of position, velocity, tilt"]),
        ("--model mine:cv -N 10 --output 0", ["-M is missing", "--delay-ms"]),
        ("--model mine:cv -M 4 --output 0", ["-N is missing", "--measurement-hz"]),
        ("--model mine:cv -N 0 -M 4 --output 0", ["-N is 0", "at least 1"]),
        ("--model mine:cv -N 10 -M -4 --output 0", ["-M is -4", "0 or more"]),
        ("--model mine:cv -N 9000000 -M 4 --output 0", ["-N", "--every", "at most"]),
        ("--model mine:cv -N 10 -M 4 --output 0 --delay-ms 5", ["--delay-ms without --hr-hz"]),
        ("--model ins-gps -M 5 --delay-ms 10", ["-M 5 and --delay-ms 10 do not agree"]),
        ("--model ins-gps --land-within-ms 50", ["--land-within-ms is 50", "not be less than the delay"]),
        ("--model ins-gps --every 0", ["--every '0'", "at least 1"]),
        ("--model ins-gps --every 1:200", ["--every 1:200", "200 numbers", "at most 100"]),
        ("--model ins-gps --motion 15,0", ["--motion 15,0", "2 numbers", "measures 3", "--motion 15,0,0"]),
        ("--model ins-gps --motion 15,0,x", ["--motion 15,0,x", "'x'", "finite number"]),
        (f"{CV} --motion 1", ["--motion 1 without --hr-hz"]),
        (f"{CV} --method fuse-as-fresh --hr-hz 5", ["--method fuse-as-fresh", "give --motion 15, how fast"]),
        ("--model ins-gps --method fuse-as-fresh", ["--method fuse-as-fresh", "give --motion 15,0,0, how fast"]),
        (f"{CV} --method px4-predictor", ["--method px4-predictor", "give --hr-hz 400"]),
        (f"{CV} --method kalman", ["--method 'kalman' is unknown", "larsen"]),
        (f"{CV} --tau 0 --hr-hz 5", ["--tau is 0", "greater than 0"]),
        (f"{CV} --tau nan --hr-hz 5", ["--tau is 'nan'"]),
        (f"{CV} -L 4", ["-L 4 is before", "dual-rate", "give -L 5 or more"]),
        (f"{CV} -L 8 --speed 3", ["-L 8 and --speed 3 exclude each other"]),
        (f"{CV} --speed 3 --processor leon3", ["--speed 3 and --processor leon3 exclude each other"]),
        (f"{CV} --processor leon3", ["--processor leon3 without --hr-hz"]),
        (f"{CV} --hr-hz 5 --method larsen --tau 5", ["--tau changes nothing of --method larsen", "px4-predictor"]),
        (f"{CV} --hr-hz 5 --method larsen --motion 5", ["--motion changes nothing", "add --method fuse-as-fresh"]),
        (f"{CV} --method larsen -L 8", ["-L changes nothing of --method larsen", "dual-rate and delayed-horizon"]),
        (f"{CV} --method larsen --low-rate-noise sum", ["--low-rate-noise changes nothing of", "it is for dual-rate"]),
        (
            "--model ins-gps --processor cortex-m0plus",
            ["misses deadlines on cortex-m0plus", "give a faster", "--every 2"],
        ),
        (f"{CV} --speed 0", ["--speed is 0"]),
        (f"{CV} --speed 0.001 --method larsen", ["larsen", "does not land"]),
        (f"{CV} --costs steffes2014", ["--costs without --speed or --processor"]),
        (f"{CV} --gain precomputed --cpus 2", ["--gain, --cpus without --speed or --processor"]),
        (f"{CV} --initial-std 1,1", ["--initial-std without --trajectory", "give --trajectory FILE.csv, or leave"]),
        (f"{CV} --trajectory path.csv", ["--trajectory 'path.csv' is for a System", "mine:cv is constant"]),
        ("--model mine:cv_system -N 10 -M 4 --output 0 --trajectory gone.csv", ["--trajectory 'gone.csv' not found"]),
        (
            "--model mine:cv_system -N 10 -M 4 --output 0 --trajectory path.csv --motion 1",
            ["--motion and --trajectory exclude each other"],
        ),
        (
            "--model mine:cv_system -N 10 -M 4 --output 0 --trajectory mine.py",
            ["--trajectory 'mine.py', line 3", "no numbers between commas"],
        ),
    ],
)
def test_what_cannot_be_is_refused(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(f"accuracy {line}"), said)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0,1\n0\n", ["line 2", "1 numbers", "the 2 states", "the 1 inputs"]),
        ("0,1\n0,1,0\n", ["line 2", "3 numbers, and 2 in the rows before"]),
        ("0,1\n0,nan\n", ["line 2", "not finite"]),
        ("a,b\n0,1\n", ["has 1 rows of numbers"]),
        ("0,1\n" * 5, ["has 4 steps", "in step 5", "longer one"]),
    ],
)
def test_a_trajectory_that_is_none(sched_sim: Run, tmp_path: Path, text: str, said: list[str]) -> None:
    (tmp_path / "path.csv").write_text(text, encoding="utf-8")
    line = "accuracy --model mine:cv_system -N 10 -M 4 --output 0 --trajectory path.csv -L 5"
    is_refused(sched_sim(line), ["--trajectory", *said])


def test_a_sweep_says_where_its_costs_are_of_another_size(sched_sim: Run) -> None:
    line = "sweep -N 50 -M 20 -L 50 --model star-tracker --costs counted-9-3-3 --method dual-rate --format json"
    assert "are of 9 states, and --model has 2" in sched_sim(line).err
    assert "--model has" not in sched_sim(line.replace("star-tracker", "ins-gps")).err


def test_what_is_empty_in_each_row_is_no_column_and_a_narrow_table_is_one(
    sched_sim: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = sched_sim("accuracy --model ins-gps --method larsen").out
    assert not {"believed", "bias"} & set(shown.splitlines()[2].split())
    monkeypatch.setenv("COLUMNS", "80")
    for line in ("accuracy --model ins-gps", "design --within 0.38 --model ins-gps"):
        narrow = sched_sim(line).out
        assert "left out, as COLUMNS is 80" in narrow
        assert max(map(len, narrow.splitlines())) <= 80


def test_a_sweep_says_which_methods_have_no_accuracy_in_it(sched_sim: Run) -> None:
    line = "sweep -N 50 -M 20 -L 50 --model ins-gps --costs counted-9-3-3 --format json --method px4-predictor"
    both = sched_sim(f"{line} --method fuse-as-fresh").err
    assert "worst_std and rms_std are empty of fuse-as-fresh: its error is how far" in both
    assert "accuracy --method fuse-as-fresh --motion" in both
    assert "empty" not in sched_sim(line).err
    own = (
        "sweep -N 50 -M 20 -L 50 --model mine:cv --output 0 --costs counted-9-3-3 --method px4-predictor --format json"
    )
    assert "empty of px4-predictor: its time constant is in seconds: give --hr-hz" in sched_sim(own).err
