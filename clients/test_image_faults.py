"""What stops an image: motors stop and have no current, the cause is told at the next start, once."""

import time

import pytest

import page
from image import Image, machines
from waiting import until
from wire import Frames, Lines

LAST_STOP = "last stop: "

# In which a watchdog that nobody feeds resets the board, and the start after that.
WATCHDOG_S = 5


def turn_module(endpoint):
    with Frames(endpoint) as frames:
        frames.order(1, 0, 0, 500)  # ROR
        frames.order(14, 0, 2, 1)  # SIO


def turn_stage(endpoint):
    with Lines(endpoint) as lines:
        lines.orders("EO=1 HSPD=5000 JX+ DO1=1")


TURN = {"pd42-1140": (turn_module, "OUT0"), "pmx-2ed": (turn_stage, "DO1"), "cmd-4cr": (turn_stage, "DO1")}


def turning(model, memory):
    """An image whose first axis moves, with current and an output on."""
    [table] = machines(model)
    image = Image(table, memory)
    turn, output = TURN[model]
    turn(image.endpoint)
    until(lambda: image.page.odometer(0) > 100, what="motion")
    assert image.read(output)
    assert has_current(image)
    return image


def has_current(image):
    """The coil current of the first axis, in the highest byte of its driver stage."""
    return image.page.word(page.DRIVES) >> 24 != 0


def assert_still(image):
    """No pulse comes."""
    before = image.page.word(page.PULSES)
    time.sleep(0.05)
    assert image.page.word(page.PULSES) == before


def assert_quiet(image):
    """No pulse comes, the motor has no current, nothing is driven."""
    assert_still(image)
    assert not has_current(image)
    outputs = [image.page.output(pin) for pin in range(len(image.table["pins"]))]
    assert not any(outputs), outputs


def causes(image):
    return [line.removeprefix(LAST_STOP) for line in image.said() if line.startswith(LAST_STOP)]


@pytest.mark.parametrize("model", TURN)
@pytest.mark.parametrize(
    ("poke", "cause"),
    [
        (page.FAIL_ASSERTION, "assertion failed"),
        (page.OVERRUN_STACK, "the stack has run over"),
        (page.BUS_FAULT, "bus fault"),
    ],
    ids=["assertion", "stack", "bus fault"],
)
def test_a_fault_stops_everything_and_is_told_once(model, poke, cause, tmp_path):
    with turning(model, tmp_path / "memory") as image:
        image.page.write(page.POKE, poke)
        until(lambda: image.page.word(page.STOPPED), what="the stop")
        until(lambda: cause.encode() in image.page.stored_cause(), what="the cause")
        starts = image.page.word(page.STARTS)
        assert_quiet(image)
        # It stays so: a motor does not start again by itself.
        time.sleep(1.2)
        assert image.page.word(page.STARTS) == starts and image.page.word(page.STOPPED)
        assert causes(image) == []

        image.kill()
        image.start()
        [told] = causes(image)
        assert cause in told
        assert image.page.word(page.START_CAUSE) == 0 and not image.page.word(page.STOPPED)
        image.power_cycle()
        assert len(causes(image)) == 1


@pytest.mark.parametrize("model", TURN)
def test_a_hang_ends_in_a_reset(model, tmp_path):
    with turning(model, tmp_path / "memory") as image:
        starts = image.page.word(page.STARTS)
        image.page.write(page.POKE, page.HANG)
        until(lambda: image.page.word(page.STARTS) > starts, timeout_s=WATCHDOG_S, what="the reset")
        assert_still(image)
        assert image.page.word(page.START_CAUSE) == 1
        assert ["watchdog" in cause for cause in causes(image)] == [True]
        image.power_cycle()
        assert image.page.word(page.START_CAUSE) == 0
        assert len(causes(image)) == 1


def test_the_console_says_who_starts(tmp_path):
    for model in TURN:
        [table] = machines(model)
        with Image(table, tmp_path / model) as image:
            assert image.said()[0].startswith(f"pulsetrain {model} ")
