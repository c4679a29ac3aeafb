"""sculptd as its operator meets it: settings on the command line, signals, service managers."""

import json
import os
import pathlib
import signal
import socket
import subprocess
import time
import unittest
from unittest import mock

import shapes
from harness import PATIENCE_S, ClientTest, Daemon, DaemonTest, environment


class Config(ClientTest):
    client = [os.environ["SCULPTD"]]

    def test_config_shows_every_value_and_where_it_is_from(self):
        file = self.scratch / "server.json"
        file.write_text('{"stall_s": 7, "log": "warn"}')
        shown = json.loads(self.fine("config", "--json", "--config", file, "--log", "debug"))["settings"]
        values = {row["name"]: (row["value"], row["from"]) for row in shown}
        self.assertEqual(values["stall_s"], (7, "file"))
        self.assertEqual(values["log"], ("debug", "flag"))
        self.assertEqual(values["workers"], (0, "default"))
        self.assertRegex(self.fine("--config", file, "config"), r"(?m)^stall_s +7 +file$")

    def test_the_environment_stands_between_file_and_flags(self):
        env = {**environment(), "SCULPTD_STALL_S": "8"}
        result = subprocess.run([*self.client, "config", "--json"], env=env, capture_output=True, text=True, timeout=PATIENCE_S)
        values = {row["name"]: (row["value"], row["from"]) for row in json.loads(result.stdout)["settings"]}
        self.assertEqual(values["stall_s"], (8, "environment"))

    def test_mistakes_end_it_with_the_exit_code_that_says_whose(self):
        file = self.scratch / "server.json"
        file.write_text('{"stal_s": 7}')
        result = self.run_client("config", "--config", file)
        self.assertEqual(result.returncode, 78)
        self.assertIn("/stal_s is not known; the nearest setting is stall_s;", result.stderr)
        result = self.run_client("--workers", "many")
        self.assertEqual(result.returncode, 2)
        self.assertIn("workers must be a number", result.stderr)


class Rights(DaemonTest):
    def test_the_data_folder_is_its_own(self):
        """Whatever the umask; results are nobody else's business."""
        mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())
        job = self.fine("submit", mesh, "--resolution", 8, "--robot", "gantry").strip()
        self.fine("wait", job)
        self.fine("fetch", job, "--format", "csv", "-o", self.scratch / "plan.csv")
        data = pathlib.Path(self.daemon.data)
        files = [data, *data.rglob("*")]
        self.assertGreater(len(files), 10)
        self.assertEqual({str(file): oct(file.stat().st_mode) for file in files if file.stat().st_mode & 0o077}, {})

    def test_a_folder_that_an_older_version_left_open_is_closed(self):
        data = self.scratch / "data"
        data.mkdir(mode=0o755)
        with Daemon(data):
            self.assertEqual(data.stat().st_mode & 0o777, 0o700)


def await_log(daemon, words):
    end = time.monotonic() + PATIENCE_S
    while words not in daemon.log():
        if time.monotonic() > end:
            raise AssertionError(f"the log never said {words!r}:\n{daemon.log()}")
        time.sleep(0.01)


class Reload(ClientTest):
    def setUp(self):
        super().setUp()
        self.file = self.scratch / "server.json"

    def reload(self, daemon, text, says):
        self.file.write_text(text)
        daemon.process.send_signal(signal.SIGHUP)
        await_log(daemon, says)

    def test_a_reload_takes_all_or_nothing(self):
        self.file.write_text("{}")
        with Daemon(self.scratch / "data", "--config", self.file) as daemon:
            self.reload(daemon, '{"log": "debug", "workers": 3}', "nothing changed: these take effect only at a start: workers")
            self.reload(daemon, '{"log": "debug", "stall_s": -1}', "nothing changed: the config file")
            self.fine("list", server=daemon.address)
            self.assertNotIn("conn=", daemon.log())  # still info
            self.reload(daemon, '{"log": "debug", "log_format": "json"}', '"message":"the config is reloaded"')
            self.fine("list", server=daemon.address)
            await_log(daemon, '"conn":2')
            self.assertEqual(daemon.stop(), 0)


class Signals(ClientTest):
    def test_a_second_signal_ends_it_at_once(self):
        with Daemon(self.scratch / "data") as daemon:
            daemon.process.terminate()
            await_log(daemon, "signal 15: stopping")
            daemon.process.terminate()
            self.assertIn(daemon.process.wait(PATIENCE_S), (0, -signal.SIGTERM))


class ServiceManager(ClientTest):
    """The test is the service manager."""

    def test_it_is_told_all_of_the_daemons_life(self):
        path = self.scratch / "notify"
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
            manager.bind(str(path))
            manager.settimeout(PATIENCE_S)
            with mock.patch.dict(os.environ, {"NOTIFY_SOCKET": str(path), "WATCHDOG_USEC": "400000"}):
                daemon = Daemon(self.scratch / "data")
            with daemon:
                told = self.receive_until(manager, lambda seen: {"READY=1", "STATUS=0 running, 0 queued", "WATCHDOG=1"} <= set(seen))
                self.assertEqual(told[0], "READY=1")
                daemon.process.send_signal(signal.SIGHUP)
                self.receive_until(manager, lambda seen: "READY=1" in seen and seen.index("RELOADING=1") < seen.index("READY=1"))
                daemon.process.terminate()
                self.receive_until(manager, lambda seen: "STOPPING=1" in seen)

    def receive_until(self, manager, enough):
        seen = []
        while not enough(seen):
            seen += manager.recv(4096).decode().split("\n")
        return seen


if __name__ == "__main__":
    unittest.main()
