"""Inputs, outputs and the switches, as the client reads them."""

import pytest
from pytrinamic.modules import TMCM1140

from waiting import until

AP, IO = TMCM1140._MotorTypeA.AP, TMCM1140.IO
SUPPLY, TEMPERATURE = 8, 9


@pytest.mark.parametrize("output", [IO.OUT0, IO.OUT1])
def test_outputs(module, output):
    module.set_digital_output(output)
    assert module.get_digital_output(output) == 1
    module.clear_digital_output(output)
    assert module.get_digital_output(output) == 0


@pytest.mark.parametrize("switch", [IO.IN1, IO.IN2], ids=["left", "right"])
def test_the_stop_switches_are_off_in_the_middle(module, switch):
    assert module.get_digital_input(switch) == 0


@pytest.mark.parametrize(("position", "expected"), [(-100, 1), (1000, 0), (-1000, 0)])
def test_the_home_switch_is_on_around_its_place(module, motor, position, expected):
    module.move_to(0, position)
    until(motor.get_position_reached, what="the position")
    assert motor.get_axis_parameter(AP.ReferenceSwitchStatus) == expected
    assert module.get_digital_input(IO.IN3) == expected


def test_the_analog_input_is_read_in_twelve_bits(module):
    assert 0 <= module.get_analog_input(0) <= 4095


def test_supply_and_temperature(module):
    supply_dv, temperature_c = module.get_analog_input(SUPPLY), module.get_analog_input(TEMPERATURE)
    assert 95 <= supply_dv <= 300
    assert 0 < temperature_c < 80
