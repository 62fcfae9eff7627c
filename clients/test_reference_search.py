"""Reference searches on an axis with switches at -8000 and 12000 and home between 1000 and 3000."""

import pytest
from pytrinamic.modules import TMCM1140

from waiting import until

AP = TMCM1140._MotorTypeA.AP
START, STOP, STATUS = 0, 1, 2

# At the speed of the last approach the axis goes this far between two looks at a switch.
TOLERANCE = 100
WAY = 20000


def search(connection, motor, mode):
    motor.set_axis_parameter(AP.ReferenceSearchMode, mode)
    motor.set_axis_parameter(AP.ReferenceSearchSpeed, 1000)
    motor.set_axis_parameter(AP.ReferenceSwitchSpeed, 200)
    connection.reference_search(START, 0)


def finish(connection, motor):
    until(lambda: connection.reference_search(STATUS, 0) == 0, timeout_s=20, what="the end of the search")
    assert (motor.actual_position, motor.target_position, motor.actual_velocity) == (0, 0, 0)


@pytest.mark.parametrize("mode", [1, 2, 3, 4, 5, 6, 7, 8, 65, 66, 67, 68])
def test_a_search_ends_at_its_zero(bench_connection, bench_module, mode):
    motor = bench_module.motors[0]
    # Modes 7 and 8 ignore the stop switches: they begin at the end from which home lies ahead.
    if mode in [7, 8]:
        search(bench_connection, motor, 65 if mode == 7 else 1)
        finish(bench_connection, motor)
    search(bench_connection, motor, mode)
    finish(bench_connection, motor)


@pytest.mark.parametrize("mode", [2, 3, 66, 67])
def test_a_search_of_both_switches_measures_the_way(bench_connection, bench_module, mode):
    motor = bench_module.motors[0]
    search(bench_connection, motor, mode)
    finish(bench_connection, motor)
    distance = motor.get_axis_parameter(AP.ReferenceSwitchDistance, signed=True)
    assert abs(abs(distance) - WAY) <= TOLERANCE


def test_the_zero_of_two_searches_is_the_same_place(bench_connection, bench_module):
    motor = bench_module.motors[0]
    for _ in range(2):
        search(bench_connection, motor, 1)
        finish(bench_connection, motor)
    assert abs(motor.get_axis_parameter(AP.LastReferenceSwitchPosition, signed=True)) <= TOLERANCE


def test_a_search_is_active_until_it_is_stopped(bench_connection, bench_module):
    motor = bench_module.motors[0]
    search(bench_connection, motor, 1)
    finish(bench_connection, motor)
    # The whole way lies ahead.
    search(bench_connection, motor, 65)
    assert bench_connection.reference_search(STATUS, 0) != 0
    bench_connection.reference_search(STOP, 0)
    assert bench_connection.reference_search(STATUS, 0) == 0
    until(lambda: motor.actual_velocity == 0, what="standstill")


def test_a_stop_switch_stops_the_axis_and_lets_it_back(bench_connection, bench_module):
    motor = bench_module.motors[0]
    search(bench_connection, motor, 1)
    finish(bench_connection, motor)
    bench_module.rotate(0, -500)
    until(lambda: motor.get_axis_parameter(AP.LeftEndstop) == 1, what="the left switch")
    until(lambda: motor.actual_velocity == 0, what="standstill")
    assert motor.actual_position <= TOLERANCE
    bench_module.move_to(0, 5000)
    until(motor.get_position_reached, what="the position")
    assert motor.get_axis_parameter(AP.LeftEndstop) == 0
