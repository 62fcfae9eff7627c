"""The settings that are stored, and what a power cycle makes of them."""

import pytest

from performax import performax_connect, replied
from server import serve


@pytest.fixture(params=["pty", "tcp"])
def bench(request, tmp_path):
    """A server with one device of its own, whose power may be switched."""
    endpoint = f"pty:{tmp_path / 'pty'}" if request.param == "pty" else "tcp:127.0.0.1:0"
    with serve(f"pmx-2ed=stage@{endpoint}", devices=1, http=True) as server:
        stage = performax_connect(server.endpoints["stage"])
        yield server, stage
        stage.close()


def power_cycle(server):
    server.call("POST", "stage/power-cycle")


def test_stored_settings_outlive_the_power(bench):
    server, stage = bench
    for command in ["POLX=3", "V40=-12345", "V3=7", "LCAY=55", "DOBOOT=9", "EOBOOT=2"]:
        replied(stage, command)
    stage.enable_limit_errors()
    stage.store_defaults()
    replied(stage, "V40=1")
    stage.move_to("X", 500)
    stage.wait_move("X", timeout=10)
    power_cycle(server)
    for command, reply in [("POLX", "3"), ("V40", "-12345"), ("V3", "0"), ("LCAY", "55")]:
        replied(stage, command, reply)
    assert stage.limit_errors_enabled()
    assert stage.get_position() == [0, 0]
    assert stage.get_digital_output_register() == 9
    assert stage.is_enabled() == [False, True]


def test_what_was_not_stored_is_lost(bench):
    server, stage = bench
    before = stage.get_global_speed()
    stage.set_global_speed(before + 500)
    power_cycle(server)
    assert stage.get_global_speed() == before


def test_the_number_and_the_speed_of_the_line_come_with_the_power(bench):
    server, stage = bench
    assert stage.set_device_number("2ED03") == "2ED03"
    assert stage.set_baudrate(115200) == 115200
    power_cycle(server)
    # The client puts the number in front of commands on a serial line.
    stage.idx = 3
    assert stage.get_device_number() == "2ED03"
    assert stage.get_baudrate() == 115200
