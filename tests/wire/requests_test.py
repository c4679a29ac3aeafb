"""The daemon refuses exactly the requests that proto/schema.json refuses: at each edge of each field, and changed at random."""

import calendar
import copy
import functools
import itertools
import json
import random
import tempfile
import unittest

import shapes
from harness import SOURCE, Daemon
from protocol_test import Connection
from schema_kit import SCHEMA, ask, faults, needs_jsonschema, refused
from sculpt import Client

SEED, CASES = 1, 2000


def paths(value, path=()):
    """Of every part of a JSON value."""
    parts = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in parts:
        yield (*path, key)
        yield from paths(part, (*path, key))


def part_at(value, path):
    return functools.reduce(lambda holder, key: holder[key], path, value)


def speaking_of(schema, path):
    """The parts of a schema that speak of what is at the path."""
    if "$ref" in schema:
        yield from speaking_of(SCHEMA["$defs"][schema["$ref"].removeprefix("#/$defs/")], path)
    for part in itertools.chain.from_iterable(schema.get(word, ()) for word in ("oneOf", "anyOf", "allOf")):
        yield from speaking_of(part, path)
    if not path:
        yield schema
    elif path[0] in schema.get("properties", {}):
        yield from speaking_of(schema["properties"][path[0]], path[1:])
    elif "items" in schema:
        yield from speaking_of(schema["items"], path[1:])


FIELDS = sorted({field for definition in SCHEMA["$defs"].values() for field in definition.get("properties", ())} | {"strange"})
KINDS = [None, True, False, 0, -1, 0.5, 1e300, 1 << 63, 1 << 64, "", "é", [], {}, [0, 0, 0], [1, 0], [0, 0.5, "0"]]
TEXTS = ["", "a", "a" * 1025, "A" * 64, "gantry", "gantry.json", "json", ".json", ".gantry", "../gantry", "a/b", "a\\b", "a.json\n", "a.STL", "a.stl\n", ".stl", "..stl", "a.", "a/.stl", "a.stl/",
         "2100-02-28T00:00:00Z", "2100-02-29T00:00:00Z", "2104-02-29T23:59:59.999Z", "2104-02-29T23:59:59.9999Z", "2100-13-01T00:00:00Z", "2100-04-31T00:00:00Z", "2100-00-01T00:00:00Z",
         "2100-01-01T24:00:00Z", "2100-01-01T00:60:00Z", "2100-01-01T00:00:60Z", "2100-01-01T00:00:00.Z", "2100-01-01T00:00:00", "2100-01-01T00:00:00Z\n", "2100-01-01T00:00:00+00:00"]


def around(schema):
    """Values on both sides of what the schema allows."""
    for word in ("minimum", "exclusiveMinimum", "maximum"):
        if word in schema:
            yield from (schema[word] - 1, schema[word], schema[word] + 1)
    if "maxLength" in schema:
        most = schema["maxLength"]
        yield from ("a" * most, "a" * (most + 1), "é" * (most // 2), "é" * (most // 2) + "a", "a" * (most - 4) + ".stl", "a" * (most - 3) + ".stl")
    yield from schema.get("enum", ())


def edges(request, path):
    """Values for what is at the path of a good request."""
    schema, inner = ("request", path) if path[0] != "params" else (request["method"] + ".params", path[1:])
    for speaking in speaking_of(SCHEMA["$defs"][schema], inner):
        yield from around(speaking)
    part = part_at(request, path)
    if isinstance(part, str):
        yield from TEXTS
    elif isinstance(part, list):
        yield from (part[:-1], part + part[-1:])
    elif isinstance(part, int) and not isinstance(part, bool):
        yield from (float(part), -1, 1 << 63, 1 << 64)


def replaced(request, path, value):
    request = copy.deepcopy(request)
    part_at(request, path[:-1])[path[-1]] = value
    return request


def mutated(chance, request):
    """The request with one part replaced by another kind, removed, added to or touched up."""
    path = chance.choice(list(paths(request)))
    request = copy.deepcopy(request)
    holder, key = part_at(request, path[:-1]), path[-1]
    part, value, kind = holder[key], chance.choice(KINDS), chance.choice(["replace", "remove", "add", "touch"])
    if kind == "remove":
        del holder[key]
    elif kind == "add" and isinstance(part, dict):
        part[chance.choice(FIELDS)] = value
    elif kind == "add" and isinstance(part, list):
        part.append(value)
    elif kind == "touch" and isinstance(part, str):
        at = chance.randrange(len(part) + 1)
        holder[key] = part[:at] + chance.choice("0aAé./\\:-Z\n") + part[at + chance.randrange(2):]
    elif kind == "touch" and isinstance(part, (int, float)):
        holder[key] = part + chance.choice([-1, 1, 0.5, 1e6])
    else:
        holder[key] = value
    return request


def exists(moment):
    """Whether the calendar has the day of a well-formed moment."""
    year, month, day = map(int, moment[:10].split("-"))
    return day <= calendar.monthrange(year, month)[1]


def with_fraction(moment):
    """So that text sorts like time."""
    seconds, _, fraction = moment[:-1].partition(".")
    return f"{seconds}.{fraction:0<3}"


def breaks_a_rule_between_fields(request):
    """What the schema does not say: a piece ends within its blob, a job may start before it must have, holds are in their order, days are those of the calendar, a job has the resolution of the one that it continues."""
    params = request.get("params", {})
    if request["method"] == "blob.put":
        return params["offset"] + params["bytes"] > params["size"]
    if request["method"] == "job.samples":
        holds = params.get("holds_s", [])
        return holds != sorted(holds)
    if request["method"] == "job.submit":
        if "continue" in params["spec"] and params["spec"]["resolution"] != 8:
            return True
        moments = [params[field] for field in ("not_before", "start_by") if field in params]
        return not all(map(exists, moments)) or (len(moments) == 2 and with_fraction(moments[0]) >= with_fraction(moments[1]))
    return False


@needs_jsonschema
class Requests(unittest.TestCase):
    """The schema and the daemon agree on what a request is."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        self.addCleanup(folder.cleanup)
        self.daemon = Daemon(f"{folder.name}/data")
        self.addCleanup(self.daemon.stop)
        self.numbers = itertools.count()
        with Client(self.daemon.address) as client:
            self.mesh = client.upload_file(shapes.write_stl(f"{folder.name}/mesh.stl", shapes.steps()))
            self.bundle = client.upload_cell(SOURCE / "config/cells/gantry.json")
            self.done = client.call("job.submit", spec={"mesh": self.mesh, "robot": "gantry", "resolution": 8})["job"]
            client.wait(self.done)
            self.job = client.call("job.submit", not_before="2100-01-31T12:00:00Z", spec={"mesh": self.mesh, "robot": "gantry", "resolution": 8})["job"]

    def samples(self):
        """A good request of each method, with everything that it may have. What they name is not there, so that nothing else can be wrong."""
        nobody, blob = "0" * 26, "0" * 64
        spec = {"mesh": self.mesh, "resolution": 8, "search": "octree", "seed": 1, "threads": 1}
        placement = {"scale_m": 0.01, "rotation_rad": [0, 0.5, 0], "offset_m": [0, 0, 0.01], "margin_m": 0}
        times = {"not_before": "2100-01-31T12:00:00Z", "start_by": "2100-02-28T12:00:00.5Z"}
        yield "hello", {"protocol": [1, 0], "client": "test", "token": "t", "max_line": 1024}
        for method in ("ping", "server.info", "queue.pause", "queue.resume"):
            yield method, {}
        yield "server.schema", {"method": "ping"}
        yield "server.schema", {"part": "report_time"}
        yield "blob.has", {"sha256": blob}
        yield "blob.put", {"sha256": blob, "size": 1 << 40, "offset": 0, "bytes": 8}
        yield "cell.check", {"robot": "gantry", "resolution": 8}
        yield "cell.check", {"robot": self.bundle}
        yield "job.submit", {"key": "k", "priority": 1, "queue": "default", **times, "max_runtime_s": 60, "spec": {
            **spec, "robot": "gantry", "placement": placement, "stock": {"box": {"min_m": [0, 0, 0], "max_m": [0.1, 0.1, 0.1]}}}}
        yield "job.submit", {**times, "spec": {**spec, "robot": self.bundle, "stock": {"mesh": self.mesh}}}
        yield "job.submit", {**times, "spec": {**spec, "robot": "gantry", "continue": {"job": self.done, "rotation_rad": [0, 0, 0]}}}
        for method in ("get", "cancel", "pause", "resume", "retry", "report", "verify"):
            yield f"job.{method}", {"job": nobody}
        motion = {"feed_m_s": 0.05, "rapid_m_s": 0.5, "keep_feed": 0.01}
        yield "job.samples", {"job": nobody, "motion": motion, "rate_hz": 250, "from_s": 1, "to_s": 2.5, "count": 10, "holds_s": [0.5, 1]}
        yield "job.submit", {**times, "spec": {**spec, "robot": "gantry", "motion": motion}}
        yield "job.list", {"order": "newest", "after": nobody, "before": nobody, "limit": 10}
        yield "job.wait", {"job": nobody, "timeout_s": 1}
        yield "events.subscribe", {"job": nobody, "after": 1}
        yield "events.unsubscribe", {"job": nobody}
        yield "artifact.list", {"job": nobody}
        for artifact, format in (("trajectory", "csv"), ("timeline", "gzip"), ("residue", "gzip"), ("voxels", "binvox"), ("stock", "binvox"), ("stock", "zip"), ("surface", "ply"), ("residue", "ndjson"), ("report", "json")):
            yield "artifact.read", {"job": self.job, "artifact": artifact, "format": format, "offset": 0, "bytes": 8}
        for artifact, format in (("trajectory", "csv"), ("timeline", "gzip")):
            yield "artifact.link", {"job": self.job, "artifact": artifact, "format": format}
        program = {"dialect": "gcode", "name": "bust", "motion": motion, "part_keyframes": 100, "part_bytes": 100000, "stock_files": True, "seams_in_stock": True}
        yield "artifact.read", {"job": self.job, "artifact": "program", "format": "zip", "offset": 0, "bytes": 8, "program": program}
        yield "artifact.link", {"job": self.job, "artifact": "program", "format": "zip", "program": program}
        yield "job.cell", {"job": nobody, "file": blob, "offset": 0, "bytes": 8}
        yield "artifact.pin", {"job": nobody, "pinned": False}

    def ask(self, request):
        """The reply, on a connection of its own."""
        connection = Connection(self.daemon.address)
        try:
            ask(connection, "hello", protocol=[1, 0], client="test")
            params = request.get("params")
            chunk = params.get("bytes") if isinstance(params, dict) and request.get("method") == "blob.put" else None
            announced = isinstance(chunk, int) and not isinstance(chunk, bool) and 0 <= chunk <= 1 << 22
            connection.send(json.dumps(request).encode() + (b"\n" + b"x" * chunk if announced else b""))
            return json.loads(connection.read_line())
        finally:
            connection.close()

    def requests(self):
        return [{"jsonrpc": "2.0", "id": 1, "method": method, "params": params} for method, params in self.samples()]

    def check(self, request):
        """Whether the daemon refuses it; it must do what the schema does."""
        if isinstance(request.get("params"), dict) and request["params"].get("key") == "k":
            request["params"]["key"] = f"key {next(self.numbers)}"  # of one that is used again nothing else is looked at
        found = faults("request", request)
        reply = self.ask(request)
        wanted = bool(found) or breaks_a_rule_between_fields(request)
        self.assertEqual(refused(reply), wanted, f"{json.dumps(request)}\n{json.dumps(reply)}\nschema: {found or 'fine'}")
        return wanted

    def test_a_good_request_is_good_for_both(self):
        self.assertEqual({request["method"] for request in self.requests()}, set(SCHEMA["$defs"]["method"]["enum"]))
        for request in self.requests():
            self.assertFalse(self.check(request))

    def test_at_every_edge_of_every_field_both_say_the_same(self):
        cases = [(request, path, value) for request in self.requests() for path in paths(request) for value in edges(request, path)]
        refusals = sum(self.check(replaced(*case)) for case in cases)
        self.assertTrue(len(cases) / 10 < refusals < len(cases), f"{refusals} of {len(cases)}")

    def test_of_requests_changed_at_random_both_say_the_same(self):
        print(f"seed {SEED}", flush=True)
        chance, requests = random.Random(SEED), self.requests()
        refusals = sum(self.check(mutated(chance, chance.choice(requests))) for _ in range(CASES))
        self.assertTrue(CASES / 10 < refusals < CASES * 9 / 10, refusals)


if __name__ == "__main__":
    unittest.main()
