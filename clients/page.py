"""The memory that an emulated board shares with its bench: a flash, a page of numbers, and a log of pulses.

The image writes what its pins do and what it measures of itself; the bench writes what is on its inputs. The
board's half, which says what the numbers mean, is `firmware/boards/mps2-an386/src/bench/page.rs`.
"""

import collections
import mmap
import struct

BYTES = 16 << 20
PAGE, LOG = 0x10_0000, 0x20_0000
LOG_ENTRIES = 0xE0_0000 // 16

MAGIC = 0x5054_5242
NOT_DRIVEN = 0x8000_0000

# Words of the page.
READY, STARTS, POKE, STACK_UNUSED, STACK_SIZE, SLIPS = 0, 1, 2, 3, 4, 5
SLIPPED_TICKS, AWAKE_TICKS, PLAYER_TICKS, EDGES, TIME, SPIN = 6, 8, 10, 12, 48, 50
TIMER_HZ, LOG_ROOM, LOGGED, START_CAUSE, STOPPED, FLASH_BYTES = 16, 18, 19, 20, 21, 22
CAUSE_BYTES = 256
# The first words of its tables, by axis, pin or channel.
ODOMETERS, PULSES, DRIVES, OUTPUTS, INPUTS, ENCODERS = 0x18, 0x20, 0x28, 0x40, 0xC0, 0x4C0
INPUT_WORDS, ENCODER_WORDS = 8, 4

# What may be on an input, and what may turn an encoder.
NOTHING, VALUE, ZONE = 0, 1, 2
FOLLOWS = 2

# What may be done to an image, for the word that pokes it.
FAIL_ASSERTION, HANG, OVERRUN_STACK, BUS_FAULT = 1, 2, 3, 4

Pulse = collections.namedtuple("Pulse", "due axis positive late")
INT32 = range(-(2**31), 2**31)


def signed(word):
    return word - (1 << 32) if word >> 31 else word


def in_range(value):
    """The nearest value of 32 bits."""
    return max(INT32[0], min(INT32[-1], value))


class Page:
    """The memory in a file, which outlives the image."""

    def __init__(self, path):
        self.path = path
        with open(path, "a+b") as file:
            file.truncate(BYTES)
            self._memory = mmap.mmap(file.fileno(), BYTES)

    def word(self, number, count=1):
        """A number without sign, of several words with the lowest first."""
        at = PAGE + 4 * number
        return int.from_bytes(self._memory[at : at + 4 * count], "little")

    def write(self, number, *values):
        for at, value in enumerate(values, PAGE // 4 + number):
            struct.pack_into("<I", self._memory, 4 * at, value & 0xFFFF_FFFF)

    def settled(self, number, count=2):
        """A number of several words that the image may be writing just now."""
        while (value := self.word(number, count)) != self.word(number, count):
            pass
        return value

    def stored_cause(self):
        """What lies in the flash behind the settings: why the image stopped."""
        at = self.word(FLASH_BYTES)
        return self._memory[at : at + CAUSE_BYTES]

    def odometer(self, axis):
        return signed(self.word(ODOMETERS + axis))

    def log(self, room):
        """The next so many pulses will be logged."""
        self.write(LOG_ROOM, 0)
        self.write(LOGGED, 0)
        self.write(LOG_ROOM, room)

    def logged(self):
        """The pulses of the log, in their order."""
        entries = (struct.unpack_from("<QII", self._memory, LOG + 16 * at) for at in range(self.word(LOGGED)))
        return [Pulse(due, what & 0xFF, bool(what >> 8), late) for due, what, late in entries]

    def wire(self, table):
        """Puts a machine behind the pins, as the simulator describes it."""
        for number, pin in enumerate(table["pins"]):
            self.put(number, pin, None)
        for channel, encoder in enumerate(table["encoders"]):
            words = FOLLOWS, encoder["axis"], encoder["numerator"], encoder["denominator"]
            self.write(ENCODERS + ENCODER_WORDS * channel, *words)

    def put(self, number, pin, value):
        """Puts a level or a number on a pin, or gives it back to the machine if the value is `None`."""
        zone = pin["zone"]
        if value is not None:
            words = VALUE, round(value * pin["scale"])
        elif zone is None:
            words = VALUE, pin["rest"]
        else:
            first, last = in_range(zone["first"]), in_range(zone["last"])
            words = ZONE, zone["axis"], first, last, zone["every"] or 0, pin["rest"]
        at = INPUTS + INPUT_WORDS * number
        if self.word(at) != words[0]:
            # The image never sees a kind with the numbers of another.
            self.write(at, NOTHING)
        self.write(at + 1, *words[1:])
        self.write(at, words[0])

    def output(self, number):
        """What the image drives on a pin, or `None`."""
        value = self.word(OUTPUTS + number)
        return None if value == NOT_DRIVEN else value

    def close(self):
        self._memory.close()
