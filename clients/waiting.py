"""Waiting for the device, which lives in real time."""

import time


def until(condition, timeout_s=10, what="the condition"):
    """Polls until `condition()` is true, and gives its value."""
    end = time.monotonic() + timeout_s
    while not (value := condition()):
        assert time.monotonic() < end, f"{what} did not come true within {timeout_s} s"
    return value
