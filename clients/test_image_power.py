"""The power goes at any moment, most often in the middle of a store: QEMU is killed and started again."""

import random
import threading

import pytest

from image import Image, machines
from wire import Frames, Lines

SEED = 20
# A store takes milliseconds, and now and then the erasure of pages.
SOONEST_S, LATEST_S = 0.005, 0.25


class Workload:
    """Stores values until the power goes. `kept` is what was acknowledged last, by place; `trying` what was on its
    way then."""

    def __init__(self, dice):
        self.dice, self.kept, self.trying = dice, {}, {}

    def run_until_cut(self, image, rounds_s):
        timer = threading.Timer(rounds_s, image.kill)
        timer.start()
        try:
            with self.wire(image.endpoint) as wire:
                while True:
                    self.trying = self.changes()
                    self.store(wire, self.trying)
                    self.kept |= self.trying
                    self.trying = {}
        except OSError:
            pass
        finally:
            timer.join()

    def check(self, image):
        """Everything is as it was acknowledged, or as it was being made."""
        with self.wire(image.endpoint) as wire:
            found = {place: self.load(wire, place) for place in self.kept | self.trying}
        for place, value in found.items():
            allowed = {values[place] for values in (self.kept, self.trying) if place in values}
            assert value in allowed or place not in self.kept, f"{place} is {value}, not one of {allowed}"
        self.check_together(found)
        self.kept, self.trying = found, {}

    def check_together(self, found):
        """What must be true of all values together."""


class Variables(Workload):
    """TMCL: user variables and an axis parameter, each stored by itself."""

    wire = Frames
    PARAMETER = "maximum current"
    SET_AXIS, GET_AXIS, STORE_AXIS, SET, GET, STORE = 5, 6, 7, 9, 10, 11

    def changes(self):
        if self.dice.random() < 0.2:
            return {self.PARAMETER: self.dice.randrange(256)}
        return {self.dice.randrange(56): self.dice.randrange(-(2**31), 2**31)}

    def store(self, wire, changes):
        for place, value in changes.items():
            if place == self.PARAMETER:
                wire.order(self.SET_AXIS, 6, 0, value)
                wire.order(self.STORE_AXIS, 6, 0)
            else:
                wire.order(self.SET, place, 2, value)
                wire.order(self.STORE, place, 2)

    def load(self, wire, place):
        return wire.order(self.GET_AXIS, 6) if place == self.PARAMETER else wire.order(self.GET, place, 2)


class Settings(Workload):
    """Performax and Commander: `STORE` is for all settings at once, all old or all new."""

    wire = Lines

    def __init__(self, dice, variables):
        super().__init__(dice)
        self.variables = variables

    def changes(self):
        # All the same, so that a mixture would show.
        value = self.dice.randrange(-(2**31), 2**31)
        return {f"V{number}": value for number in self.variables}

    def store(self, wire, changes):
        for place, value in changes.items():
            wire.order(f"{place}={value}")
        wire.order("STORE")

    def load(self, wire, place):
        return wire.number(place)

    def check_together(self, found):
        assert len(set(found.values())) <= 1, f"a mixture of two stores: {found}"


class Program(Workload):
    """Performax and Commander: lines of the program, each stored by itself."""

    wire = Lines

    def changes(self):
        return {self.dice.randrange(60): f"V{self.dice.randrange(32)} = {self.dice.randrange(10**6)}"}

    def store(self, wire, changes):
        for number, line in changes.items():
            wire.order(f"SA{number}={line}")

    def load(self, wire, number):
        return wire.ask(f"SA{number}")


@pytest.mark.parametrize(
    ("model", "workload", "rounds"),
    [
        ("pd42-1140", Variables, 25),
        ("pmx-2ed", lambda dice: Settings(dice, [32, 47, 63]), 12),
        ("pmx-2ed", Program, 8),
        ("cmd-4cr", lambda dice: Settings(dice, [50, 75, 99]), 8),
        ("cmd-4cr", Program, 8),
    ],
    ids=["pd42-1140", "pmx-2ed settings", "pmx-2ed program", "cmd-4cr settings", "cmd-4cr program"],
)
def test_what_was_acknowledged_is_there_after_the_power_went(model, workload, rounds, tmp_path):
    dice = random.Random(f"{SEED} {model} {rounds}")
    load = workload(dice)
    [table] = machines(model)
    with Image(table, tmp_path / "memory") as image:
        for _ in range(rounds):
            load.run_until_cut(image, dice.uniform(SOONEST_S, LATEST_S))
            image.start()
            load.check(image)
        assert len(load.kept) > 2, "hardly anything was stored"
