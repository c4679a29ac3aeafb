"""What the tests of the one port share: a socket that speaks lines, daemons with settings, one with a finished job."""

import http.client
import json
import pathlib
import socket
import tempfile
import time

import shapes
from harness import PATIENCE_S, ClientTest, Daemon

import sculpt

HELLO = {"jsonrpc": "2.0", "id": 1, "method": "hello", "params": {"protocol": [1, 0], "client": "door_test"}}


def line(message):
    return json.dumps(message).encode() + b"\n"


def call(request_id, method, **params):
    return {"jsonrpc": "2.0", "id": request_id, "method": method, "params": params}


class Wire:
    """A socket that sends and reads lines."""

    def __init__(self, address, connected=None):
        self.socket = connected or socket.create_connection(split(address), timeout=PATIENCE_S)
        self.stream = self.socket.makefile("rb")

    def ask(self, message):
        self.socket.sendall(line(message))
        return self.read()

    def read(self):
        """The next message, or None at the end."""
        try:
            return json.loads(self.stream.readline() or "null")
        except ConnectionResetError:
            return None

    def word(self):
        message = self.read()
        return message and message["error"]["data"]["code"]

    def close(self):
        self.stream.close()
        self.socket.close()


def split(address):
    host, _, port = address.rpartition(":")
    return host, int(port)


class DoorTest(ClientTest):
    """Each test starts its own daemons; with their settings."""

    def daemon(self, *options, files=None, **settings):
        config = self.scratch / "server.json"
        config.write_text(json.dumps(settings))
        daemon = Daemon(self.scratch / "data", "--config", str(config), *map(str, options), files=files)
        self.addCleanup(daemon.stop)
        return daemon

    def wire(self, daemon, connected=None):
        wire = Wire(daemon.address, connected)
        self.addCleanup(wire.close)
        return wire

    def greeted(self, daemon, **params):
        wire = self.wire(daemon)
        hello = {**HELLO, "params": {**HELLO["params"], **params}}
        self.assertIn("result", wire.ask(hello))
        return wire

    def served(self, wire):
        self.assertEqual(wire.ask(call(2, "ping"))["result"], {})

    def served_again(self, daemon):
        """A new client gets in, at the latest when the server has noticed that others left."""
        end = time.monotonic() + PATIENCE_S
        while True:
            wire = self.wire(daemon)
            wire.socket.sendall(line(HELLO))
            answer = wire.read()
            if answer and "result" in answer:
                return self.served(wire)
            self.assertLess(time.monotonic(), end, "nobody is let in any more")
            time.sleep(0.02)


class WithAJob(DoorTest):
    """One daemon with one finished job for all tests of the class."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        cls.addClassCleanup(folder.cleanup)
        scratch = pathlib.Path(folder.name)
        config = scratch / "server.json"
        config.write_text(json.dumps({"host_names": ["planner.example"], "origins": ["https://dash.example"]}))
        cls.server = Daemon(scratch / "data", "--config", str(config))
        cls.addClassCleanup(cls.server.stop)
        with sculpt.Client(cls.server.address) as client:
            mesh = client.upload_file(shapes.write_stl(scratch / "steps.stl", shapes.steps()))
            cls.job = client.submit({"mesh": mesh, "robot": "gantry", "resolution": 8})["job"]
            assert client.wait(cls.job)["state"] == "succeeded"
            cls.trajectory = b"".join(client.read_artifact(cls.job))
            cls.csv = b"".join(client.read_artifact(cls.job, format="csv"))

    def setUp(self):
        super().setUp()
        self.connection = http.client.HTTPConnection(self.server.address, timeout=PATIENCE_S)
        self.addCleanup(self.connection.close)
        self.path = f"/v1/artifacts/{self.job}/trajectory"

    def get(self, path, method="GET", body=None, **headers):
        self.connection.request(method, path, body=body, headers={name.replace("_", "-"): value for name, value in headers.items()})
        response = self.connection.getresponse()
        return response, response.read()
