"""Bench files and their JSON Schema, as an editor takes them."""

import copy
import json
import pathlib
import subprocess
import tomllib

import jsonschema
import pytest

from server import PROGRAM

EXAMPLES = sorted((pathlib.Path(__file__).parents[1] / "examples/bench").glob("*.toml"))

pytestmark = pytest.mark.server_only


@pytest.fixture(scope="module")
def validator():
    text = subprocess.run([PROGRAM, "bench", "schema"], capture_output=True, check=True, timeout=10).stdout
    schema = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def is_accepted(path):
    return subprocess.run([PROGRAM, "bench", "check", path], capture_output=True, timeout=10).returncode == 0


def test_there_are_examples():
    assert len(EXAMPLES) >= 10


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_examples_are_what_the_schema_says(validator, path):
    validator.validate(tomllib.loads(path.read_text()))
    assert is_accepted(path)


@pytest.mark.parametrize(
    "entries",
    [
        "colour = 3",
        "home = [1]",
        "home = [1, 9000000000000]",
        "load = -0.5",
        "load = 'a'",
        "encoder_ratio = 0.0",
        "encoder_at = 'door'",
        "slowdown = [0, 1, 2]",
        "backlash = 0.5",
        "bounce_ms = 5000",
        "circumference = 1",
        "normally_closed = ['index']",
        "pull_out = []",
        "pull_out = [[0, 1, 2]]",
        "pull_out = [[0, -1]]",
        "cam = [{pin = 'DI1'}]",
        "cam = [{pin = 'DI1', on = [0, 1], off = [2, 3]}]",
        "joystick = 2",
    ],
)
def test_what_the_schema_refuses_is_refused(validator, tmp_path, entries):
    text = f"[[device]]\nmodel = 'pmx-2ed'\n[device.axis.X]\n{entries}\n"
    assert not validator.is_valid(tomllib.loads(text))
    path = tmp_path / "bench.toml"
    path.write_text(text)
    assert not is_accepted(path)


def test_a_device_needs_its_model(validator):
    good = {"device": [{"model": "pmx-2ed"}]}
    validator.validate(good)
    bad = copy.deepcopy(good)
    del bad["device"][0]["model"]
    assert not validator.is_valid(bad)
    assert not validator.is_valid({"device": [{"model": "pmx-3ed"}]})
