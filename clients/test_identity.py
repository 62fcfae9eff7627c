"""Who answers, and how it refuses what it does not know."""

import pytest
from pytrinamic.tmcl import GetInfoRequestError, TMCLCommand, TMCLReplyStatusError, TMCLStatus


def test_version_string(connection):
    assert connection.get_version_string() == "1140V147"


def test_version_number(connection):
    assert connection.send(TMCLCommand.GET_FIRMWARE_VERSION, 1, 0, 0).value == 0x0474_012F


@pytest.mark.parametrize(
    ("opcode", "kind", "motor", "value", "status"),
    [
        pytest.param(TMCLCommand.RAMDEBUG, 0, 0, 0, TMCLStatus.INVALID_COMMAND, id="no such command"),
        pytest.param(TMCLCommand.GAP, 99, 0, 0, TMCLStatus.WRONG_TYPE, id="no such parameter"),
        pytest.param(TMCLCommand.GAP, 0, 1, 0, TMCLStatus.INVALID_VALUE, id="no such motor"),
        pytest.param(TMCLCommand.SAP, 4, 0, 2048, TMCLStatus.INVALID_VALUE, id="value out of range"),
        pytest.param(TMCLCommand.SAP, 3, 0, 1, TMCLStatus.WRONG_TYPE, id="read only"),
        pytest.param(TMCLCommand.WAIT, 0, 0, 1, TMCLStatus.COMMAND_NOT_AVAILABLE, id="for programs only"),
    ],
)
def test_refusals(connection, opcode, kind, motor, value, status):
    with pytest.raises(TMCLReplyStatusError) as refusal:
        connection.send(opcode, kind, motor, value)
    assert refusal.value.status_code == status


def test_a_command_of_later_firmware_is_refused(connection):
    with pytest.raises(GetInfoRequestError):
        connection.get_info("FWVersion")
