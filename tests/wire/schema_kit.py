"""proto/schema.json as the daemon reads it, and connections that hold what goes and comes against it."""

import functools
import json
import re
import unittest

from harness import SOURCE
from protocol_test import Connection

try:
    from jsonschema import Draft202012Validator, ValidationError, validators
except ImportError:
    Draft202012Validator = None

needs_jsonschema = unittest.skipUnless(Draft202012Validator, "no python3-jsonschema 4 or newer: scripts/install-deps installs it")
SCHEMA = json.loads((SOURCE / "proto/schema.json").read_text())
REFUSALS = {"bad_request", "unknown_method", "params_invalid", "resolution_invalid", "search_unknown"}


def max_bytes(validator, most, text, _):
    if isinstance(text, str) and len(text.encode()) > most:
        yield ValidationError(f"{text!r} has more than {most} bytes")


def matches(validator, pattern, text, _):
    if isinstance(text, str) and not re.search(pattern.replace("$", r"\Z"), text):
        yield ValidationError(f"{text!r} does not match {pattern}")


@functools.cache
def validator(name):
    """Of a definition, or of a whole line. Reads the schema as its description says: lengths are bytes, 1.0 is no integer. And `$` is the end, also before a last newline."""
    types = Draft202012Validator.TYPE_CHECKER.redefine("integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool))
    return validators.extend(Draft202012Validator, {"maxLength": max_bytes, "pattern": matches}, type_checker=types)(
        {"$ref": f"#/$defs/{name}", "$defs": SCHEMA["$defs"]} if name else SCHEMA)


def faults(name, value):
    """What the definition has against the value, as text; empty: nothing."""
    return "; ".join(error.message for error in validator(name).iter_errors(value))


def refused(reply):
    """Whether the server says that the request is none that it understands."""
    return "error" in reply and reply["error"]["data"]["code"] in REFUSALS


class Judged(Connection):
    """A connection that holds what goes and comes against the schema."""

    def __init__(self, address):
        super().__init__(address)
        self.requests = {}

    def send(self, content):
        super().send(content)
        try:
            request = json.loads(content)
        except ValueError:
            return  # a chunk, or a broken line of an example
        if isinstance(request, dict):
            self.requests[request.get("id")] = request

    def read_line(self):
        text = super().read_line()
        line = json.loads(text)
        assert not faults(None, line), f"{text}{faults(None, line)}"
        request = self.requests.get(line.get("id"))
        if request and "result" in line:
            found = faults(request["method"] + ".result", line["result"])
            assert not found, f"{text}{found}"
        if request:
            found = faults("request", request)
            assert bool(found) == refused(line), f"{request}\n{text}{found or 'the schema has nothing against it'}"
        return text


def ask(connection, method, /, **params):
    """The reply, whatever events come before it."""
    connection.send(json.dumps({"id": method, "method": method, "params": params}).encode())
    while True:
        line = json.loads(connection.read_line())
        if line.get("id") == method:
            return line
