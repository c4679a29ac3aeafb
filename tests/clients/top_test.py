"""sculpt top: once, as JSON, and live on a terminal that the test holds the other end of."""

import fcntl
import json
import os
import pty
import struct
import subprocess
import termios
import time
import unittest

import shapes
from harness import PATIENCE_S, SCULPT, ClientTest, Daemon, environment


class Terminal:
    """`sculpt top` on a pseudo-terminal of 12 rows and 60 columns."""

    def __init__(self, server):
        self.ours, self.theirs = pty.openpty()
        self.resize(12, 60)
        self.before = termios.tcgetattr(self.theirs)
        self.seen = ""
        self.process = subprocess.Popen([*SCULPT, "top"], env=environment(server), stdin=self.theirs, stdout=self.theirs, stderr=subprocess.PIPE)

    def resize(self, rows, columns):
        fcntl.ioctl(self.ours, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def await_text(self, words):
        """The rest of what was shown since the words."""
        end = time.monotonic() + PATIENCE_S
        while words not in self.seen:
            if time.monotonic() > end:
                raise AssertionError(f"never shown: {words!r} in {self.seen!r}")
            self.seen += os.read(self.ours, 65536).decode()
        self.seen = self.seen.partition(words)[2]

    def press(self, key):
        os.write(self.ours, key)

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.process.kill()
        self.process.communicate()
        os.close(self.ours)
        os.close(self.theirs)


class Top(ClientTest):
    """One worker, a long job that runs and short ones that wait for it."""

    def setUp(self):
        super().setUp()
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        self.daemon = Daemon(self.scratch / "data", "--workers", "1")
        self.addCleanup(self.daemon.stop)
        self.server = self.daemon.address
        self.ended = self.fine("submit", mesh, "--resolution", 8, "--robot", "gantry", "--wait").strip()
        long = ("--robot", "panda-turntable", "--resolution", 64, "--search", "octree")
        self.running = self.fine("submit", mesh, *long).strip()
        self.waiting = [self.fine("submit", mesh, *long).strip() for _ in range(12)]

    def test_a_snapshot_shows_what_has_not_ended(self):
        for options in (["top"], ["top", "--once"]):
            shown = self.fine(*options)
            self.assertIn("1 workers", shown)
            self.assertIn("12 queued", shown)
            self.assertNotIn(self.ended, shown)
            self.assertEqual([line.split()[0] for line in shown.splitlines()[4:]], [self.running, *self.waiting])
        queue = json.loads(self.fine("top", "--json"))
        self.assertEqual(queue["server"]["workers"], 1)
        self.assertEqual([job["job"] for job in queue["jobs"]], [self.running, *self.waiting])

    def test_on_a_terminal_it_follows_jobs_sizes_and_keys(self):
        for key in (b"q", b"\x03"):
            with Terminal(self.server) as terminal:
                terminal.await_text(self.running)
                terminal.await_text("... and 7 more")
                terminal.resize(9, 60)
                terminal.await_text("... and 10 more")
                terminal.press(b"x")  # no key of ours
                terminal.press(key)
                self.assertEqual(terminal.process.wait(PATIENCE_S), 0)
                terminal.await_text("\x1b[?1049l")
                self.assertEqual(termios.tcgetattr(terminal.theirs), terminal.before)

    def test_it_finds_a_daemon_that_is_started_again(self):
        with Terminal(self.server) as terminal:
            terminal.await_text("12 queued")
            port = self.server.rpartition(":")[2]
            self.daemon.stop()
            terminal.await_text(port)
            self.daemon = Daemon(self.scratch / "data", "--workers", "1", "--listen", self.server)
            self.addCleanup(self.daemon.stop)
            terminal.await_text("12 queued")

    def test_without_a_daemon_it_says_so(self):
        self.daemon.stop()
        self.refused(3, "unreachable", "top")


if __name__ == "__main__":
    unittest.main()
