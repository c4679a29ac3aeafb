"""Who gets in and what is spoken at the one port: limits, HTTP, WebSocket, TLS, tokens, the unix socket."""

import hashlib
import http.client
import json
import os
import pathlib
import re
import shutil
import socket
import ssl
import subprocess
import tempfile
import time
import unittest

import shapes
import web_socket
from harness import PATIENCE_S, SCULPT, SCULPT_PY, ClientTest, Daemon, environment

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


class Limits(DoorTest):
    def test_who_says_no_hello_in_time_is_sent_away_and_who_did_may_be_silent(self):
        daemon = self.daemon(hello_s=1)
        patient = self.greeted(daemon)
        silent, half = self.wire(daemon), self.wire(daemon)
        half.socket.sendall(b'{"id":1,')
        self.assertEqual(half.word(), "hello_required")
        self.assertIsNone(half.read())
        self.assertIsNone(silent.read())
        self.served(patient)

    def test_slow_clients_by_the_hundred_harm_nobody(self):
        daemon = self.daemon(hello_s=2)
        slow = [self.wire(daemon) for _ in range(300)]
        for wire in slow:
            wire.socket.sendall(b"{")
        honest = self.greeted(daemon)
        for _ in range(20):
            self.served(honest)
        for wire in slow:
            self.assertEqual(wire.word(), "hello_required")
        self.served(honest)

    def test_more_connections_than_allowed_are_told_so(self):
        daemon = self.daemon(max_connections=3)
        inside = [self.greeted(daemon) for _ in range(3)]
        for _ in range(5):
            self.assertEqual(self.wire(daemon).word(), "too_many_connections")
        for wire in inside:
            self.served(wire)
            wire.close()
        self.served_again(daemon)

    def test_one_owner_cannot_take_all_connections(self):
        daemon = self.daemon(max_connections_per_owner=2)
        inside = [self.greeted(daemon) for _ in range(2)]
        third = self.wire(daemon)
        self.assertEqual(third.ask(HELLO)["error"]["data"]["code"], "too_many_connections")
        self.assertIsNone(third.read())
        self.assertIn("result", inside[0].ask(HELLO), "a second hello is no second connection")
        inside[0].close()
        self.served_again(daemon)

    def test_without_file_descriptors_those_inside_are_served_and_it_recovers(self):
        daemon = self.daemon(files=64, log="info")
        inside = self.greeted(daemon)
        crowd = [self.wire(daemon) for _ in range(500)]
        turned_away = [wire for wire in crowd[100:] if wire.word() == "too_many_connections"]
        self.assertEqual(len(turned_away), 400)
        content = b"v 0 0 0\n"
        digest = hashlib.sha256(content).hexdigest()
        inside.socket.sendall(line(call(3, "blob.put", sha256=digest, size=len(content), offset=0, bytes=len(content))) + content + b"\n")
        self.assertTrue(inside.read()["result"]["complete"], "there are files left for the work")
        for wire in crowd:
            wire.close()
        self.served_again(daemon)

    def test_strangers_get_little_memory(self):
        daemon = self.daemon()
        bulk, chatter = self.wire(daemon), self.wire(daemon)
        bulk.socket.sendall(line(call(1, "blob.put", sha256="0" * 64, size=1 << 22, offset=0, bytes=1 << 22)))
        self.assertEqual(bulk.word(), "hello_required")
        chatter.socket.sendall(b'{"id":"' + b"x" * 20000)
        self.assertEqual(chatter.word(), "line_too_long")


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


class Http(WithAJob):
    def refused(self, status, word, *request, **headers):
        response, body = self.get(*request, **headers)
        self.assertEqual(response.status, status, body)
        self.assertEqual(json.loads(body)["data"]["code"], word)

    def test_health_and_metrics(self):
        for path, said in (("/livez", b"alive\n"), ("/readyz", b"ready\n")):
            response, body = self.get(path)
            self.assertEqual((response.status, body), (200, said))
        response, body = self.get("/metrics")
        self.assertEqual(response.status, 200)
        self.assertIn(b'\nsculptd_jobs{state="succeeded"} 1\n', body)

    def test_not_ready_says_why(self):
        daemon = self.daemon(disk_floor_bytes=2**62)
        other = http.client.HTTPConnection(daemon.address, timeout=PATIENCE_S)
        self.addCleanup(other.close)
        other.request("GET", "/readyz")
        response = other.getresponse()
        self.assertEqual(response.status, 503)
        self.assertIn(b"disk_floor_bytes", response.read())

    def test_an_artifact_is_the_same_as_over_the_protocol(self):
        response, body = self.get(self.path)
        self.assertEqual((response.status, body), (200, self.trajectory))
        self.assertEqual(response.getheader("ETag"), f'"{hashlib.sha256(self.trajectory).hexdigest()}"')
        self.assertEqual(self.get(self.path + "?format=csv")[1], self.csv)
        self.assertEqual(self.get(f"/v1/artifacts/{self.job}/voxels")[1][:9], b"#binvox 1")

    def test_head_gives_the_size_alone(self):
        response, body = self.get(self.path, "HEAD")
        self.assertEqual((response.status, body), (200, b""))
        self.assertEqual(int(response.getheader("Content-Length")), len(self.trajectory))
        self.assertEqual(self.get("/livez")[1], b"alive\n", "the connection lives on")

    def test_ranges(self):
        size = len(self.trajectory)
        for asked, part in (("bytes=0-9", slice(0, 10)), (f"bytes={size - 5}-", slice(size - 5, size)), ("bytes=-7", slice(size - 7, size)),
                            (f"bytes=3-{size * 2}", slice(3, size))):
            response, body = self.get(self.path, Range=asked)
            self.assertEqual((response.status, body), (206, self.trajectory[part]), asked)
            self.assertEqual(response.getheader("Content-Range"), f"bytes {part.start}-{part.stop - 1}/{size}")
        response, body = self.get(self.path, Range=f"bytes={size}-")
        self.assertEqual((response.status, body), (416, b""))
        self.assertEqual(response.getheader("Content-Range"), f"bytes */{size}")

    def test_a_broken_download_goes_on_only_if_it_is_the_same(self):
        tag = self.get(self.path, "HEAD")[0].getheader("ETag")
        self.assertEqual(self.get(self.path, Range="bytes=5-", If_Range=tag)[1], self.trajectory[5:])
        self.assertEqual(self.get(self.path, Range="bytes=5-", If_Range='"other"')[1], self.trajectory)
        response, body = self.get(self.path, If_None_Match=f'"x", {tag}')
        self.assertEqual((response.status, body), (304, b""))
        self.assertEqual(self.get(self.path + "?format=csv", If_None_Match=tag)[0].status, 200, "another form is another thing")

    def test_what_is_not_there(self):
        self.refused(404, "not_found", "/")
        self.refused(404, "not_found", "/v1/artifacts/nosuchjob/trajectory")
        self.refused(404, "not_found", "/v1/artifacts/nosuchjob")
        self.refused(400, "params_invalid", f"/v1/artifacts/{self.job}/statue")
        self.refused(400, "params_invalid", self.path + "?format=exe")
        self.refused(400, "params_invalid", self.path + "?size=1")
        self.refused(404, "not_found", "/v1/artifacts/../sculptd.db")

    def test_a_post_executes_nothing(self):
        for path in ("/", "/v1/ws", "/v1/artifacts/x/y", "/job.submit"):
            with self.subTest(path=path):
                cancel = line(HELLO) + line(call(2, "job.cancel", job=self.job))
                self.refused(405, "method_refused", path, "POST", cancel)
                self.connection.close()
        with sculpt.Client(self.server.address) as client:
            self.assertEqual([job["state"] for job in client.call("job.list")["jobs"]], ["succeeded"])

    def test_a_name_that_is_not_ours_is_refused(self):
        self.refused(421, "host_refused", "/livez", Host="evil.example")
        self.refused(421, "host_refused", self.path, Host=f"evil.example:{split(self.server.address)[1]}")
        for host in ("localhost", "127.0.0.1:1", "planner.example"):
            self.assertEqual(self.get("/livez", Host=host)[0].status, 200, host)

    def test_a_page_of_another_origin_is_refused(self):
        self.refused(403, "origin_refused", self.path, Origin="http://evil.example")
        self.refused(403, "origin_refused", self.path, Origin="http://localhost:3000")
        self.assertEqual(self.get(self.path, Origin=f"http://{self.server.address}")[0].status, 200)
        self.assertEqual(self.get(self.path, Origin="https://dash.example")[0].status, 200)

    def test_what_is_no_http_gets_400_and_the_end(self):
        for garbage in (b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"HELLO WORLD\n\n", b"GET / HTTP/1.1\r\nX: " + b"x" * 20000 + b"\r\n\r\n"):
            wire = self.wire(self.server)
            wire.socket.sendall(garbage)
            self.assertRegex(wire.stream.read(), rb"^HTTP/1.1 400 ", garbage[:20])

    def test_curl_speaks_to_it(self):
        curl = shutil.which("curl")
        if curl is None:
            self.skipTest("no curl here")
        target = self.scratch / "out.ndjson"
        target.write_bytes(self.trajectory[:100])
        subprocess.run([curl, "--fail", "--silent", "--continue-at", "-", "--output", target, f"http://{self.server.address}{self.path}"],
                       check=True, timeout=PATIENCE_S)
        self.assertEqual(target.read_bytes(), self.trajectory)


class WebSockets(WithAJob):
    def open(self, **options):
        connected = socket.create_connection(split(self.server.address), timeout=PATIENCE_S)
        self.addCleanup(connected.close)
        opened = web_socket.WebSocket(connected, options.pop("host", self.server.address), **options)
        self.addCleanup(opened.close)
        return opened

    def ask(self, opened, message):
        opened.send(json.dumps(message).encode())
        kind, answer = opened.receive()
        self.assertEqual(kind, web_socket.TEXT)
        self.assertFalse(answer.endswith(b"\n"), "one message is one line, without its end")
        return json.loads(answer)

    def test_a_message_is_a_line_and_a_chunk_the_next_binary_message(self):
        opened = self.open()
        self.assertEqual(self.ask(opened, HELLO)["result"]["protocol"], [1, 0])
        answer = self.ask(opened, call(2, "artifact.read", job=self.job, artifact="trajectory", offset=0, bytes=1 << 20))
        self.assertEqual(answer["result"]["bytes"], len(self.trajectory))
        self.assertEqual(opened.receive(), (web_socket.BINARY, self.trajectory))
        self.assertEqual(self.ask(opened, call(3, "ping"))["result"], {})

    def test_an_upload_and_events(self):
        opened = self.open(origin="https://dash.example")
        self.ask(opened, HELLO)
        content = os.urandom(200_000)
        digest = hashlib.sha256(content).hexdigest()
        opened.send(json.dumps(call(2, "blob.put", sha256=digest, size=len(content), offset=0, bytes=len(content))).encode(), pieces=3)
        opened.send(content, web_socket.BINARY, pieces=7)
        self.assertTrue(json.loads(opened.receive()[1])["result"]["complete"])
        self.ask(opened, call(3, "events.subscribe", job=self.job))
        events = [json.loads(opened.receive()[1])["params"] for _ in range(4)]
        self.assertEqual([event.get("seq") for event in events], [1, 2, 3, None])
        self.assertEqual(events[3]["type"], "live")

    def test_pings_are_answered_and_a_close_is_too(self):
        opened = self.open()
        opened.send(b"still there?", web_socket.PING)
        self.assertEqual(opened.receive(), (web_socket.PONG, b"still there?"))
        opened.send((1000).to_bytes(2, "big"), web_socket.CLOSE)
        self.assertEqual(opened.receive()[0], web_socket.CLOSE)

    def test_what_no_client_should_send_ends_it_with_a_word(self):
        opened = self.open()
        answer = self.ask(opened, call(1, "ping"))
        self.assertEqual(answer["error"]["data"]["code"], "hello_required")
        opened.send(b"\x01\x02", web_socket.BINARY)
        self.assertEqual(json.loads(opened.receive()[1])["error"]["data"]["code"], "not_text")
        self.assertEqual(opened.receive()[0], web_socket.CLOSE)

    def test_foreign_pages_and_names_are_refused(self):
        for refused, options in ((403, {"origin": "http://evil.example"}), (421, {"host": "evil.example"}), (404, {"path": "/v1/wss"})):
            with self.assertRaises(web_socket.Refused) as caught:
                self.open(**options)
            self.assertEqual(caught.exception.status, refused)


class Tokens(DoorTest):
    def make(self, name, *options):
        return subprocess.run([os.environ["SCULPTD"], "token", "add", name, "--tokens", str(self.scratch / "tokens.json"), *options],
                              check=True, capture_output=True, text=True, timeout=PATIENCE_S).stdout.strip()

    def setUp(self):
        super().setUp()
        self.tokens = {scope: self.make(f"the-{scope}", "--scope", scope) for scope in ("read", "submit", "admin")}

    def word(self, wire, message):
        answer = wire.ask(message)
        return answer["error"]["data"]["code"] if "error" in answer else "accepted"

    def test_only_a_good_token_opens(self):
        daemon = self.daemon(tokens="tokens.json")
        good = self.tokens["read"]
        for params in ({}, {"token": "x"}, {"token": good[:-1]}, {"token": good + "0"}, {"token": good.upper()}):
            wire = self.wire(daemon)
            self.assertEqual(self.word(wire, {**HELLO, "params": {**HELLO["params"], **params}}), "auth_required")
            self.assertIsNone(wire.read(), "the connection is closed")
        self.served(self.greeted(daemon, token=good))

    def test_a_token_that_has_ended_opens_nothing(self):
        secret = self.make("visitor", "--scope", "admin", "--days", "1")
        daemon = self.daemon(tokens="tokens.json")
        self.greeted(daemon, token=secret)
        daemon.stop()
        path = self.scratch / "tokens.json"
        text, ended = re.subn(r'"expires": ?"[^"]*"', '"expires":"2020-01-31T12:00:00.000Z"', path.read_text())
        self.assertEqual(ended, 1)
        path.write_text(text)
        daemon = self.daemon(tokens="tokens.json")
        self.assertEqual(self.word(self.wire(daemon), {**HELLO, "params": {**HELLO["params"], "token": secret}}), "auth_required")
        connection = http.client.HTTPConnection(daemon.address, timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        connection.request("GET", "/metrics", headers={"Authorization": f"Bearer {secret}"})
        self.assertEqual(connection.getresponse().status, 401)

    def test_each_scope_opens_its_methods(self):
        daemon = self.daemon(tokens="tokens.json")
        look, work = call(2, "job.list"), call(3, "blob.has", sha256="0" * 64)
        for scope, expected in (("read", ["accepted", "forbidden"]), ("submit", ["accepted", "accepted"]), ("admin", ["accepted", "accepted"])):
            wire = self.greeted(daemon, token=self.tokens[scope])
            self.assertEqual([self.word(wire, message) for message in (look, work)], expected, scope)

    def test_who_has_too_many_jobs_is_refused_and_nobody_else(self):
        daemon = self.daemon(tokens="tokens.json", max_jobs_per_owner=1)
        first, second = (sculpt.Client(daemon.address, token=self.tokens[scope]) for scope in ("submit", "admin"))
        with first, second:
            second.call("queue.pause")
            mesh = first.upload_file(shapes.write_stl(self.scratch / "steps.stl", shapes.steps()))
            spec = {"mesh": mesh, "robot": "gantry", "resolution": 8}
            job = first.submit(spec)["job"]
            self.assertEqual(second.call("job.get", job=job)["owner"], "the-submit")
            with self.assertRaises(sculpt.Failure) as refused:
                first.submit(spec)
            self.assertEqual(refused.exception.code, "quota")
            second.submit(spec)

    def test_a_token_made_or_removed_while_it_runs(self):
        daemon = self.daemon(tokens="tokens.json")
        self.greeted(daemon, token=self.make("late", "--scope", "read"))
        subprocess.run([os.environ["SCULPTD"], "token", "remove", "late", "--tokens", str(self.scratch / "tokens.json")], check=True, timeout=PATIENCE_S)
        self.greeted(daemon, token=self.tokens["read"])

    def test_http_takes_it_as_bearer(self):
        daemon = self.daemon(tokens="tokens.json")
        connection = http.client.HTTPConnection(daemon.address, timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        for headers, status in (({}, 401), ({"Authorization": "Bearer x"}, 401), ({"Authorization": f"Basic {self.tokens['read']}"}, 401),
                                ({"Authorization": f"Bearer {self.tokens['read']}"}, 200)):
            connection.request("GET", "/metrics", headers=headers)
            response = connection.getresponse()
            response.read()
            self.assertEqual(response.status, status)
        connection.request("GET", "/livez")
        self.assertEqual(connection.getresponse().status, 200, "health needs no token")

    def test_no_token_is_ever_logged(self):
        daemon = self.daemon(tokens="tokens.json", log="trace")
        secret = self.tokens["submit"]
        self.greeted(daemon, token=secret)
        for broken in (b'{"id":1,"method":"hello","params":{"token":"%s"' % secret.encode(), b'{"id":1,"method":"hello","token":"%s"}' % secret.encode(),
                       b'{"id":1,"method":"hello","params":{"protocol":[1,0],"client":"x","token":"%s"}}' % secret.upper().encode()):
            wire = self.wire(daemon)
            wire.socket.sendall(broken + b"\n")
            wire.read()
        connection = http.client.HTTPConnection(daemon.address, timeout=PATIENCE_S)
        connection.request("GET", "/nothing", headers={"Authorization": f"Bearer {secret}"})
        connection.getresponse().read()
        connection.close()
        daemon.stop()
        self.assertIn("owner=the-submit", daemon.log())
        self.assertNotIn(secret[10:30].lower(), daemon.log().lower())
        self.assertNotIn(secret[10:30], (self.scratch / "tokens.json").read_text())

    def test_both_clients_take_it_from_the_environment(self):
        daemon = self.daemon(tokens="tokens.json")
        (self.scratch / "token").write_text(self.tokens["read"] + "\n")
        for client in (SCULPT, SCULPT_PY):
            for given, code in (({}, 4), ({"SCULPT_TOKEN": self.tokens["read"]}, 0), ({"SCULPT_TOKEN_FILE": str(self.scratch / "token")}, 0)):
                done = subprocess.run([*client, "list"], env={**environment(daemon.address), **given}, capture_output=True, text=True, timeout=PATIENCE_S)
                self.assertEqual(done.returncode, code, done.stderr)

    def test_an_open_door_to_the_network_is_refused(self):
        for settings, opened in (({}, False), ({"tokens": "tokens.json"}, True)):
            config = self.scratch / "server.json"
            config.write_text(json.dumps(settings))
            if opened:
                with Daemon(self.scratch / "data", "--config", str(config), listen="0.0.0.0:0") as daemon:
                    self.greeted(daemon, token=self.tokens["read"])
            else:
                done = subprocess.run([os.environ["SCULPTD"], "--config", config, "--data", self.scratch / "data", "--listen", "0.0.0.0:0"], capture_output=True, text=True, timeout=PATIENCE_S)
                self.assertEqual(done.returncode, 78, done.stderr)
                self.assertIn("sculptd token add", done.stderr)

    def test_a_broken_file_stops_the_start(self):
        (self.scratch / "tokens.json").write_text("{")
        done = subprocess.run([os.environ["SCULPTD"], "--tokens", self.scratch / "tokens.json", "--data", self.scratch / "data", "--listen", "127.0.0.1:0"],
                              capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 78, done.stderr)


class UnixSocket(DoorTest):
    def test_the_same_user_is_admin_without_a_token(self):
        (self.scratch / "tokens.json").write_text('{"tokens":[]}')
        path = self.scratch / "door"
        daemon = self.daemon(unix="door", tokens="tokens.json")
        for client in (SCULPT, SCULPT_PY):
            done = subprocess.run([*client, "list", "--server", f"unix:{path}"], env=environment(), capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"owner=uid:{os.getuid()}", daemon.log())
        connected = socket.socket(socket.AF_UNIX)
        connected.connect(str(path))
        wire = self.wire(daemon, connected)
        wire.socket.sendall(b"GET /metrics HTTP/1.1\r\nHost: anything\r\nConnection: close\r\n\r\n")
        self.assertRegex(wire.stream.read(), rb"^HTTP/1.1 200 ")

    @unittest.skipUnless(os.geteuid() == 0, "needs root, to become another user")
    def test_another_user_needs_a_token(self):
        self.scratch.chmod(0o755)
        self.daemon(unix="door")
        script = ("import os, socket, sys; os.setuid(65534); s = socket.socket(socket.AF_UNIX); s.connect(sys.argv[1]); "
                  "s.sendall(sys.argv[2].encode() + b'\\n'); print(s.makefile().readline())")
        done = subprocess.run([shutil.which("python3"), "-c", script, self.scratch / "door", json.dumps(HELLO)], check=True, capture_output=True,
                              text=True, timeout=PATIENCE_S)
        self.assertEqual(json.loads(done.stdout)["error"]["data"]["code"], "auth_required")

    def test_the_path_of_a_dead_daemon_is_taken_over_and_that_of_a_living_one_is_not(self):
        daemon = self.daemon(unix="door")
        second = subprocess.run([os.environ["SCULPTD"], "--unix", self.scratch / "door", "--data", self.scratch / "other", "--listen", "127.0.0.1:0"],
                                capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(second.returncode, 69, second.stderr)
        daemon.kill()
        self.assertTrue((self.scratch / "door").exists())
        again = self.daemon(unix="door")
        with sculpt.Client(f"unix:{self.scratch / 'door'}") as client:
            self.assertEqual(client.call("ping"), {})
        again.stop()
        self.assertFalse((self.scratch / "door").exists())


@unittest.skipUnless(shutil.which("openssl"), "needs openssl, to make certificates")
class Tls(DoorTest):
    def openssl(self, *arguments):
        subprocess.run(["openssl", *arguments], cwd=self.scratch, check=True, capture_output=True, timeout=PATIENCE_S)

    def certificate(self, name, *extensions):
        """NAME.pem and NAME.key, signed by ca.pem."""
        self.openssl("req", "-newkey", "rsa:2048", "-nodes", "-keyout", f"{name}.key", "-out", f"{name}.csr", "-subj", f"/CN={name}")
        (self.scratch / "extensions").write_text("".join(extensions))
        self.openssl("x509", "-req", "-in", f"{name}.csr", "-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial", "-days", "2", "-out", f"{name}.pem",
                     "-extfile", "extensions")

    def setUp(self):
        super().setUp()
        self.openssl("req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", "ca.key", "-out", "ca.pem", "-subj", "/CN=test authority", "-days", "2")
        self.certificate("server", "subjectAltName=IP:127.0.0.1,DNS:localhost\n")
        self.files = {"tls_certificate": "server.pem", "tls_key": "server.key"}

    def context(self, client=None):
        context = ssl.create_default_context(cafile=str(self.scratch / "ca.pem"))
        if client:
            context.load_cert_chain(self.scratch / f"{client}.pem", self.scratch / f"{client}.key")
        return context

    def secure(self, daemon, context):
        plain = socket.create_connection(split(daemon.address), timeout=PATIENCE_S)
        self.addCleanup(plain.close)
        secure = context.wrap_socket(plain, server_hostname="127.0.0.1")
        self.addCleanup(secure.close)
        return secure

    def test_one_port_speaks_it_and_the_plain_forms(self):
        daemon = self.daemon(**self.files)
        self.served(self.greeted(daemon))
        wire = self.wire(daemon, self.secure(daemon, self.context()))
        self.assertIn("result", wire.ask(HELLO))
        content = os.urandom(3 << 20)
        digest = hashlib.sha256(content).hexdigest()
        wire.socket.sendall(line(call(3, "blob.put", sha256=digest, size=len(content), offset=0, bytes=len(content))) + content + b"\n")
        self.assertTrue(wire.read()["result"]["complete"])
        connection = http.client.HTTPSConnection(daemon.address, context=self.context(), timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        for _ in range(2):
            connection.request("GET", "/livez")
            self.assertEqual(connection.getresponse().read(), b"alive\n")
        opened = web_socket.WebSocket(self.secure(daemon, self.context()), daemon.address)
        self.addCleanup(opened.close)
        opened.send(line(HELLO).rstrip())
        self.assertIn("result", json.loads(opened.receive()[1]))

    def test_from_another_machine_nothing_else_is_spoken(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.connect(("192.0.2.1", 9))  # sends nothing; asks for the way
            except OSError:
                self.skipTest("this machine has no address but loopback")
            here = probe.getsockname()[0]
        self.certificate("cell-7", "extendedKeyUsage=clientAuth\n")
        (self.scratch / "server.json").write_text(json.dumps({"tls_client_ca": "ca.pem", **self.files}))
        with Daemon(self.scratch / "data", "--config", str(self.scratch / "server.json"), listen="0.0.0.0:0") as daemon:
            address = f"{here}:{split(daemon.address)[1]}"
            for first in (line(HELLO), b"GET /livez HTTP/1.1\r\nHost: x\r\n\r\n"):
                wire = Wire(address)
                self.addCleanup(wire.close)
                wire.socket.sendall(first)
                self.assertEqual(wire.word(), "tls_required")
            context = self.context("cell-7")
            context.check_hostname = False
            plain = socket.create_connection(split(address), timeout=PATIENCE_S)
            wire = Wire(address, context.wrap_socket(plain))
            self.addCleanup(wire.close)
            self.assertIn("result", wire.ask(HELLO))

    def test_it_ends_as_it_should(self):
        daemon = self.daemon(**self.files)
        secure = self.secure(daemon, self.context())
        secure.suppress_ragged_eofs = False
        wire = self.wire(daemon, secure)
        wire.ask({**HELLO, "params": {"protocol": [2, 0], "client": "x"}})
        self.assertIsNone(wire.read(), "an end that nobody could have cut off")

    def test_old_versions_and_broken_handshakes_harm_nobody(self):
        daemon = self.daemon(hello_s=2, **self.files)
        old = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        old.check_hostname, old.verify_mode = False, ssl.CERT_NONE
        old.set_ciphers("ALL:@SECLEVEL=0")
        old.minimum_version = ssl.TLSVersion.TLSv1
        old.maximum_version = ssl.TLSVersion.TLSv1_1
        with self.assertRaises(ssl.SSLError):
            self.secure(daemon, old)
        for garbage in (b"\x16", b"\x16\x03\x01\x00\x05hello", b"\x16" + os.urandom(4000)):
            wire = self.wire(daemon)
            wire.socket.sendall(garbage)
            while wire.socket.recv(4096):
                pass
        self.served(self.greeted(daemon))

    def test_a_certificate_is_a_name(self):
        self.certificate("cell-7", "extendedKeyUsage=clientAuth\n")
        daemon = self.daemon(tls_client_ca="ca.pem", **self.files)
        wire = self.wire(daemon, self.secure(daemon, self.context("cell-7")))
        self.assertIn("result", wire.ask(HELLO))
        self.assertIn("owner=cell-7", daemon.log())
        plain = self.wire(daemon)
        self.assertEqual(plain.ask(HELLO)["error"]["data"]["code"], "auth_required")
        with self.assertRaises((ssl.SSLError, ConnectionError)):
            nameless = self.secure(daemon, self.context())
            nameless.sendall(line(HELLO))
            nameless.recv(1)

    def test_both_clients_speak_it(self):
        self.certificate("cell-7", "extendedKeyUsage=clientAuth\n")
        daemon = self.daemon(tls_client_ca="ca.pem", **self.files)
        trusted = {"SCULPT_TLS_CA": str(self.scratch / "ca.pem")}
        named = {"SCULPT_TLS_CERT": str(self.scratch / "cell-7.pem"), "SCULPT_TLS_KEY": str(self.scratch / "cell-7.key")}
        for client in (SCULPT, SCULPT_PY):
            for given, code in (({**trusted, **named}, 0), (trusted, 3), (named, 3)):
                done = subprocess.run([*client, "list", "--server", f"tls:{daemon.address}"], env={**environment(), **given}, capture_output=True,
                                      text=True, timeout=PATIENCE_S)
                self.assertEqual(done.returncode, code, f"{client} {given}\n{done.stderr}")
            mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())
            done = subprocess.run([*client, "submit", mesh, "--resolution", "8", "--robot", "gantry", "--wait", "--server", f"tls:{daemon.address}"],
                                  env={**environment(), **trusted, **named}, capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_files_that_cannot_be_used_stop_the_start(self):
        for settings in ({"tls_certificate": "server.pem"}, {"tls_certificate": "server.pem", "tls_key": "ca.key"},
                         {"tls_certificate": "none.pem", "tls_key": "server.key"}):
            (self.scratch / "server.json").write_text(json.dumps(settings))
            done = subprocess.run([os.environ["SCULPTD"], "--config", self.scratch / "server.json", "--data", self.scratch / "data", "--listen",
                                   "127.0.0.1:0"], capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 78, done.stderr)
            self.assertIn("tls_", done.stderr)


if __name__ == "__main__":
    unittest.main()
