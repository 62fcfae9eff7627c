"""Every parameter that the module class lists, set and get, and the EEPROM behind them."""

import pytest
from pytrinamic.modules import TMCM1140
from pytrinamic.tmcl import TMCLReplyStatusError, TMCLStatus

from waiting import until

AP, GP0, GP3 = TMCM1140._MotorTypeA.AP, TMCM1140.GP0, TMCM1140.GP3

# The class lists it for a sibling; the manual of this module has no parameter 141.
UNKNOWN = ["ReferenceSwitchTolerance"]

# Values other than the defaults, for every parameter that can be written while the axis stands.
WRITABLE = {
    "TargetVelocity": [0],
    "MaxVelocity": [1, 1234, 2047],
    "MaxAcceleration": [1, 777, 2047],
    "MaxCurrent": [0, 128, 255],
    "StandbyCurrent": [0, 8, 255],
    "RightLimitSwitchDisable": [1, 0],
    "LeftLimitSwitchDisable": [1, 0],
    "MinimumSpeed": [5, 1],
    "MicrostepResolution": [4, 8],
    "SoftStopFlag": [1, 0],
    "EndSwitchPowerDown": [1, 0],
    "RampDivisor": [7, 3],
    "PulseDivisor": [5, 2],
    "Intpol": [1, 0],
    "DoubleEdgeSteps": [1, 0],
    "ChopperBlankTime": [0, 3],
    "ConstantTOffMode": [1, 0],
    "DisableFastDecayComparator": [1, 0],
    "ChopperHysteresisEnd": [0, 15],
    "ChopperHysteresisStart": [0, 7],
    "SEIMIN": [1, 0],
    "SECDS": [3, 0],
    "SmartEnergyHysteresis": [15, 0],
    "SECUS": [3, 0],
    "SmartEnergyHysteresisStart": [15, 0],
    "SG2FilterEnable": [1, 0],
    "SG2Threshold": [-64, 63, 0],
    "SlopeControlHighSide": [0, 3],
    "SlopeControlLowSide": [0, 3],
    "ShortToGroundProtection": [1, 0],
    "ShortDetectionTime": [3, 0],
    "SmartEnergyStallVelocity": [2047, 0],
    "SmartEnergyThresholdSpeed": [2047, 0],
    "SmartEnergySlowRunCurrent": [255, 0],
    "RandomTOffMode": [1, 0],
    "ReferenceSearchMode": [8, 1],
    "ReferenceSearchSpeed": [1500],
    "ReferenceSwitchSpeed": [150],
    "BoostCurrent": [200, 0],
    "FreewheelingDelay": [100, 0],
    "EncoderPosition": [-51200, 0],
    "EncoderPrescaler": [12800, 25600],
    "MaxEncoderDeviation": [100000, 0],
    "PowerDownDelay": [65535, 200],
    "ExternalEncoderPosition": [-51200, 0],
    "ExternalEncoderPrescaler": [512, 256],
    "ExternalEncoderMaxDeviation": [100000, 0],
}

DEFAULTS = {
    "StandbyCurrent": 32,
    "MicrostepResolution": 8,
    "RampDivisor": 3,
    "PulseDivisor": 2,
    "FreewheelingDelay": 0,
    "EncoderPrescaler": 25600,
    "PowerDownDelay": 200,
}


def names(group):
    return [name for name in vars(group) if not name.startswith("_")]


@pytest.fixture
def kept(motor):
    """Axis parameters are put back after the test."""
    before = {name: motor.get_axis_parameter(getattr(AP, name)) for name in WRITABLE}
    yield motor
    for name, value in before.items():
        motor.set_axis_parameter(getattr(AP, name), value)


@pytest.mark.parametrize("name", [name for name in names(AP) if name not in UNKNOWN])
def test_every_listed_axis_parameter_can_be_read(connection, name):
    value = connection.get_axis_parameter(getattr(AP, name), 0, signed=True)
    if name in DEFAULTS:
        assert value == DEFAULTS[name]


@pytest.mark.parametrize("name", UNKNOWN)
def test_an_axis_parameter_that_the_manual_lacks_is_refused(connection, name):
    with pytest.raises(TMCLReplyStatusError) as refusal:
        connection.get_axis_parameter(getattr(AP, name), 0)
    assert refusal.value.status_code == TMCLStatus.WRONG_TYPE


def test_axis_parameters_keep_what_is_written(kept):
    for name, values in WRITABLE.items():
        for value in values:
            kept.set_axis_parameter(getattr(AP, name), value)
            assert kept.get_axis_parameter(getattr(AP, name), signed=True) == value, name


def test_features_read_what_their_parameters_say(motor):
    assert motor.linear_ramp.max_velocity == motor.get_axis_parameter(AP.MaxVelocity)
    assert motor.drive_settings.max_current == motor.get_axis_parameter(AP.MaxCurrent)
    assert motor.drive_settings.standby_current == motor.get_axis_parameter(AP.StandbyCurrent)
    assert motor.drive_settings.microstep_resolution == motor.ENUM.MicrostepResolution256Microsteps
    assert motor.stallguard2.threshold == motor.get_axis_parameter(AP.SG2Threshold)
    assert motor.coolstep.threshold_speed == motor.get_axis_parameter(AP.SmartEnergyThresholdSpeed)


def test_an_axis_parameter_is_stored_and_restored(module, motor):
    before = motor.linear_ramp.max_velocity
    try:
        motor.linear_ramp.max_velocity = 700
        module.store_axis_parameter(AP.MaxVelocity, 0)
        motor.linear_ramp.max_velocity = 900
        assert motor.linear_ramp.max_velocity == 900
        module.restore_axis_parameter(AP.MaxVelocity, 0)
        assert motor.linear_ramp.max_velocity == 700
    finally:
        motor.linear_ramp.max_velocity = before
        module.store_axis_parameter(AP.MaxVelocity, 0)


def test_an_axis_parameter_without_a_place_in_the_eeprom_is_not_stored(module):
    with pytest.raises(TMCLReplyStatusError) as refusal:
        module.store_axis_parameter(AP.ReferenceSearchMode, 0)
    assert refusal.value.status_code == TMCLStatus.WRONG_TYPE


@pytest.mark.parametrize("name", names(GP0))
def test_every_listed_global_parameter_can_be_read(connection, name):
    connection.get_global_parameter(getattr(GP0, name), 0)


@pytest.mark.parametrize("name", names(GP3))
def test_every_listed_interrupt_parameter_keeps_what_is_written(connection, name):
    for value in [3, 0]:
        connection.set_global_parameter(getattr(GP3, name), 3, value)
        assert connection.get_global_parameter(getattr(GP3, name), 3) == value


@pytest.mark.parametrize("index", [0, 55, 56, 255])
def test_user_variables_are_signed(connection, index):
    for value in [-(2**31), 2**31 - 1, 0]:
        connection.set_global_parameter(index, 2, value)
        assert connection.get_global_parameter(index, 2, signed=True) == value


def test_a_user_variable_is_stored_and_restored(connection):
    connection.set_and_store_global_parameter(7, 2, -12345)
    connection.set_global_parameter(7, 2, 1)
    connection.restore_global_parameter(7, 2)
    assert connection.get_global_parameter(7, 2, signed=True) == -12345


def test_the_tick_timer_counts_milliseconds(connection):
    connection.set_global_parameter(GP0.TickTimer, 0, 0)
    assert connection.get_global_parameter(GP0.TickTimer, 0) < 1000
    until(lambda: connection.get_global_parameter(GP0.TickTimer, 0) >= 50, what="50 ms")


def test_random_numbers_differ(connection):
    numbers = {connection.get_global_parameter(GP0.randomNumber, 0) for _ in range(5)}
    assert len(numbers) > 1 and all(0 <= number < 2**31 for number in numbers)
