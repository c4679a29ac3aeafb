"""What the tests of the real programs share: a daemon of one's own, and running a client to its end.

Environment: SCULPTD and SCULPT (the programs), SCULPT_SOURCE (the source tree).
"""

import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(os.environ["SCULPT_SOURCE"])
SCULPT = [os.environ["SCULPT"]]
SCULPT_PY = [sys.executable, str(SOURCE / "clients/python/sculpt.py")]
sys.path.insert(0, str(SOURCE / "clients/python"))

os.environ.setdefault("SCULPT_PATIENCE_S", "0")  # of a client that has lost its server: none

PATIENCE_S = 3000  # a hang becomes a failure; nothing is measured by it, and without optimization a check takes minutes


class Daemon:
    """sculptd on a free port; its log is DATA.log. The data folder may be handed on to the next one. `files`: how many it may open."""

    def __init__(self, data, *options, listen="127.0.0.1:0", files=None):
        self.data, self.log_path = data, pathlib.Path(f"{data}.log")
        with self.log_path.open("wb") as log:
            self.process = subprocess.Popen(
                [os.environ["SCULPTD"], "--listen", listen, "--data", str(data), *options],
                cwd=SOURCE, preexec_fn=(lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (files, files))) if files else None, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)
        self.address = self._read_address()

    def log(self):
        """What it has printed so far."""
        return self.log_path.read_text(errors="replace")

    def _read_address(self):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            ended = self._ended_within(0.02)
            found = re.search(r"listening on (\S+:\d+)\n", self.log())
            if found:
                return found.group(1)
            if ended:
                break
        raise AssertionError("sculptd did not say where it listens:\n" + self.log())

    def _ended_within(self, seconds):
        try:
            self.process.wait(seconds)
            return True
        except subprocess.TimeoutExpired:
            return False

    def kill(self):
        """As a power cut would: no chance to tidy up."""
        self.process.kill()
        self.process.wait(PATIENCE_S)

    def stop(self):
        """As an operator would. Gives the exit code."""
        self.process.terminate()  # nothing happens if it has ended already
        return self.process.wait(PATIENCE_S)

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.stop()


def shared_data(test, path):
    """A file or folder of the shared data; skips `test` where there is none."""
    found = pathlib.Path(os.environ.get("SCULPT_SHARED_DATA") or SOURCE.parent / "shared" / "data") / path
    if not found.exists():
        test.skipTest(f"no {found}: set SCULPT_SHARED_DATA to the folder that has {path}")
    return found


def environment(server=None):
    """The caller's, with only this server and the cells of the source tree."""
    env = {name: value for name, value in os.environ.items() if not name.startswith(("SCULPT_SERVER", "SCULPT_T"))}
    env["SCULPT_CELLS"] = str(SOURCE / "config/cells")
    env["SCULPT_CACHE"] = ""  # nothing of another run, nothing in the home of who runs the tests
    return {**env, "SCULPT_SERVER": server} if server else env


class ClientTest(unittest.TestCase):
    """Runs a client; each test has a scratch folder."""

    client = SCULPT
    server = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        self.addCleanup(folder.cleanup)
        self.scratch = pathlib.Path(folder.name)

    def run_client(self, *arguments, server=None):
        return subprocess.run([*self.client, *map(str, arguments)], env=environment(server or self.server), cwd=self.scratch,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S)

    def fine(self, *arguments, **options):
        """Its stdout; the client must exit with 0."""
        result = self.run_client(*arguments, **options)
        self.assertEqual(result.returncode, 0, f"{arguments}\n{result.stdout}\n{result.stderr}")
        return result.stdout

    def refused(self, exit_code, code, *arguments, **options):
        """Its one line of stderr; the client must exit so, print nothing, and name `code`. Where the machine is slow, progress may come before it."""
        result = self.run_client(*arguments, **options)
        shown = f"{arguments}\nexit {result.returncode}\n{result.stdout}\n{result.stderr}"
        self.assertEqual(result.returncode, exit_code, shown)
        self.assertEqual(result.stdout, "", shown)
        error = re.sub(r"\A(?:[a-z]+(?: \d+/\d+)?\n)*", "", result.stderr)
        self.assertRegex(error, rf"\Asculpt: {code}: \S.*\n\Z", shown)
        return error


class DaemonTest(ClientTest):
    """The same with one daemon for all tests of the class."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        cls.addClassCleanup(folder.cleanup)
        daemon = Daemon(pathlib.Path(folder.name) / "data")
        cls.addClassCleanup(daemon.stop)
        cls.daemon, cls.server = daemon, daemon.address

    def tearDown(self):
        self.assertIsNone(self.daemon.process.poll(), "the daemon ended:\n" + self.daemon.log())
