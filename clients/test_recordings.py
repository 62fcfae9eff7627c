"""Recordings, read by the tools that people have."""

import csv
import pathlib
import subprocess
import sys

import duckdb
import pandas
import pyarrow.parquet
import pytest

from server import PROGRAM

ROOT = pathlib.Path(__file__).parents[1]
PULSES = 80_000
# How much more memory a recording of five times the length may take.
GROWTH_KIB = 2048

pytestmark = pytest.mark.server_only


@pytest.fixture(scope="module")
def recordings(tmp_path_factory):
    """A move of one axis to 40,000 and back, as a table of text and as Parquet."""
    folder = tmp_path_factory.mktemp("recordings")
    files = {kind: folder / f"move.{kind}" for kind in ("csv", "parquet")}
    program = ROOT / "examples/tmcl/there_and_back.tmc"
    command = [PROGRAM, "run", program, "--device", "pd42-1140"]
    for file in files.values():
        command += ["--record", file]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return files


def test_pulses_are_in_order_and_complete(recordings):
    table = pyarrow.parquet.read_table(
        recordings["parquet"], filters=[("event", "==", "pulse")], columns=["time_ns", "axis", "odometer"]
    )
    assert table.num_rows == PULSES
    assert all(column.null_count == 0 for column in table.columns)
    assert table["axis"].unique().to_pylist() == ["0"]
    odometer = table["odometer"].to_pylist()
    assert odometer == [*range(1, PULSES // 2 + 1), *range(PULSES // 2 - 1, -1, -1)]
    times = table["time_ns"].to_pylist()
    assert all(before < after for before, after in zip(times, times[1:]))


def test_samples_are_those_of_the_text(recordings):
    samples = pandas.read_parquet(recordings["parquet"], filters=[("event", "==", "sample")])
    with open(recordings["csv"], newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["event"] == "sample"]
    assert len(samples) == len(rows) > 1900
    for column in ("position", "encoder", "target", "status", "steps"):
        assert samples[column].dtype.kind == "i", "no gaps"
        assert samples[column].tolist() == [int(row[column]) for row in rows]
    assert samples["speed"].tolist() == [float(row["speed"]) for row in rows]
    seconds = [float(row["seconds"]) for row in rows]
    assert (samples["time_ns"] / 1e9).tolist() == pytest.approx(seconds, abs=1e-9)


def test_events_are_those_of_the_text(recordings):
    others = ~pandas.read_parquet(recordings["parquet"], columns=["event"])["event"].isin(["sample", "pulse"])
    events = pandas.read_parquet(recordings["parquet"])[others]
    with open(recordings["csv"], newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["event"] != "sample"]
    for column in ("event", "axis", "pin", "unit", "text"):
        assert events[column].fillna("").tolist() == [row[column] for row in rows]


def test_a_database_counts_the_pulses(recordings):
    query = "SELECT axis, count(*), max(odometer) FROM read_parquet(?) WHERE event = 'pulse' GROUP BY axis"
    assert duckdb.execute(query, [str(recordings["parquet"])]).fetchall() == [("0", PULSES, PULSES // 2)]


def test_a_plot_of_each_is_a_picture(recordings, tmp_path):
    for kind, file in recordings.items():
        for extension, magic in (("png", b"\x89PNG"), ("svg", b"<svg")):
            picture = tmp_path / f"{kind}.{extension}"
            subprocess.run([PROGRAM, "plot", file, "-o", picture], check=True)
            assert picture.read_bytes().startswith(magic)


# A process begins with the memory of the one that starts it, which is why that is a small one.
MEASURE = """
import os, sys
process = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ)
_, status, usage = os.wait4(process, 0)
print(usage.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status))
"""


def peak_kib(*arguments):
    """The most memory that the program had while it ran."""
    command = [sys.executable, "-I", "-S", "-c", MEASURE, PROGRAM, *arguments]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    return int(output.split()[-1]) // (1024 if sys.platform == "darwin" else 1)


@pytest.mark.parametrize("kind", ["csv", "parquet", "vcd", "mcap", "png", "svg"])
def test_memory_does_not_grow_with_the_length(kind, tmp_path):
    program = ROOT / "examples/tmcl/endless_moves.tmc"
    option = "--plot" if kind in ("png", "svg") else "--record"

    def peak(seconds):
        file = tmp_path / f"{seconds}.{kind}"
        used = peak_kib("run", program, "--device", "pd42-1140", "--for", f"{seconds}", option, file)
        size = file.stat().st_size
        file.unlink()
        return used, size

    # Parquet fills a group of rows first.
    seconds = 100 if kind == "parquet" else 10
    (shorter, size), (longer, longer_size) = peak(seconds), peak(5 * seconds)
    assert longer < shorter + GROWTH_KIB
    # What is drawn has as many points in the end.
    assert option == "--plot" or longer_size > 4 * size
