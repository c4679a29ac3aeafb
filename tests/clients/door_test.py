"""Who gets in at the one port: limits, the unix socket, TLS and certificates."""

import hashlib
import http.client
import json
import os
import shutil
import socket
import ssl
import subprocess
import unittest

import shapes
import web_socket
from door import HELLO, DoorTest, Wire, call, line, split
from harness import PATIENCE_S, SCULPT, SCULPT_PY, Daemon, environment

import sculpt


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

    def health(self, daemon, path):
        asking = http.client.HTTPConnection(daemon.address, timeout=PATIENCE_S)
        self.addCleanup(asking.close)
        asking.request("GET", path)
        response = asking.getresponse()
        return response.status, response.read()

    def test_a_full_server_tells_its_health_and_nothing_else(self):
        daemon = self.daemon(max_connections=3)
        inside = [self.greeted(daemon) for _ in range(3)]
        silent = [self.wire(daemon) for _ in range(50)]  # more than there are places for
        for _ in range(5):
            self.assertEqual(self.health(daemon, "/livez"), (200, b"alive\n"))
            self.assertEqual(self.health(daemon, "/readyz"), (200, b"ready\n"))
        status, body = self.health(daemon, "/metrics")
        self.assertEqual((status, json.loads(body)["data"]["code"]), (503, "too_many_connections"))
        self.assertEqual(self.wire(daemon).ask(HELLO)["error"]["data"]["code"], "too_many_connections")
        for wire in silent:
            self.assertEqual(wire.word(), "too_many_connections")
        for wire in inside:
            self.served(wire)

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
