"""The same program in an image and in virtual time: the same pulses, at the same moments."""

import pathlib
import re
import subprocess

import pytest

import page
from image import EXAMPLES, Image, machines
from server import pulsetrain
from waiting import until
from wire import Frames, Lines

PROGRAMS = pathlib.Path(__file__).parent / "programs"
SAMPLES = pathlib.Path(__file__).parents[1] / "examples"

# Rounding to ticks of the timer, to either side.
TOLERANCE_TICKS = 2

STOP, RUN, BEGIN_DOWNLOAD, END_DOWNLOAD = 128, 129, 132, 133


def simulated(model, binary):
    """The pulses of a program in virtual time: axis, whether it goes up, clock."""
    command = [EXAMPLES / "pulses", model, binary]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return [(int(axis), sign == "+", int(clock)) for axis, sign, clock in map(str.split, lines)]


def run_tmcl(endpoint, source, binary):
    """Downloads a program, and the next time starts it."""
    pulsetrain("asm", str(source), "-o", str(binary))
    data = binary.read_bytes()
    with Frames(endpoint) as frames:
        frames.order(STOP)
        frames.order(BEGIN_DOWNLOAD)
        for at in range(0, len(data), 8):
            opcode, kind, motor, *value = data[at : at + 7]
            frames.order(opcode, kind, motor, int.from_bytes(bytes(value), "big"))
        frames.order(END_DOWNLOAD)
        yield
        frames.order(RUN)
        yield


def run_ascript(model, start):
    def run(endpoint, source, binary):
        listing = pulsetrain("compile", str(source), "--device", model, "-o", str(binary), "--list")
        with Lines(endpoint) as lines:
            for number, line in re.findall(r"^ *(\d+)  (.*?) *(?:;.*)?$", listing, re.MULTILINE):
                lines.order(f"SA{number}={line}")
            yield
            lines.order(start)
            yield

    return run


RUN_ON = {
    "pd42-1140": run_tmcl,
    "pmx-2ed": run_ascript("pmx-2ed", "SR0=1"),
    "cmd-4cr": run_ascript("cmd-4cr", "SACTRL0=1"),
}


@pytest.mark.parametrize(
    ("model", "source"),
    [
        ("pd42-1140", PROGRAMS / "ramps.tmc"),
        ("pd42-1140", PROGRAMS / "count.tmc"),
        ("pd42-1140", SAMPLES / "tmcl/there_and_back.tmc"),
        ("pmx-2ed", PROGRAMS / "line.prg"),
        ("pmx-2ed", SAMPLES / "ascript/performax/counted_moves.prg"),
        ("cmd-4cr", PROGRAMS / "contour.prg"),
    ],
    ids=lambda value: value.stem if isinstance(value, pathlib.Path) else value,
)
def test_pulses_are_those_of_the_simulator(model, source, tmp_path):
    [table] = machines(model)
    with Image(table, tmp_path / "memory", rush=True) as image:
        image.page.log(page.LOG_ENTRIES)
        binary = tmp_path / "program.bin"
        running = RUN_ON[model](image.endpoint, source, binary)
        next(running)
        # Time stood still while the flash was erased.
        slipped = image.page.settled(page.SLIPPED_TICKS)
        next(running)
        expected = simulated(model, binary)
        seconds = expected[-1][2] / table["clock_hz"]
        until(lambda: image.page.word(page.LOGGED) >= len(expected), timeout_s=5 + 10 * seconds, what="the last pulse")
        image.settle()
        played, hz = image.page.logged(), image.page.word(page.TIMER_HZ)
        slipped = image.page.settled(page.SLIPPED_TICKS) - slipped
    assert len(played) == len(expected)
    first_clock, first_due = min(clock for *_, clock in expected), min(pulse.due for pulse in played)
    for axis in range(len(table["axes"])):
        of_axis = [pulse for pulse in played if pulse.axis == axis]
        planned = [(positive, clock) for other, positive, clock in expected if other == axis]
        assert [pulse.positive for pulse in of_axis] == [positive for positive, _ in planned]
        # Where the main loop was late, all that follows is; nothing is ever early, or closer than planned.
        behind = 0
        for pulse, (_, clock) in zip(of_axis, planned, strict=True):
            due = first_due + (clock - first_clock) * hz / table["clock_hz"]
            assert pulse.due - due >= behind - 2 * TOLERANCE_TICKS, (pulse, due, behind)
            behind = max(behind, pulse.due - due)
        assert behind <= slipped + TOLERANCE_TICKS, f"{behind} ticks behind, and {slipped} are accounted for"
