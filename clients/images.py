"""Firmware images with the face of the server: the same arguments, the same names, the same calls."""

import math
import pathlib
import tempfile
import urllib.parse

from image import FOLDER, Image, machines

__all__ = ["FOLDER", "Images", "overrun"]


# An image plays pulses that were planned this long before, and a switch cannot call them back.
HORIZON_S = 0.0005


def overrun(speed_pps):
    """How many pulses an axis may go over a switch: a virtual controller stops at the pulse."""
    return math.ceil(speed_pps * HORIZON_S) + 1 if FOLDER else 0


class Images:
    """Each device is an image in a QEMU of its own. Time passes as it does: `--speed` changes nothing."""

    def __init__(self, *arguments, devices, http=False):
        del http  # What HTTP does is done here.
        folder = tempfile.TemporaryDirectory(prefix="pulsetrain-")
        self._folder, state, tables = folder, pathlib.Path(folder.name), []
        rest = list(arguments)
        while rest:
            match rest.pop(0):
                case "--bench":
                    tables += machines(rest.pop(0))
                case "--state":
                    state = pathlib.Path(rest.pop(0))
                    state.mkdir(exist_ok=True)
                case "--speed":
                    rest.pop(0)
                case device:
                    tables.append(self._table(device))
        assert len(tables) == devices
        self._images = {}
        try:
            for table in tables:
                name, [endpoint] = table["name"], table["listen"]
                self._images[name] = Image(table, state / f"{name}.memory", endpoint=endpoint)
        except BaseException:
            self.stop()
            raise
        self.endpoints = {name: image.endpoint for name, image in self._images.items()}

    @staticmethod
    def _table(device):
        """`MODEL[=NAME]@ENDPOINT`"""
        what, endpoint = device.split("@", 1)
        model, _, name = what.partition("=")
        [table] = machines(model)
        return table | {"name": name or model, "listen": [endpoint]}

    def __getitem__(self, name):
        return self._images[name]

    def call(self, method, path, value=None):
        """What the HTTP interface does with a call below `/api/devices/`."""
        name, what, *pin = (urllib.parse.unquote(part) for part in path.split("/"))
        image = self._images[name]
        match method, what:
            case "POST", "power-cycle":
                return image.power_cycle()
            case "GET", "pins":
                return image.read(*pin)
            case "PUT" | "DELETE", "pins":
                return image.drive(*pin, value)
        raise NotImplementedError(f"{method} {path}")

    def drive(self, device, pin, value):
        """Puts a level or a number on a pin, or gives it back to the machine if the value is `None`."""
        self._images[device].drive(pin, value)

    def stop(self):
        """Ends them all."""
        for image in self._images.values():
            image.stop()
        self._folder.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.stop()
