"""Standalone programs: assembled by the program, uploaded, run and read back by the client."""

import pathlib

import pytest
from pytrinamic.tmcl import TMCLCommand, TMCLReplyChecksumError, TMCLStatus

from server import pulsetrain
from waiting import until

PROGRAMS = pathlib.Path(__file__).parent / "programs"
STOPPED, RUNNING, RESET = 0, 1, 3
APPLICATION_STATUS, PROGRAM_COUNTER = 128, 130


def assemble(name, folder):
    """The commands of a program as (opcode, type, motor, value)."""
    binary = folder / f"{name}.bin"
    pulsetrain("asm", str(PROGRAMS / f"{name}.tmc"), "-o", str(binary))
    data = binary.read_bytes()
    records = [data[at : at + 8] for at in range(0, len(data), 8)]
    assert records and all(len(record) == 8 and sum(record[:7]) & 0xFF == record[7] for record in records)
    return [(*record[:3], int.from_bytes(record[3:7], "big")) for record in records]


def upload(connection, commands):
    connection.send(TMCLCommand.STOP_APPLICATION, 0, 0, 0)
    connection.send(TMCLCommand.START_DOWNLOAD_MODE, 0, 0, 0)
    try:
        for command in commands:
            assert connection.send(*command).status == TMCLStatus.COMMAND_LOADED
    finally:
        connection.send(TMCLCommand.QUIT_DOWNLOAD_MODE, 0, 0, 0)
    connection.send(TMCLCommand.RESET_APPLICATION, 0, 0, 0)


def read_back(connection, address):
    """The special reply has no room for a checksum that the client expects; it says so with the reply."""
    try:
        reply = connection.send(TMCLCommand.READ_TMCL_MEMORY, 0, 0, address)
    except TMCLReplyChecksumError as error:
        reply = error.reply
    return (reply.module_address, reply.status, reply.command, reply.value)


def variable(connection, index):
    return connection.get_global_parameter(index, 2, signed=True)


@pytest.fixture
def stopped(connection):
    """The program is stopped after the test, whatever became of it."""
    yield connection
    connection.send(TMCLCommand.STOP_APPLICATION, 0, 0, 0)


def test_a_program_moves_the_axis_and_tells_of_it(stopped, motor, tmp_path):
    commands = assemble("count", tmp_path)
    upload(stopped, commands)
    assert [read_back(stopped, address) for address in range(len(commands))] == commands
    assert stopped.get_global_parameter(APPLICATION_STATUS, 0) == RESET
    stopped.send(TMCLCommand.RUN_APPLICATION, 0, 0, 0)
    seen = set()
    until(lambda: seen.add(variable(stopped, 0)) or variable(stopped, 1), what="the program's word that it is done")
    assert len(seen) > 2 and seen <= set(range(11))
    assert variable(stopped, 0) == 10
    assert motor.actual_position == 10000
    until(lambda: stopped.get_global_parameter(APPLICATION_STATUS, 0) == STOPPED, what="the program's end")


def test_a_program_is_stopped_continued_and_reset(stopped, tmp_path):
    upload(stopped, assemble("forever", tmp_path))
    stopped.send(TMCLCommand.RUN_APPLICATION, 1, 0, 0)
    until(lambda: variable(stopped, 2) >= 3, what="three turns")
    assert stopped.get_global_parameter(APPLICATION_STATUS, 0) == RUNNING
    assert stopped.send(TMCLCommand.GET_APPLICATION_STATUS, 1, 0, 0).value >> 24 == RUNNING

    stopped.send(TMCLCommand.STOP_APPLICATION, 0, 0, 0)
    count = variable(stopped, 2)
    assert stopped.get_global_parameter(APPLICATION_STATUS, 0) == STOPPED
    assert variable(stopped, 2) == count

    stopped.send(TMCLCommand.RUN_APPLICATION, 0, 0, 0)
    until(lambda: variable(stopped, 2) > count, what="the next turn")

    stopped.send(TMCLCommand.RESET_APPLICATION, 0, 0, 0)
    assert stopped.get_global_parameter(APPLICATION_STATUS, 0) == RESET
    assert stopped.get_global_parameter(PROGRAM_COUNTER, 0) == 0


def test_a_program_is_stepped(stopped, tmp_path):
    upload(stopped, assemble("forever", tmp_path))
    for counter in [1, 2]:
        stopped.send(TMCLCommand.STEP_APPLICATION, 0, 0, 0)
        # A step that has not begun is not asked for twice.
        until(lambda: stopped.get_global_parameter(PROGRAM_COUNTER, 0) == counter, what=f"step {counter}")
    assert variable(stopped, 2) == 1
