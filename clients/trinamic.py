"""A virtual PD42-1140 behind each of the three interfaces that PyTrinamic can speak to it."""

import pytest
from pytrinamic.connections import ConnectionManager
from pytrinamic.modules import TMCM1140

from images import FOLDER
from server import serve
from waiting import until

# All interfaces of an image end in the same UART, and it has no CAN: one of them for each maker.
INTERFACES = ["pty"] if FOLDER else ["pty", "tcp", "slcan"]

# The reference searches run on a short axis: the whole way takes less than a second.
BENCH = """
[[device]]
model = "pd42-1140"
name = "{name}"
listen = ["{endpoint}"]
[device.axis.0]
negative_limit = -8000
positive_limit = 12000
home = [1000, 3000]
"""


def endpoint(interface, folder):
    """Where a device of its own listens on this interface."""
    return {
        "pty": f"pty:{folder / 'pty'}",
        "tcp": "tcp:127.0.0.1:0",
        "slcan": "slcan-tcp:127.0.0.1:0",
    }[interface]


def connect(interface, endpoint):
    """Opens an unmodified PyTrinamic connection to an endpoint as the server names it."""
    place = endpoint.split(":", 1)[1]
    arguments = {
        "pty": ["--interface", "serial_tmcl", "--data-rate", "115200", "--port", place],
        "tcp": ["--interface", "socket_serial_tmcl", "--port", place],
        # python-can opens its serial port by URL, so SLCAN needs no bridge.
        "slcan": ["--interface", "slcan_tmcl", "--port", f"socket://{place}"],
    }[interface]
    return ConnectionManager(arguments).connect()


@pytest.fixture(scope="session", params=INTERFACES)
def interface(request):
    return request.param


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """One server with a device for each interface, given on the command line."""
    folder = tmp_path_factory.mktemp("server")
    devices = [f"pd42-1140={interface}@{endpoint(interface, folder)}" for interface in INTERFACES]
    with serve(*devices, devices=len(devices)) as server:
        yield server


@pytest.fixture(scope="session")
def bench_server(tmp_path_factory):
    """The same from a bench file, on a short axis."""
    folder = tmp_path_factory.mktemp("bench")
    bench = folder / "bench.toml"
    bench.write_text("".join(BENCH.format(name=name, endpoint=endpoint(name, folder)) for name in INTERFACES))
    with serve("--bench", str(bench), devices=len(INTERFACES)) as server:
        yield server


@pytest.fixture(scope="session")
def connection(server, interface):
    with connect(interface, server.endpoints[interface]) as connection:
        yield connection


@pytest.fixture(scope="session")
def bench_connection(bench_server, interface):
    with connect(interface, bench_server.endpoints[interface]) as connection:
        yield connection


def at_rest(module):
    """Stops the axis and puts back the parameters that the tests change."""
    motor = module.motors[0]
    module.stop(0)
    until(lambda: motor.actual_velocity == 0, what="standstill")
    motor.linear_ramp.max_velocity = 2000
    motor.linear_ramp.max_acceleration = 500
    return module


@pytest.fixture
def module(connection):
    """The module at rest at position 0."""
    module = at_rest(TMCM1140(connection))
    module.move_to(0, 0)
    until(module.motors[0].get_position_reached, what="position 0")
    return module


@pytest.fixture
def motor(module):
    return module.motors[0]


@pytest.fixture
def bench_module(bench_connection):
    """The module on the short axis, at rest wherever the last search left it."""
    return at_rest(TMCM1140(bench_connection))
