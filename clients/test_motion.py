"""Positioning and rotating, seen through the client."""

import pytest
from pytrinamic.modules import TMCM1140
from pytrinamic.tmcl import TMCLCommand

from waiting import until

AP = TMCM1140._MotorTypeA.AP

# The built-in encoder has 1024 steps a turn of 51200 microsteps.
ENCODER_STEP = 50


def reached(motor):
    until(motor.get_position_reached, what="the position")


@pytest.mark.parametrize("position", [30000, -30000, 1, 0])
def test_move_to(module, motor, position):
    module.move_to(0, position)
    assert motor.target_position == position
    reached(motor)
    assert motor.actual_position == position
    assert motor.actual_velocity == 0
    assert motor.get_axis_parameter(AP.RampType) == 0


def test_the_flag_falls_during_the_move(module, motor):
    motor.linear_ramp.max_velocity = 500
    module.move_to(0, 20000)
    assert not motor.get_position_reached()
    reached(motor)


def test_move_by(module, motor):
    for expected in [8000, 16000]:
        module.move_by(0, 8000)
        reached(motor)
        assert motor.actual_position == expected
    motor.move_by(-20000)
    reached(motor)
    assert motor.actual_position == -4000


def test_a_move_with_its_own_speed(module, motor):
    module.move_to(0, 10000, velocity=800)
    assert motor.linear_ramp.max_velocity == 800
    speeds = []
    until(lambda: speeds.append(motor.actual_velocity) or motor.get_position_reached(), what="the position")
    assert 0 < max(speeds) <= 800


def test_a_target_set_as_a_parameter_starts_the_move(motor):
    motor.target_position = -6000
    reached(motor)
    assert motor.actual_position == -6000


def test_a_target_changed_on_the_way(module, motor):
    motor.linear_ramp.max_velocity = 500
    module.move_to(0, 50000)
    until(lambda: motor.actual_position > 1000, what="motion")
    module.move_to(0, -5000)
    reached(motor)
    assert motor.actual_position == -5000


@pytest.mark.parametrize("velocity", [500, -500])
def test_rotate_and_stop(module, motor, velocity):
    module.rotate(0, velocity)
    until(lambda: motor.actual_velocity == velocity, what="the speed")
    assert motor.target_velocity == velocity
    assert motor.get_axis_parameter(AP.RampType) == 2
    before = motor.actual_position
    until(lambda: (motor.actual_position - before) * velocity > 0, what="motion")
    module.stop(0)
    until(lambda: motor.actual_velocity == 0, what="standstill")
    after = motor.actual_position
    assert motor.actual_position == after


def test_rotate_left(connection, motor):
    connection.send(TMCLCommand.ROL, 0, 0, 300)
    until(lambda: motor.actual_velocity == -300, what="the speed")


def test_the_encoder_follows(module, motor):
    motor.set_axis_parameter(AP.EncoderPosition, 0)
    module.move_to(0, 25600)
    reached(motor)
    encoder = motor.get_axis_parameter(AP.EncoderPosition, signed=True)
    assert abs(encoder - 25600) <= ENCODER_STEP


def test_the_position_can_be_set_at_standstill(module, motor):
    before = motor.actual_position
    motor.actual_position = 123456
    assert (motor.actual_position, motor.target_position) == (123456, 123456)
    assert motor.get_position_reached()
    motor.actual_position = before


def test_coordinates(connection, module, motor):
    connection.send(TMCLCommand.SCO, 3, 0, 7000)
    connection.move(2, 0, 3)
    reached(motor)
    assert motor.actual_position == 7000
    connection.send(TMCLCommand.CCO, 4, 0, 0)
    assert connection.send(TMCLCommand.GCO, 4, 0, 0).value == 7000


@pytest.mark.parametrize("every", [0, 1], ids=["next move", "every move"])
def test_the_reached_event_is_sent_by_itself(connection, module, every):
    connection.send(TMCLCommand.TARGET_POSITION_REACHED, every, 0, 1)
    for position in [4000, 0][: 1 + every]:
        module.move_to(0, position)
        # The client has no public call for a frame that it did not ask for; this is its receiver.
        module_address, status, command = connection._recv(2, 1)[1:4]
        assert (module_address, status, command) == (1, 128, TMCLCommand.TARGET_POSITION_REACHED)
    # A request for the next move alone ends the request for every move.
    connection.send(TMCLCommand.TARGET_POSITION_REACHED, 0, 0, 1)
    module.move_to(0, 1000)
    assert connection._recv(2, 1)[2] == 128
