"""Who answers, and how it refuses what it does not know."""

import pytest

from performax import AXES, performax_connect, replied
from server import Server


def test_who_it_is(stage):
    replied(stage, "ID", "PERFORMAX-2ED-SA")
    replied(stage, "VER", "V128BL")
    assert stage.get_device_number() == "2ED00"
    assert stage.get_device_info() == (0, "2ED00")
    assert stage.get_all_axes() == AXES


def test_the_client_sees_everything_at_once(stage):
    status = stage.get_full_status(include=-5)
    assert status["baudrate"] == 9600
    assert status["position"] == [0, 0]
    assert status["digital_input"] == 0
    assert status["current_limit_errors"] == ["", ""]
    settings = stage.get_settings()
    assert settings["enabled"] == [True, True]
    assert settings["limit_errors_enabled"] is False


@pytest.mark.parametrize(
    ("command", "reply"),
    [
        ("FROBNICATE", "?FROBNICATE"),
        ("mstx", "?mstx"),
        ("MSTZ", "?MSTZ"),
        ("DI9", "?Index out of Range"),
        ("EO=4", "?Invalid Answer"),
        ("TX100", "?ABS/INC is not in operation"),
    ],
)
def test_refusals(stage, command, reply):
    replied(stage, command, reply)


@pytest.mark.server_only
def test_addresses_on_a_shared_bus(tmp_path):
    """Two devices, first named one by one, then on one line."""
    bus, state = tmp_path / "bus", ["--state", str(tmp_path / "state")]
    with Server("pmx-2ed=second@tcp:127.0.0.1:0", *state, devices=1) as server:
        alone = performax_connect(server.endpoints["second"])
        assert alone.set_device_number(7) == "2ED07"
        alone.close()
    devices = [f"pmx-2ed={name}@pty:{bus}" for name in ["first", "second"]]
    with Server(*devices, *state, devices=2) as server:
        # Both end at the same terminal; the number in front of a command says who is meant.
        first, second = (performax_connect(server.endpoints["first"], idx=idx) for idx in (0, 7))
        assert (first.get_device_number(), second.get_device_number()) == ("2ED00", "2ED07")
        first.move_to("X", 300)
        second.move_to("X", -500)
        for stage in (first, second):
            stage.wait_move("X", timeout=10)
        assert (first.get_position("X"), second.get_position("X")) == (300, -500)
        first.close()
        second.close()
