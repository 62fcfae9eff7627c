"""The server as a program: how it starts, and how it ends."""

import signal

import pytest

from trinamic import connect
from server import Server, serve


@pytest.mark.server_only
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_it_with_status_0(tmp_path, how):
    link = tmp_path / "pty"
    server = Server(f"pd42-1140@pty:{link}", devices=1)
    assert server.endpoints == {"pd42-1140": f"pty:{link}"}
    assert link.is_symlink()
    assert server.stop(how) == 0
    assert not link.is_symlink()


def test_settings_survive_in_the_state_folder(tmp_path):
    arguments = ["pd42-1140@tcp:127.0.0.1:0", "--state", str(tmp_path / "state")]
    for write in [True, False]:
        with serve(*arguments, devices=1) as server, connect("tcp", server.endpoints["pd42-1140"]) as connection:
            if write:
                connection.set_and_store_axis_parameter(4, 0, 321)
                connection.set_and_store_global_parameter(10, 2, -99)
            else:
                assert connection.get_axis_parameter(4, 0) == 321
                assert connection.get_global_parameter(10, 2, signed=True) == -99
