"""Tokens: who is let in with which, and what each scope opens."""

import http.client
import json
import os
import re
import subprocess
import unittest

import shapes
from door import HELLO, DoorTest, call, line
from harness import PATIENCE_S, SOURCE, SCULPT, SCULPT_PY, Daemon, environment

import sculpt


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

    def test_each_scope_opens_the_methods_that_the_protocol_says(self):
        daemon = self.daemon(tokens="tokens.json")
        scopes, table = ("read", "submit", "admin"), (SOURCE / "proto/PROTOCOL.md").read_text().partition("## 8.")[2]
        said = {scope: re.findall(r"`([a-z.]+)`", re.search(rf"^\| `{scope}` \|(.*)\|$", table, re.M).group(1)) for scope in scopes}
        methods = json.loads((SOURCE / "proto/schema.json").read_text())["$defs"]["method"]["enum"]
        self.assertEqual(sorted(sum(said.values(), [])), sorted(methods), "each method has one scope")
        for needed, allowed in said.items():
            for method, scope in ((method, scope) for method in allowed for scope in scopes if method != "hello"):
                chunk = {"bytes": 0} if method == "blob.put" else {}
                wire = self.greeted(daemon, token=self.tokens[scope])
                wire.socket.sendall(line(call(2, method, **chunk)) + (b"\n" if chunk else b""))
                reply = wire.read()
                word = reply["error"]["data"]["code"] if "error" in reply else "accepted"
                self.assertEqual(word == "forbidden", scopes.index(scope) < scopes.index(needed), f"{method} with {scope}: {word}")

    def test_hello_says_who_one_is_and_what_one_may_do(self):
        daemon = self.daemon(tokens="tokens.json")
        for scope, token in self.tokens.items():
            answer = self.wire(daemon).ask({**HELLO, "params": {**HELLO["params"], "token": token}})["result"]
            self.assertEqual((answer["owner"], answer["scope"]), (f"the-{scope}", scope))

    def test_who_only_looks_sends_short_lines(self):
        daemon = self.daemon(tokens="tokens.json")
        for scope, longest, word in (("read", 16384, "line_too_long"), ("submit", 1048576, "params_invalid")):
            wire = self.wire(daemon)
            self.assertEqual(wire.ask({**HELLO, "params": {**HELLO["params"], "token": self.tokens[scope]}})["result"]["limits"]["line"], longest)
            self.assertEqual(self.word(wire, call(2, "ping", x="y" * 20000)), word)

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


if __name__ == "__main__":
    unittest.main()
