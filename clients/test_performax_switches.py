"""Limits with their errors, homing, inputs and outputs, seen through the client."""

import pytest

from images import overrun
from performax import AXES, NEGATIVE_LIMIT, POSITIVE_LIMIT, arrived, replied, status
from waiting import until


@pytest.fixture(scope="module")
def performax_speed():
    """Homing goes a long way, and nobody has to catch it on the way."""
    return 5


# The fixture's speed.
OVERRUN = overrun(20000)

# Where the axis stands after it has run onto a switch: at the pulse.
SIDES = [("+", POSITIVE_LIMIT), ("-", NEGATIVE_LIMIT)]


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize(("side", "limit"), SIDES)
def test_a_limit_stops_the_axis(stage, axis, side, limit):
    stage.jog(axis, side)
    arrived(stage, axis)
    assert abs(stage.get_position(axis) - limit) <= OVERRUN
    name = "plus" if side == "+" else "minus"
    # Errors are off: the switch is seen, and the axis may go back.
    assert f"sw_{name}_lim" in status(stage, axis)
    assert stage.check_limit_error() == ["", ""]
    stage.move_to(axis, 0)
    arrived(stage, axis)
    assert status(stage, axis) == set()


@pytest.mark.parametrize(("side", "limit"), SIDES)
def test_a_limit_error_holds_until_it_is_cleared(stage, side, limit):
    stage.enable_limit_errors()
    assert stage.limit_errors_enabled()
    stage.jog("X", side)
    arrived(stage)
    assert stage.check_limit_error() == [side, ""]
    replied(stage, "X0", "?State Error")
    assert abs(stage.get_position("X") - limit) <= OVERRUN
    stage.clear_limit_error("X")
    assert stage.check_limit_error("X") == ""
    stage.move_to("X", 0)
    arrived(stage)
    assert stage.get_position("X") == 0


def home(stage, command, start):
    """Homes from a position and gives the place that has become zero, by the old count."""
    for setting in ["LCAX=700", "HCAX=200"]:
        replied(stage, setting)
    stage.move_to("X", start)
    arrived(stage)
    stage.set_global_speed(5000)
    replied(stage, command)
    assert stage.is_moving("X")
    arrived(stage)
    assert stage.check_limit_error("X") == ""
    # The limit switch has not moved.
    stage.set_global_speed(20000)
    stage.jog("X", "+")
    arrived(stage)
    zero = POSITIVE_LIMIT - stage.get_position("X")
    stage.set_position_reference("X", POSITIVE_LIMIT)
    return zero


# The home switch is on from 1000 to 3000, and an index mark comes every 500.
@pytest.mark.parametrize(
    ("command", "start", "zero"),
    [
        ("HX+", 0, 1000),
        ("HX-", 5000, 3000),
        ("HLX+", 0, 1000),
        ("HLX-", 5000, 3000),
        ("LX+", 0, POSITIVE_LIMIT - 700),
        ("LX-", 0, NEGATIVE_LIMIT + 700),
        ("ZX+", 100, 500),
        ("ZX-", 100, 0),
    ],
)
def test_homing(stage, command, start, zero):
    assert abs(home(stage, command, start) - zero) <= 2 * OVERRUN


@pytest.mark.parametrize(("command", "start"), [("ZHX+", 0), ("ZHX-", 5000)])
def test_homing_with_the_index(stage, command, start):
    zero = home(stage, command, start)
    mark = round(zero / 500)
    assert abs(zero - 500 * mark) <= 2 * OVERRUN and 1 <= mark <= 7


def test_the_homing_call_of_the_client(stage):
    """It writes the direction as `True` or `False`, which no controller knows; nothing moves."""
    stage.home("X", "+", "only_home_input")
    assert not stage.is_moving("X")
    replied(stage, "HXTrue", "?HXTrue")


@pytest.mark.parametrize("output", range(1, 9))
def test_outputs(stage, output):
    assert stage.set_digital_output(output, True) == 1
    assert stage.get_digital_output_register() == 1 << (output - 1)
    assert stage.set_digital_output(output, False) == 0


def test_all_outputs(stage, performax_server, performax_interface):
    for value in [255, 0x5A, 0]:
        assert stage.set_digital_output_register(value) == value
        pins = [performax_server.call("GET", f"{performax_interface}/pins/DO{bit + 1}") for bit in range(8)]
        assert pins == [bool(value >> bit & 1) for bit in range(8)]


@pytest.mark.parametrize("number", range(1, 9))
def test_inputs(stage, drive, number):
    assert stage.get_digital_input(number) == 0
    drive(f"DI{number}", True)
    assert stage.get_digital_input(number) == 1
    assert stage.get_digital_input_register() == 1 << (number - 1)


@pytest.mark.parametrize("number", [1, 2])
def test_analog_inputs(stage, drive, number):
    assert stage.get_analog_input(number) == 2.5
    for volts in [0, 4.99]:
        drive(f"AI{number}", volts * 1000)
        # Ten bits on 5 V.
        assert abs(stage.get_analog_input(number) - volts) <= 0.005


def test_a_switch_driven_by_hand(stage, drive):
    stage.enable_limit_errors()
    stage.set_global_speed(2000)
    stage.jog("Y", "+")
    until(lambda: stage.get_position("Y") > 100, what="motion")
    drive("+LY", True)
    assert not stage.is_moving("Y")
    assert stage.check_limit_error() == ["", "+"]
    drive("+LY", False)
    stage.clear_limit_error("Y")
