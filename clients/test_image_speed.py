"""How many instructions a step takes: QEMU counts them, so the figures are the same on every host."""

import math
import time

import pytest

import page
from image import INSTRUCTION_SHIFT, Image, machines, note
from waiting import until
from wire import Frames, Lines

# About this speed is measured at, in steps a second.
SPEED = 100_000
SECONDS = 1


def cruise_module(endpoint):
    with Frames(endpoint) as frames:
        frames.order(5, 154, 0, 1)  # SAP pulse divisor
        frames.order(5, 5, 0, 2047)  # SAP maximum acceleration
        frames.order(1, 0, 0, SPEED * (2 * 2048 * 32) // 16_000_000)  # ROR


def cruise_stage(endpoint):
    with Lines(endpoint) as lines:
        lines.orders(f"EO=1 HSPD={SPEED} LSPD=1000 ACC=100 JX+")


CRUISE = {"pd42-1140": cruise_module, "pmx-2ed": cruise_stage, "cmd-4cr": cruise_stage}


def measured(image):
    """A second's ticks of the main loop and of the player's interrupt, and its pulses."""
    words = page.TIME, page.AWAKE_TICKS, page.PLAYER_TICKS, page.EDGES
    before = [image.page.settled(word) for word in words]
    time.sleep(SECONDS)
    ticks, *figures = (image.page.settled(word) - start for word, start in zip(words, before))
    seconds = ticks / image.page.word(page.TIMER_HZ)
    return [figure / seconds for figure in figures]


@pytest.mark.parametrize("model", CRUISE)
def test_instructions_a_step(model, tmp_path):
    [table] = machines(model)
    with Image(table, tmp_path / "memory", rush=True) as image:
        # At no time does an input change.
        for number, pin in enumerate(table["pins"]):
            image.page.put(number, pin | {"zone": None}, None)
        idle_loop, idle_player, none = measured(image)
        assert none == 0
        CRUISE[model](image.endpoint)
        until(lambda: image.page.odometer(0) > SPEED // 2, what="the speed")
        loop, player, pulses = measured(image)
        instruction_ticks = image.page.word(page.TIMER_HZ) * 2**INSTRUCTION_SHIFT / 1e9
    assert 0.8 * SPEED < pulses < 1.1 * SPEED
    # `cargo xtask firmware` knows how many there may be.
    note(
        model=model,
        instructions_a_step=math.ceil((player - idle_player) / pulses / instruction_ticks),
        instructions_in_all=math.ceil((player - idle_player + loop - idle_loop) / pulses / instruction_ticks),
    )
