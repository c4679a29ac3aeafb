"""Clients that take all file descriptors, never end a line, never read, send too much; and honest ones beside them."""

import contextlib
import json
import os
import pathlib
import resource
import socket
import threading
import time
import unittest

import kit
from kit import sculpt

HELLO = b'{"id":1,"method":"hello","params":{"protocol":[1,0],"client":"torture"}}\n'
MIB = 1 << 20
MEMORY_FACTOR = 5 if os.environ.get("SCULPT_SANITIZE") else 1  # a sanitizer keeps a shadow of all memory


def memory_bytes(daemon):
    """Resident memory of the daemon."""
    pages = int(pathlib.Path(f"/proc/{daemon.process.pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def cpu_seconds(daemon):
    fields = pathlib.Path(f"/proc/{daemon.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def percentile(seconds, share):
    return sorted(seconds)[int(share * (len(seconds) - 1))]


class LimitsTest(unittest.TestCase):
    def setUp(self):
        folder = kit.scratch_folder()
        self.scratch = folder.__enter__()
        self.addCleanup(folder.__exit__, None, None, None)
        self.open = contextlib.ExitStack()
        self.addCleanup(self.open.close)

    def start(self, **settings):
        """A daemon with these settings."""
        config = self.scratch / "server.json"
        config.write_text(json.dumps(settings))
        self.daemon = kit.Daemon(self.scratch / "data", "--workers", "1", "--config", str(config))
        self.addCleanup(self.daemon.stop)
        host, port = self.daemon.address.rsplit(":", 1)
        self.endpoint = (host, int(port))

    def connect(self):
        return self.open.enter_context(socket.create_connection(self.endpoint, timeout=60))

    def ask(self, content):
        """All that comes back for these bytes until the server closes, or until a ping behind them is answered."""
        with socket.create_connection(self.endpoint, timeout=60) as connection, connection.makefile("rb") as stream:
            sender = threading.Thread(target=self.send, args=(connection, content + b'{"id":"last","method":"ping"}\n'))
            sender.start()
            replies = []
            with contextlib.suppress(ConnectionResetError):
                for line in stream:
                    replies.append(json.loads(line))
                    if replies[-1].get("id") == "last":
                        break
            with contextlib.suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)
            sender.join()
            return replies

    def connections(self):
        """How many sockets the daemon holds besides the one that it listens on."""
        names = []
        for link in pathlib.Path(f"/proc/{self.daemon.process.pid}/fd").iterdir():
            with contextlib.suppress(OSError):
                names.append(os.readlink(link))
        return sum(name.startswith("socket:") for name in names) - 1

    @staticmethod
    def send(connection, content):
        with contextlib.suppress(OSError):  # the server may close before it has read all
            connection.sendall(content)

    def pings(self, client, count=200):
        seconds = []
        for _ in range(count):
            started = time.monotonic()
            client.call("ping")
            seconds.append(time.monotonic() - started)
        return seconds


class TooManyConnections(LimitsTest):
    def test_no_descriptor_is_left_and_it_goes_on_when_there_are_some_again(self):
        limits = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (64, limits[1]))
        try:
            self.start()
        finally:
            resource.setrlimit(resource.RLIMIT_NOFILE, limits)
        with sculpt.Client(self.daemon.address) as early:
            for _ in range(300):
                crowd = socket.socket()
                crowd.setblocking(False)
                crowd.connect_ex(self.endpoint)
                self.open.enter_context(crowd)
            before, started = cpu_seconds(self.daemon), time.monotonic()
            seconds = self.pings(early)
            time.sleep(2)
            share = (cpu_seconds(self.daemon) - before) / (time.monotonic() - started)
            print(f"no descriptors left: {100 * share:.1f} % of a core, ping p99 {1000 * percentile(seconds, 0.99):.1f} ms")
            self.open.close()
            with sculpt.Client(self.daemon.address) as late:
                late.call("ping")
            early.call("ping")


class SlowWriters(LimitsTest):
    def test_500_connections_that_never_end_a_line(self):
        self.start()
        with sculpt.Client(self.daemon.address) as honest:
            before = memory_bytes(self.daemon)
            crowd = [self.connect() for _ in range(500)]
            for connection in crowd:
                connection.sendall(b"{")
            seconds = self.pings(honest)
            grown = memory_bytes(self.daemon) - before
        print(f"500 slow writers: {grown / MIB:.1f} MiB more, ping p99 {1000 * percentile(seconds, 0.99):.1f} ms")
        self.assertLess(grown, 50 * MIB)


class SlowReaders(LimitsTest):
    def test_clients_that_never_read_are_closed_and_cost_little(self):
        """Each asks for far more than sockets hold, without ever reading."""
        self.start(stall_s=2)
        mesh = kit.ball()
        with sculpt.Client(self.daemon.address) as honest:
            honest.upload(mesh)
            job = honest.submit(kit.spec(mesh))["job"]
            honest.wait(job)
            before = memory_bytes(self.daemon)
            question = b'{"id":2,"method":"artifact.read","params":{"job":"%s","artifact":"trajectory","offset":0,"bytes":4194304}}\n' % job.encode()
            crowd = [self.connect() for _ in range(20)]
            senders = [threading.Thread(target=self.send, args=(connection, HELLO + question * 20000)) for connection in crowd]
            for sender in senders:
                sender.start()
            seconds, most = self.pings(honest), 0
            while self.connections() > 1:
                most = max(most, memory_bytes(self.daemon) - before)
                honest.call("ping")
                time.sleep(0.02)
            self.open.close()
            for sender in senders:
                sender.join()
        print(f"20 clients that never read: at most {most / MIB:.1f} MiB more, ping p99 {1000 * percentile(seconds, 0.99):.1f} ms")
        self.assertLess(most, 96 * MIB * MEMORY_FACTOR)


class TooMuch(LimitsTest):
    LINE = MIB

    def setUp(self):
        super().setUp()
        self.start()

    def codes(self, content):
        return [reply["error"]["data"]["code"] if "error" in reply else "fine" for reply in self.ask(content)]

    def test_lines_that_are_too_long(self):
        before = memory_bytes(self.daemon)
        for unit, count in ((b"[", 20 * MIB), (b'{"a":', 20 * MIB), (b"x", 256 * MIB)):
            with self.subTest(unit=unit, bytes=count):
                first = b"{" if unit == b"x" else b""
                self.assertEqual(self.codes(HELLO + first + unit * (count // len(unit))), ["fine", "line_too_long"])
        self.assertLess(memory_bytes(self.daemon) - before, 16 * self.LINE)

    def test_deep_but_short_enough(self):
        for unit in (b"[", b'{"a":'):
            line = unit * ((self.LINE - 100) // len(unit)) + b"\n"
            self.assertEqual(self.codes(HELLO + line), ["fine", "parse_error", "fine"])

    def test_chunks_that_cannot_be(self):
        for size in (b"9223372036854775808", b"-1", b"4194305", b"1e3", b"null", b'"5"', b"99999999999999999999999999"):
            with self.subTest(bytes=size):
                put = b'{"id":2,"method":"blob.put","params":{"sha256":"%s","size":5,"offset":0,"bytes":%s}}\n' % (b"0" * 64, size)
                codes = self.codes(HELLO + put)
                self.assertEqual(codes[0], "fine")
                self.assertIn(codes[1], ("bad_request", "parse_error"))

    def test_what_is_no_line_of_json(self):
        for line, code in ((b'\xef\xbb\xbf{"id":2,"method":"ping"}', "parse_error"), (b'{"id":2,"method":"p\\u0000ing"}', "parse_error"),
                           (b'{"id":1e400,"method":"ping"}', "parse_error"), (b'{"id":NaN,"method":"ping"}', "parse_error"),
                           (b'{"id":2,"id":3,"method":"ping"}', "parse_error"), (b'[{"id":2,"method":"ping"}]', "bad_request"),
                           (b'{"id":18446744073709551616,"method":"ping"}', "bad_request"), (b'{"id":2.5,"method":"ping"}', "bad_request")):
            with self.subTest(line=line):
                self.assertEqual(self.codes(HELLO + line + b"\n"), ["fine", code, "fine"])
        for line in (b'{"id":2,"method":"\xff"}', b'{"id":2,\x01"method":"ping"}', b'\x00'):
            with self.subTest(line=line):
                self.assertEqual(self.codes(HELLO + line + b"\n"), ["fine", "not_text"])

    def test_line_ends(self):
        ping = b'{"id":2,"method":"ping"}'
        self.assertEqual(self.codes(HELLO.replace(b"\n", b"\r\n") + ping + b"\r\n"), ["fine", "fine", "fine"])
        self.assertEqual(self.codes(HELLO + ping + b"\r" + ping + b"\n"), ["fine", "parse_error", "fine"])

    def test_split_at_every_byte(self):
        content = HELLO + b'{"id":2,"method":"blob.put","params":{"sha256":"%s","size":9,"offset":0,"bytes":3}}\na\nb\n' % (b"1" * 64) \
            + b'{"id":3,"method":"ping"}\n'
        for cut in range(1, len(content), 3):
            with socket.create_connection(self.endpoint, timeout=60) as connection, connection.makefile("rb") as stream:
                connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                connection.sendall(content[:cut])
                connection.sendall(content[cut:])
                replies = [json.loads(stream.readline()) for _ in range(3)]
                self.assertEqual([("result" in reply, reply["id"]) for reply in replies], [(True, 1), (True, 2), (True, 3)], cut)

    def test_byte_by_byte(self):
        with socket.create_connection(self.endpoint, timeout=60) as connection, connection.makefile("rb") as stream:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            for byte in HELLO:
                connection.sendall(bytes([byte]))
            self.assertIn("result", json.loads(stream.readline()))


class SameKey(LimitsTest):
    def test_100_submits_at_once_make_one_job(self):
        self.start()
        mesh = kit.ball()
        with sculpt.Client(self.daemon.address) as client:
            client.upload(mesh)
            answers, go = [], threading.Barrier(100)

            def submit():
                with sculpt.Client(self.daemon.address) as own:
                    go.wait()
                    answers.append(own.submit(kit.spec(mesh), key="the same"))
            threads = [threading.Thread(target=submit) for _ in range(100)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(len({answer["job"] for answer in answers}), 1)
            self.assertEqual(sorted(answer["duplicate"] for answer in answers), [False] + [True] * 99)
            with self.assertRaises(sculpt.Failure) as refused:
                client.submit(kit.spec(mesh, seed=9), key="the same")
            self.assertEqual(refused.exception.code, "key_conflict")
            self.assertEqual(len(kit.all_jobs(client)), 1)


if __name__ == "__main__":
    unittest.main()
