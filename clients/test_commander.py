"""A CMD-4CR over plain lines: there is no vendor's client for it."""

import pytest

from images import overrun
from server import serve
from waiting import until
from wire import Lines

AXES = "XYZU"
NEGATIVE_LIMIT, POSITIVE_LIMIT, HOME = -3000, 4000, [1000, 1500]

BENCH = """
[[device]]
model = "cmd-4cr"
name = "table"
listen = ["tcp:127.0.0.1:0"]
""" + "".join(
    f"""
[device.axis.{axis}]
negative_limit = {NEGATIVE_LIMIT}
positive_limit = {POSITIVE_LIMIT}
home = {HOME}
index_every = 250
"""
    for axis in AXES
)

# Bits of the status word.
MOVING = 0b111


@pytest.fixture(scope="module")
def line(tmp_path_factory):
    bench = tmp_path_factory.mktemp("commander") / "bench.toml"
    bench.write_text(BENCH)
    with serve("--bench", str(bench), devices=1, http=True) as server, Lines(server.endpoints["table"]) as line:
        yield line


@pytest.fixture
def table(line):
    """The controller at rest at 0, its motors on."""
    line.orders("ABORT BF IERR=1 EINT=1 ABS EO=15 HSPD=20000 LSPD=1000 ACC=50 DEC=50 X0Y0Z0U0")
    arrived(line)
    assert positions(line) == [0, 0, 0, 0]
    return line


def arrived(line):
    until(lambda: not any(line.number(f"MST{axis}") & MOVING for axis in AXES), what="standstill")


def positions(line):
    return [line.number(f"P{axis}") for axis in AXES]


def test_who_it_is(table):
    assert table.ask("ID") == "01"
    assert table.ask("VER") == "V126BL"
    assert table.ask("FROBNICATE") == "?Unknown Command: FROBNICATE"
    assert table.ask("HSPD=-1") == "?Invalid Index"


@pytest.mark.parametrize("axis", AXES)
def test_one_axis_moves(table, axis):
    table.order(f"{axis}1234")
    assert table.ask(f"{axis}0") == "?Error Moving"
    arrived(table)
    assert positions(table) == [1234 if other == axis else 0 for other in AXES]
    assert table.number(f"E{axis}") == 1234


def test_four_axes_move_along_a_line(table):
    table.order("X2000Y-1000Z500U-250")
    seen = []
    until(lambda: seen.append(table.number("PX")) or not table.number("MSTX") & MOVING, what="the end of the line")
    assert positions(table) == [2000, -1000, 500, -250]
    assert len(set(seen)) > 2


def test_a_circle_and_an_arc(table):
    table.order("CIRXYP700:0")
    arrived(table)
    assert positions(table) == [0, 0, 0, 0]
    # A quarter, clockwise around (0, 700), to the angle of 180 degrees.
    table.order("ARCXYP0:700:180000")
    arrived(table)
    x, y, *rest = positions(table)
    assert abs(x + 700) <= 1 and abs(y - 700) <= 1 and rest == [0, 0]


def test_buffered_moves_follow_each_other(table):
    table.order("BO")
    for target in ["I500:250:0:8000", "I1000:0:100:4000", "I0:0:0:16000"]:
        table.order(target)
    table.order("BSTART")
    arrived(table)
    table.order("BF")
    assert positions(table) == [0, 0, 0, 0]


def test_a_target_and_a_speed_changed_on_the_way(table):
    table.orders("HSPDX=2000 SSPDMX=2 X3000")
    until(lambda: table.number("PX") > 100, what="motion")
    table.order("SSPDX=5000")
    table.order("TX-500")
    arrived(table)
    assert table.number("PX") == -500
    table.orders("SSPDMX=0 HSPDX=0")


@pytest.mark.parametrize(("direction", "limit"), [("+", POSITIVE_LIMIT), ("-", NEGATIVE_LIMIT)])
def test_a_limit_stops_the_axis(table, direction, limit):
    table.orders("IERR=0 HSPD=5000")
    table.order(f"JZ{direction}")
    arrived(table)
    assert abs(table.number("PZ") - limit) <= overrun(5000)
    assert table.ask("Z0") == "?Error Moving"
    table.order("CLRZ")
    assert table.ask(f"JZ{direction}") == f"?Error {direction}Limit"


@pytest.mark.parametrize(("command", "zero"), [("HY+0", HOME[0]), ("HY-6", NEGATIVE_LIMIT + 1)])
def test_homing(table, command, zero):
    table.orders("HSPD=4000 LSPD=500")
    table.order(command)
    arrived(table)
    # The switch at the end has not moved: the count there says where zero is now.
    table.order("JY+")
    arrived(table)
    measured = POSITIVE_LIMIT - table.number("PY")
    table.order(f"PY={POSITIVE_LIMIT}")
    assert abs(measured - zero) <= 2 * overrun(4000)
