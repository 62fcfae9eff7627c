"""The program under test: `pulsetrain serve` as a child process, driven through its stable interface only."""

import json
import os
import pathlib
import signal
import subprocess
import threading
import urllib.error
import urllib.parse
import urllib.request

import images

PROGRAM = pathlib.Path(
    os.environ.get("PULSETRAIN", pathlib.Path(__file__).parents[1] / "target/debug/pulsetrain")
)
START_TIMEOUT_S = 10
STOP_TIMEOUT_S = 10


class Server:
    """A running server. `endpoints` has the `ready` lines as a dictionary from name to endpoint."""

    def __init__(self, *arguments, devices, http=False):
        self._process = subprocess.Popen(
            [PROGRAM, "serve", *arguments, *(["--http", "127.0.0.1:0"] if http else ["--no-http"])],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.endpoints = {}
        # A child that never becomes ready is ended, which ends the reading of its output.
        watchdog = threading.Timer(START_TIMEOUT_S, self._process.kill)
        watchdog.start()
        try:
            while len(self.endpoints) < devices + http:
                line = self._process.stdout.readline()
                if not line:
                    self._process.kill()
                    raise RuntimeError(f"the server ended with {self._process.wait()} before it was ready")
                word, name, endpoint = line.split(maxsplit=2)
                assert word == "ready", line
                self.endpoints[name] = endpoint.strip()
        finally:
            watchdog.cancel()

    def ask(self, method, path, value=None, whole=False):
        """A request of the HTTP interface; gives what it answers, and with `whole` the status before it. Without,
        an error is an exception."""
        url = urllib.parse.urlsplit(self.endpoints["http"])
        token = urllib.parse.parse_qs(url.query)["token"][0]
        request = urllib.request.Request(
            f"http://{url.netloc}{urllib.parse.quote(path, safe='/%')}",
            method=method,
            data=None if value is None else json.dumps(value).encode(),
            headers={"Authorization": f"Bearer {token}"},
        )
        try:
            with urllib.request.urlopen(request, timeout=10) as answer:
                status, body = answer.status, answer.read()
        except urllib.error.HTTPError as error:
            if not whole:
                raise
            status, body = error.code, error.read()
        body = json.loads(body) if body else None
        return (status, body) if whole else body

    def call(self, method, path, value=None):
        """A call of the HTTP interface below `/api/devices/`; gives what it answers."""
        return self.ask(method, f"/api/devices/{path}", value)

    def drive(self, device, pin, value):
        """Puts a level or a number on a pin, or gives it back to the machine if the value is `None`."""
        place = f"{device}/pins/{urllib.parse.quote(pin, safe='')}"
        self.call("DELETE" if value is None else "PUT", place, value)

    def stop(self, how=signal.SIGTERM):
        """Asks the server to end and gives its exit status."""
        self._process.send_signal(how)
        try:
            return self._process.wait(STOP_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            raise
        finally:
            self._process.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        status = self.stop()
        if kind is None:
            assert status == 0, f"the server ended with status {status}"


def serve(*arguments, devices, http=False):
    """What the tests talk to: a server, or firmware images in its place where the environment names them."""
    if images.FOLDER:
        return images.Images(*arguments, devices=devices)
    return Server(*arguments, devices=devices, http=http)


def pulsetrain(*arguments):
    """Runs the program to its end; fails, with what it said, unless its status is 0."""
    done = subprocess.run([PROGRAM, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout
