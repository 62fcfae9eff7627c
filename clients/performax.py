"""A virtual PMX-2ED-SA behind each of the interfaces that pylablib can speak to it."""

import pytest
from pylablib.devices import Arcus

from images import FOLDER
from server import serve

# See INTERFACES of trinamic.py.
PERFORMAX_INTERFACES = ["tcp"] if FOLDER else ["pty", "tcp"]
AXES = ["X", "Y"]

# The bounds of both axes of the bench, in pulses.
NEGATIVE_LIMIT, POSITIVE_LIMIT = -8000, 12000

BENCH = """
[[device]]
model = "pmx-2ed"
name = "{name}"
listen = ["{endpoint}"]
""" + "".join(
    f"""
[device.axis.{axis}]
negative_limit = {NEGATIVE_LIMIT}
positive_limit = {POSITIVE_LIMIT}
home = [1000, 3000]
index_every = 500
"""
    for axis in AXES
)


def performax_endpoint(interface, folder):
    """Where a device of its own listens on this interface."""
    return f"pty:{folder / 'pty'}" if interface == "pty" else "tcp:127.0.0.1:0"


def performax_connect(endpoint, **arguments):
    """Opens an unmodified pylablib stage at an endpoint as the server names it."""
    kind, place = endpoint.split(":", 1)
    if kind == "tcp":
        host, port = place.split(":")
        return Arcus.Performax2EXStage(conn=(host, int(port)), **arguments)
    return Arcus.Performax2EXStage(conn=(place, 9600), **arguments)


@pytest.fixture(scope="session", params=PERFORMAX_INTERFACES)
def performax_interface(request):
    return request.param


@pytest.fixture(scope="module")
def performax_speed():
    """Seconds of device time a second; a file of tests may have its own."""
    return 1


@pytest.fixture(scope="module")
def performax_server(tmp_path_factory, performax_speed):
    """One server with a device for each interface, on short axes."""
    folder = tmp_path_factory.mktemp("performax")
    devices = [(name, performax_endpoint(name, folder)) for name in PERFORMAX_INTERFACES]
    bench = folder / "bench.toml"
    bench.write_text("".join(BENCH.format(name=name, endpoint=endpoint) for name, endpoint in devices))
    arguments = ["--bench", str(bench), "--speed", str(performax_speed)]
    with serve(*arguments, devices=len(devices), http=True) as server:
        yield server


@pytest.fixture(scope="module")
def performax_connection(performax_server, performax_interface):
    stage = performax_connect(performax_server.endpoints[performax_interface])
    yield stage
    stage.close()


@pytest.fixture
def drive(performax_server, performax_interface):
    """Puts something on a pin of the device until the end of the test."""
    driven = []

    def put(pin, value):
        driven.append(pin)
        performax_server.drive(performax_interface, pin, value)

    yield put
    for pin in driven:
        performax_server.drive(performax_interface, pin, None)


@pytest.fixture
def stage(performax_connection):
    """The stage at rest at position 0, with the usual speeds and nothing latched."""
    stage = performax_connection
    stage.stop(immediate=True)
    stage.enable_limit_errors(False)
    stage.enable_absolute_mode()
    stage.enable_axis()
    stage.set_global_speed(20000)
    stage.set_axis_speed("all", 0)
    for command in ["LSPD=500", "ACC=100", "DEC=100", "EDEC=0"]:
        assert stage.query(command) == "OK"
    for axis in AXES:
        stage.move_to(axis, 0)
    stage.wait_move("all", timeout=20, period=0.005)
    assert stage.get_position() == [0, 0]
    return stage


def arrived(stage, axis="all"):
    stage.wait_move(axis, timeout=20, period=0.005)


def status(stage, axis):
    """The status of an axis, without bit 9: the client takes it for an alarm, here it is the Z index."""
    return set(stage.get_status(axis)) - {"err_alarm"}


def replied(stage, command, expected="OK"):
    assert stage.query(command) == expected, command
