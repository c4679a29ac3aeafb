"""What the daemon says, in the examples and elsewhere, is what proto/schema.json says."""

import json
import tempfile
import unittest
import urllib.request

import shapes
from harness import Daemon
from protocol_test import CELL_CONTROLLER, PROTOCOL, play, sessions
from schema_kit import SCHEMA, Draft202012Validator, Judged, ask, needs_jsonschema
from sculpt import Client


@needs_jsonschema
class Live(unittest.TestCase):
    """What a daemon says."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.daemon = Daemon(f"{folder.name}/data")
        self.addCleanup(self.daemon.stop)

    def connect(self, **hello):
        connection = Judged(self.daemon.address)
        self.addCleanup(connection.close)
        ask(connection, "hello", protocol=[1, 0], client="test", **hello)
        return connection

    def upload(self, triangles):
        with Client(self.daemon.address) as client:
            return client.upload_file(shapes.write_stl(f"{self.folder}/mesh.stl", triangles))

    def play(self, document):
        names = {}
        for number, lines in sessions(document.read_text()):
            with self.subTest(line=number):
                play(lines, number, self.daemon.address, names, document.name, Judged)

    def test_every_session_of_the_protocol(self):
        self.play(PROTOCOL)

    def test_every_session_of_the_cell_controller(self):
        self.play(CELL_CONTROLLER)

    def test_the_document_itself_over_both_doors(self):
        whole = ask(self.connect(), "server.schema")["result"]
        self.assertEqual(whole, SCHEMA)
        Draft202012Validator.check_schema(whole)
        with urllib.request.urlopen(f"http://{self.daemon.address}/schema.json") as reply:
            self.assertEqual(reply.headers["Content-Type"], "application/schema+json")
            self.assertEqual(json.load(reply), SCHEMA)

    def test_every_part_fits_into_a_short_line_and_stands_alone(self):
        for method in SCHEMA["$defs"]["method"]["enum"]:
            part = ask(self.connect(max_line=8192), "server.schema", method=method)["result"]
            Draft202012Validator.check_schema(part)
            self.assertEqual(part["$defs"][method + ".params"], SCHEMA["$defs"][method + ".params"])
        for name in SCHEMA["$defs"]["schema_part"]["enum"]:
            part = ask(self.connect(max_line=8192), "server.schema", part=name)["result"]
            Draft202012Validator.check_schema(part)
            self.assertEqual(part["$defs"][name], SCHEMA["$defs"][name])

    def test_every_part_has_room_for_more(self):
        for method in SCHEMA["$defs"]["method"]["enum"]:
            self.assertIn("result", ask(self.connect(max_line=7680), "server.schema", method=method))

    def submit_long(self, connection, **params):
        """A job that would take minutes."""
        spec = {"mesh": self.upload(shapes.ball()), "robot": "panda-turntable", "resolution": 256}
        return ask(connection, "job.submit", spec=spec, **params)["result"]["job"]

    def test_a_job_that_is_followed_and_cancelled(self):
        connection = self.connect()
        job = self.submit_long(connection)
        ask(connection, "events.subscribe", job=job)
        while json.loads(connection.read_line())["params"]["type"] != "progress":
            pass
        self.assertIn("progress", ask(connection, "job.get", job=job)["result"])
        self.assertEqual(ask(connection, "job.cancel", job=job)["result"]["state"], "cancelling")
        self.assertEqual(ask(connection, "job.wait", job=job, timeout_s=86400)["result"]["state"], "cancelled")
        ask(connection, "artifact.pin", job=job)
        self.assertTrue(ask(connection, "job.get", job=job)["result"]["pinned"])

    def test_a_job_that_runs_too_long_told_in_short_lines(self):
        connection = self.connect(max_line=256)
        job = self.submit_long(connection, max_runtime_s=1)
        failed = ask(connection, "job.wait", job=job, timeout_s=86400)["result"]
        self.assertEqual(failed["error"]["code"], "run_time_exceeded")
        ask(connection, "events.subscribe", job=job)
        events = [json.loads(connection.read_line())["params"] for _ in ("queued", "running", "failed", "live")]
        self.assertEqual([event.get("more", False) for event in events], [False, False, True, False])

    def test_a_plan_that_leaves_something(self):
        connection = self.connect()
        hollow = self.upload(shapes.box((0, 0, 0), (8, 8, 8)) + [facet[::-1] for facet in shapes.box((2, 2, 2), (6, 6, 6))])
        job = ask(connection, "job.submit", spec={"mesh": hollow, "robot": "gantry", "resolution": 16})["result"]["job"]
        self.assertEqual(ask(connection, "job.wait", job=job, timeout_s=86400)["result"]["state"], "succeeded")
        self.assertTrue(ask(connection, "job.report", job=job)["result"]["residue"])


if __name__ == "__main__":
    unittest.main()
