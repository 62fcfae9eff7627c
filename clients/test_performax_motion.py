"""Moves, jogs, stops, speeds and encoders, seen through the client."""

import pytest

from performax import AXES, arrived, replied, status
from waiting import until


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("position", [5000, -5000, 1])
def test_move_to(stage, axis, position):
    stage.move_to(axis, position)
    # A single pulse is over in 2 ms.
    assert stage.is_moving(axis) or position == 1
    arrived(stage, axis)
    assert stage.get_position(axis) == position
    assert stage.get_position("Y" if axis == "X" else "X") == 0
    assert stage.get_current_axis_speed(axis) == 0


def test_move_by(stage):
    for expected in [700, 1400]:
        stage.move_by("X", 700)
        arrived(stage)
        assert stage.get_position() == [expected, 0]
    stage.move_by("Y", -250)
    arrived(stage)
    assert stage.get_position() == [1400, -250]


def test_both_axes_at_once(stage):
    stage.move_to("X", 4000)
    stage.move_to("Y", -4000)
    assert stage.is_moving() == [True, True]
    arrived(stage)
    assert stage.get_position() == [4000, -4000]


def test_a_straight_line(stage):
    replied(stage, "I3000:-1500")
    positions = []
    until(lambda: positions.append(stage.get_position()) or not any(stage.is_moving()), what="the end of the line")
    assert stage.get_position() == [3000, -1500]
    # A look at both axes takes two commands, so they are a little apart.
    assert all(abs(x + 2 * y) < 800 for x, y in positions)


def test_a_second_move_on_the_way_is_refused(stage):
    stage.move_to("X", 8000)
    replied(stage, "X0", "?Moving")
    arrived(stage)
    assert stage.get_position("X") == 8000


def test_a_target_changed_on_the_way(stage):
    stage.move_to("X", 8000)
    until(lambda: stage.get_position("X") > 500, what="motion")
    replied(stage, "TX-1000")
    arrived(stage)
    assert stage.get_position("X") == -1000


def test_incremental_moves(stage):
    replied(stage, "INC")
    replied(stage, "MM", "1")
    for _ in range(2):
        replied(stage, "X-300")
        arrived(stage)
    assert stage.get_position("X") == -600


@pytest.mark.parametrize("immediate", [False, True])
@pytest.mark.parametrize("direction", ["+", "-"])
def test_jog_and_stop(stage, direction, immediate):
    stage.set_global_speed(4000)
    stage.jog("X", direction)
    speed = 4000 if direction == "+" else -4000
    # The client calls motion at constant speed `moving`.
    until(lambda: status(stage, "X") == {"moving"}, what="the speed")
    assert stage.get_current_axis_speed("X") in [4000, -4000]
    before = stage.get_position("X")
    stage.stop("X", immediate=immediate)
    if immediate:
        assert not stage.is_moving("X")
    else:
        assert "decel" in status(stage, "X")
    arrived(stage)
    way = abs(stage.get_position("X") - before)
    # From 4000 to 500 pulses a second in 100 ms is 225 pulses.
    assert way < 225 if immediate else 200 < way < 600
    assert (stage.get_position("X") - before) * speed >= 0


def test_a_stop_of_one_axis_leaves_the_other(stage):
    stage.set_global_speed(3000)
    stage.jog("X", "+")
    stage.jog("Y", "-")
    stage.stop("X", immediate=True)
    assert stage.is_moving() == [False, True]
    stage.stop()
    arrived(stage)


def test_status_words(stage):
    stage.set_global_speed(4000)
    seen = set()
    stage.move_to("Y", -4000)
    until(lambda: seen.update(status(stage, "Y")) or not stage.is_moving("Y"), what="the position")
    assert {"accel", "moving", "decel"} <= seen
    assert status(stage, "X") == set()


def test_speeds(stage):
    assert stage.set_global_speed(3000) == 3000
    assert stage.set_axis_speed("Y", 1500) == 1500
    assert (stage.get_global_speed(), stage.get_axis_speed()) == (3000, [0, 1500])
    stage.jog("X", "+")
    stage.jog("Y", "+")
    # An axis' own speed goes before the global one.
    until(lambda: stage.get_current_axis_speed() == [3000, 1500], what="the speeds")
    stage.stop(immediate=True)


def test_a_speed_changed_on_the_way(stage):
    stage.set_global_speed(3000)
    replied(stage, "SSPDMX=1")
    stage.jog("X", "+")
    replied(stage, "SSPDX=1000")
    until(lambda: stage.get_current_axis_speed("X") == 1000, what="the new speed")
    stage.stop(immediate=True)
    replied(stage, "SSPDMX=0")


@pytest.mark.server_only
def test_the_encoder_follows_only_while_the_motor_has_power(stage):
    stage.set_encoder_reference("X", 100)
    stage.move_to("X", 600)
    arrived(stage)
    assert stage.get_encoder("X") == 700
    stage.enable_axis("X", False)
    assert stage.is_enabled() == [False, True]
    stage.move_to("X", 0)
    arrived(stage)
    assert (stage.get_position("X"), stage.get_encoder("X")) == (0, 700)
    stage.move_to("X", 600)
    arrived(stage)
    stage.enable_axis("X")


def test_a_new_reference(stage):
    stage.move_to("X", 500)
    arrived(stage)
    stage.set_position_reference("X", -20)
    assert stage.get_position("X") == -20
    stage.set_position_reference("X", 500)
