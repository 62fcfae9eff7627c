"""The HTTP interface answers what its own document says."""

import json

import jsonschema
import pytest

from server import Server

MODELS = {"pd42-1140": ("0", "HOME"), "pmx-2ed": ("X", "DI1"), "cmd-4cr": ("U", "+LX")}

# What stands in paths for each place in braces, beside the device with its axis and pin.
PLACES = {"id": "1", "program": "0", "parameter": "none"}

# Answers that are no JSON.
SOCKETS = ["/stream", "/live", "/lsp"]


@pytest.fixture(scope="module")
def server():
    devices = [f"{model}@tcp:127.0.0.1:0" for model in MODELS]
    with Server(*devices, devices=len(devices), http=True) as server:
        yield server


@pytest.fixture(scope="module")
def document(server):
    return server.ask("GET", "/api/openapi.json")


def check(document, operation, status, answer):
    """The answer has the form that the operation declares for the status."""
    responses = operation["responses"]
    content = responses.get(str(status), responses["default"]).get("content")
    if content is None:
        assert answer is None
        return
    schema = dict(content["application/json"]["schema"], components=document["components"])
    jsonschema.Draft202012Validator(schema).validate(answer)


def filled(path, model):
    axis, pin = MODELS[model]
    return path.format(**PLACES, device=model, model=model, axis=axis, pin=pin)


@pytest.mark.server_only
@pytest.mark.parametrize("model", MODELS)
def test_everything_that_can_be_read_has_the_form_that_is_declared(server, document, model):
    read = 0
    for path, item in document["paths"].items():
        if "get" not in item or path.endswith(tuple(SOCKETS)) or path == "/api/serial-ports":
            continue
        status, answer = server.ask("GET", filled(path, model), whole=True)
        assert status < 500, (path, answer)
        check(document, item["get"], status, answer)
        read += 1
    assert read > 5


@pytest.mark.server_only
@pytest.mark.parametrize(
    ("method", "path", "value", "status"),
    [
        ("put", "/api/devices/{device}/pins/{pin}", True, 204),
        ("put", "/api/devices/{device}/pins/{pin}", "on", 422),
        ("delete", "/api/devices/{device}/pins/{pin}", None, 204),
        ("put", "/api/devices/{device}/axes/{axis}/load", 0.25, 204),
        ("put", "/api/devices/{device}/axes/{axis}/load", -1, 422),
        ("post", "/api/devices/{device}/faults", {"kind": "stuck_switch", "pin": "DI1", "value": True}, 201),
        ("post", "/api/devices/{device}/faults", {"kind": "none"}, 422),
        ("delete", "/api/devices/{device}/faults", None, 204),
        ("post", "/api/devices/{device}/power-cycle", None, 204),
        ("post", "/api/lease", {"name": "test"}, 200),
        ("post", "/api/lease", {"name": "another"}, 423),
        ("post", "/api/lease", {}, 422),
    ],
)
def test_what_changes_something_answers_as_declared(server, document, method, path, value, status):
    operation = document["paths"][path][method]
    got, answer = server.ask(method.upper(), filled(path, "pmx-2ed"), value, whole=True)
    assert got == status, answer
    check(document, operation, status, answer)
    if value is not None and status < 300:
        schema = dict(operation["requestBody"]["content"]["application/json"]["schema"])
        jsonschema.Draft202012Validator(dict(schema, components=document["components"])).validate(value)


@pytest.mark.server_only
def test_the_document_is_what_it_says_it_is(document):
    assert document["openapi"].startswith("3.")
    assert json.dumps(document).count('"$ref"') > 0
    for schema in document["components"]["schemas"].values():
        jsonschema.Draft202012Validator.check_schema(schema)
