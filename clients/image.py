"""A firmware image in QEMU, with a machine behind its pins."""

import argparse
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

import page
from page import Page
from waiting import until

ROOT = pathlib.Path(__file__).parents[1]
FOLDER = os.environ.get("PULSETRAIN_IMAGES")
EXAMPLES = pathlib.Path(os.environ.get("PULSETRAIN_EXAMPLES", ROOT / "target/debug/examples"))
FIGURES = os.environ.get("PULSETRAIN_FIGURES")

START_TIMEOUT_S = 10
# Within this, what changes on an input has become pulses, and what the controller does has reached the pins.
SETTLE_S = 0.002
# So long an instruction takes: 2 to this power, in nanoseconds.
INSTRUCTION_SHIFT = 3

# QEMU ends with whoever started it, whatever becomes of that.
QEMU = ["setpriv", "--pdeathsig", "KILL", "--", "qemu-system-arm"]


def machines(*benches):
    """What hangs on the pins of models or of the devices of bench files, as the simulator says."""
    output = subprocess.run([EXAMPLES / "machine", *benches], check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in output.splitlines()]


class Image:
    """A running image. `endpoint` is where its first serial port is."""

    def __init__(self, table, memory, *, endpoint="tcp:127.0.0.1:0", bus=None, rush=False, images=FOLDER):
        """The machine as `machines` gives it, the file of its memory, and the endpoints of its serial ports.

        Its time passes as the host's does, and where the host is late so is everything in it. In a rush it never
        sleeps: its time is that of its instructions alone, and nothing is late.
        """
        self.table = table
        self.memory = pathlib.Path(memory)
        self.console = self.memory.with_suffix(".console")
        self._images = images
        self._asked = [endpoint, bus]
        self.page = Page(self.memory)
        self.page.wire(table)
        self.page.write(page.SPIN, rush)
        self._process = None
        self.start()

    def start(self):
        """Switches it on, and waits until it is ready."""
        starts = self.page.word(page.STARTS)
        monitor, theirs = socket.socketpair()
        ports = [self._port(asked) for asked in self._asked]
        files = [theirs, *(place for _, place in ports if isinstance(place, socket.socket))]
        memory = f"memory-backend-file,id=ram,size=16M,mem-path={self.memory},share=on"
        command = [*QEMU, "-M", "mps2-an386,memory-backend=ram", "-object", memory]
        command += ["-icount", f"shift={INSTRUCTION_SHIFT}", "-display", "none"]
        command += ["-kernel", f"{self._images}/{self.table['model']}"]
        command += ["-chardev", f"socket,id=monitor,fd={theirs.fileno()}", "-mon", "chardev=monitor,mode=control"]
        for number, (device, _) in enumerate(ports):
            command += ["-chardev", f"{device},id=port{number}", "-serial", f"chardev:port{number}"]
        command += ["-chardev", f"file,id=console,path={self.console},append=on", "-serial", "chardev:console"]
        self._process = subprocess.Popen(
            command, pass_fds=[file.fileno() for file in files], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL
        )
        for file in files:
            file.close()
        self._monitor = monitor.makefile("rw")
        monitor.close()
        try:
            self._monitor.readline()
            self.monitor("qmp_capabilities")
            self.endpoint, self.bus = (self._endpoint(number, asked) for number, asked in enumerate(self._asked))
            self.wait_started(starts)
        except BaseException:
            self.kill()
            raise

    @staticmethod
    def _port(asked):
        """QEMU's words for a serial port, and the socket that it listens on if it does."""
        if asked is None:
            return "null", None
        kind, place = asked.split(":", 1)
        if kind == "pty":
            return "pty", None
        host, port = place.rsplit(":", 1)
        listener = socket.create_server((host, int(port)))
        return f"socket,fd={listener.fileno()},server=on,wait=off,nodelay=on", listener

    def _endpoint(self, number, asked):
        """Where a serial port is, in the words of the server."""
        if asked is None:
            return None
        devices = {device["label"]: device["filename"] for device in self.monitor("query-chardev")}
        place = devices[f"port{number}"].removeprefix("disconnected:").split(",")[0]
        link = asked.removeprefix("pty:")
        if not asked.startswith("pty:") or not link:
            return place
        pathlib.Path(link).unlink(missing_ok=True)
        pathlib.Path(link).symlink_to(place.removeprefix("pty:"))
        return asked

    def monitor(self, command):
        """A command of QEMU's monitor; gives what it returns."""
        self._monitor.write(json.dumps({"execute": command}) + "\n")
        self._monitor.flush()
        while True:
            answer = json.loads(self._monitor.readline())
            assert "error" not in answer, answer
            if "return" in answer:
                return answer["return"]

    def wait_started(self, starts):
        """Waits until it has started once more than so many times."""
        end = time.monotonic() + START_TIMEOUT_S
        while self.page.word(page.STARTS) == starts or self.page.word(page.READY) != page.MAGIC:
            assert self._process.poll() is None, f"QEMU ended with {self._process.returncode}"
            assert time.monotonic() < end, f"{self.table['model']} did not start: {self.said()}"
            time.sleep(0.002)

    def said(self):
        """What it has told on its console, as lines."""
        return self.console.read_text(errors="replace").splitlines() if self.console.exists() else []

    def pin(self, name):
        """The number of a pin, and what the table says of it."""
        return next((number, pin) for number, pin in enumerate(self.table["pins"]) if pin["name"] == name)

    def drive(self, name, value):
        """Puts a level or a number on a pin, or gives it back to the machine if the value is `None`."""
        number, pin = self.pin(name)
        self.page.put(number, pin, value)
        self.settle()

    def settle(self):
        """Waits until what was done has reached the pins, or what is on them the controller."""
        end = self.time() + SETTLE_S
        until(lambda: self.time() >= end, what="the main loop")

    def time(self):
        """Seconds of its own since it started, to the millisecond."""
        return self.page.settled(page.TIME) / self.page.word(page.TIMER_HZ)

    def read(self, name):
        """What it drives on a pin: a level, or a number in the pin's unit."""
        number, pin = self.pin(name)
        self.settle()
        value = self.page.output(number)
        value = pin["rest"] if value is None else value
        return page.signed(value) / pin["scale"] if pin["analog"] else bool(value)

    def power_cycle(self):
        """Off and on again. Whoever is connected stays so."""
        starts = self.page.word(page.STARTS)
        self.monitor("system_reset")
        self.wait_started(starts)

    def kill(self):
        """Ends it at this very instruction."""
        self._process.kill()
        self._process.wait()
        self._monitor.close()

    def stop(self):
        """Ends it, and takes down what it measured of itself."""
        size, unused = self.page.word(page.STACK_SIZE), self.page.word(page.STACK_UNUSED)
        # One that was stopped by a fault may have no stack left, one that has just begun has not looked.
        if FIGURES and self._process.poll() is None and not self.page.word(page.STOPPED) and unused:
            note(model=self.table["model"], stack_size=size, stack_used=size - unused, slips=self.page.word(page.SLIPS))
        self.kill()
        self.page.close()

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.stop()


def note(**figures):
    """Takes down figures for `cargo xtask firmware`, which reads a line of JSON for each."""
    if FIGURES:
        with open(FIGURES, "a") as file:
            file.write(json.dumps(figures) + "\n")


def main():
    """Runs an image until it is interrupted."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("model")
    parser.add_argument("--images", required=True, help="the folder of the images")
    parser.add_argument("--tcp", metavar="PORT", help="where it listens; without it on a pseudo-terminal")
    parser.add_argument("--flash", metavar="FILE", help="the file of its memory; without it nothing is kept")
    arguments = parser.parse_args()
    endpoint = f"tcp:127.0.0.1:{arguments.tcp}" if arguments.tcp else "pty:"
    folder = None if arguments.flash else tempfile.mkdtemp(prefix="pulsetrain-")
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        [table] = machines(arguments.model)
        memory = arguments.flash or pathlib.Path(folder) / "memory"
        with Image(table, memory, endpoint=endpoint, images=arguments.images) as image:
            print(f"ready {arguments.model} {image.endpoint}", flush=True)
            signal.pause()
    except KeyboardInterrupt:
        pass
    finally:
        if folder:
            shutil.rmtree(folder)


if __name__ == "__main__":
    main()
