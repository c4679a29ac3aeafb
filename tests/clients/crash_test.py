"""kill -9, restarts, second daemons, folders and ports that cannot be used; and that nothing is left running."""

import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import time
import unittest

import shapes
from harness import PATIENCE_S, SOURCE, ClientTest, Daemon

import sculpt


class Crash(ClientTest):
    def setUp(self):
        super().setUp()
        self.mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        self.data = self.scratch / "data"

    def submit(self, *options, robot="gantry", resolution=8):
        return self.fine("submit", self.mesh, "--resolution", resolution, "--robot", robot, *options).strip()

    def submit_long(self, *options):
        """Seconds of work, so that it still runs when it is seen to."""
        return self.submit("--search", "octree", *options, robot="panda-turntable", resolution=32)

    def sha256(self, job):
        return json.loads(self.fine("report", job, "--json"))["plan_sha256"]

    def wait_until_running(self, job):
        with sculpt.Client(self.server) as client:
            client.call("events.subscribe", job=job)
            while client.next_event().get("data", {}).get("to") != "running":
                pass

    def test_killed_while_a_job_runs_and_others_wait_nothing_is_lost(self):
        daemon = Daemon(self.data, "--workers", "1")
        self.server = daemon.address
        finished = self.submit("--wait")
        before = self.fine("report", finished, "--json"), self.fine("fetch", finished, "-o", "-")
        expected = self.sha256(self.submit_long("--wait"))
        running = self.submit_long()
        queued = [self.submit("--key", f"order {n}") for n in range(3)]
        self.wait_until_running(running)
        daemon.kill()

        with Daemon(self.data, "--workers", "1") as daemon:
            self.server = daemon.address
            self.assertEqual((self.fine("report", finished, "--json"), self.fine("fetch", finished, "-o", "-")), before)
            for job in [running, *queued]:
                self.fine("wait", job)
            self.assertEqual(self.sha256(running), expected)
            self.assertEqual(json.loads(self.fine("status", running, "--json"))["attempt"], 2)
            again = json.loads(self.fine("submit", self.mesh, "--resolution", 8, "--robot", "gantry", "--key", "order 1", "--json"))
            self.assertEqual((again["job"], again["duplicate"]), (queued[1], True))
            self.assertEqual(len(json.loads(self.fine("list", "--json"))["jobs"]), 6)

    def test_killed_again_and_again_every_acknowledged_job_is_there(self):
        acknowledged = []
        for _ in range(4):
            daemon = Daemon(self.data, "--workers", "1")
            self.server = daemon.address
            acknowledged += [self.submit() for _ in range(3)]
            daemon.kill()
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            for job in acknowledged:
                self.fine("wait", job)
            self.assertEqual([job["job"] for job in json.loads(self.fine("list", "--json"))["jobs"]], acknowledged)

    def test_a_stop_while_a_job_runs_is_orderly_and_the_job_runs_again(self):
        daemon = Daemon(self.data, "--workers", "1")
        self.server = daemon.address
        job = self.submit_long()
        self.wait_until_running(job)
        self.assertEqual(daemon.stop(), 0)
        with Daemon(self.data, "--workers", "1") as daemon:
            self.server = daemon.address
            self.fine("wait", job)
            self.assertEqual(daemon.stop(), 0)

    def test_checkpoints_stay_as_long_as_a_job_may_go_on(self):
        daemon = Daemon(self.data, "--workers", "1")
        self.server = daemon.address
        job, never = self.submit_long(), self.submit_long()
        self.wait_until_running(job)
        self.assertEqual(daemon.stop(), 0)
        self.assertTrue((self.data / "jobs" / job).exists(), "an interrupted job keeps its files")
        with Daemon(self.data, "--workers", "1") as daemon:
            self.server = daemon.address
            self.fine("wait", job)
            self.wait_until_running(never)
            self.fine("cancel", never)
            folder = self.data / "jobs" / never
            end = time.monotonic() + PATIENCE_S
            while folder.exists():
                self.assertLess(time.monotonic(), end, "a cancelled job leaves no files")
                time.sleep(0.01)
        left = sorted(file.name for file in (self.data / "jobs" / job).iterdir())
        self.assertEqual(left, ["report.json", "residue.ndjson", "stock.binvox", "timeline.tokens", "trajectory.ndjson", "voxels.binvox"])

    def test_killed_at_random_moments_again_and_again_it_ends_with_the_same_bytes(self):
        seed = random.randrange(2**32)
        print(f"seed {seed}", file=sys.stderr)
        moments = random.Random(seed)
        jobs = [("panda-turntable", "sweep"), ("panda-turntable", "octree"), ("gantry", "octree"), ("gantry", "voxel")]
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            expected = [self.sha256(self.submit("--wait", "--search", search, robot=cell, resolution=16)) for cell, search in jobs]
        for (cell, search), sha256 in zip(jobs, expected):
            job = None
            for _ in range(3):
                daemon = Daemon(self.data, "--workers", "1")
                self.server = daemon.address
                job = job or self.submit("--search", search, robot=cell, resolution=16)
                time.sleep(moments.uniform(0, 0.5))
                daemon.kill()
            with Daemon(self.data, "--workers", "1") as daemon:
                self.server = daemon.address
                self.fine("wait", job)
                self.assertEqual(self.sha256(job), sha256, f"{search} of {cell}, seed {seed}")


class Poison(ClientTest):
    """Where jobs run in the daemon: one that ran when it was killed runs in a process of its own from then on."""

    def setUp(self):
        super().setUp()
        self.data = self.scratch / "data"
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))
        daemon = Daemon(self.data, "--workers", "2", "--isolate", "false")
        self.server = daemon.address
        self.job = self.fine("submit", mesh, "--resolution", 64, "--robot", "panda-turntable", "--search", "octree").strip()
        self.wait_for("running", 1)
        daemon.kill()

    def wait_for(self, state, attempt):
        """Until the job has got there; gives the event's data."""
        with sculpt.Client(self.server) as client:
            client.call("events.subscribe", job=self.job)
            while True:
                data = client.next_event().get("data", {})
                if data.get("to") == state and data.get("attempt") == attempt:
                    return data

    def worker(self, daemon):
        """The process id of the job, once it is there."""
        while True:
            for found in map(int, processes_with("--run-job")):
                if parent_of(found) == daemon.process.pid:
                    return found

    def test_its_second_crash_puts_it_into_quarantine_and_the_daemon_lives_on(self):
        with Daemon(self.data, "--workers", "2", "--isolate", "false") as daemon:
            self.server = daemon.address
            os.kill(self.worker(daemon), signal.SIGKILL)
            data = self.wait_for("quarantined", 2)
            self.assertEqual(data["error"]["code"], "planner_crashed")
            self.refused(1, "planner_crashed", "wait", self.job)
            neighbour = self.fine("submit", shapes.write_stl(self.scratch / "b.stl", shapes.ball()), "--resolution", 8, "--robot", "gantry")
            self.fine("wait", neighbour.strip())
            self.assertEqual(self.fine("retry", self.job), "queued\n")
            self.worker(daemon)
            self.fine("cancel", self.job)
            self.wait_for("cancelled", 3)
            self.assertEqual(daemon.stop(), 0)
            self.assertEqual(self.workers_of(daemon), [])

    def test_a_daemon_that_is_killed_takes_the_process_with_it_and_the_job_is_not_blamed(self):
        for attempt in range(2, 5):
            daemon = Daemon(self.data, "--workers", "2", "--isolate", "false")
            self.server = daemon.address
            worker = self.worker(daemon)
            self.wait_for("running", attempt)
            daemon.kill()
            while parent_of(worker) is not None:
                pass
        with Daemon(self.data, "--isolate", "false") as daemon:
            self.server = daemon.address
            self.worker(daemon)
            self.wait_for("running", 5)

    def workers_of(self, daemon):
        return [found for found in processes_with("--run-job") if parent_of(found) == daemon.process.pid]


class Startup(ClientTest):
    def start(self, *options):
        return subprocess.run([os.environ["SCULPTD"], *map(str, options)], cwd=SOURCE, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=60)

    def reject(self, *options, hint):
        result = self.start(*options)
        self.assertNotEqual(result.returncode, 0)
        self.assertGreater(result.returncode, 0, "it crashed: " + result.stderr)
        self.assertRegex(result.stderr, rf"sculptd: .*{hint}")

    def test_a_second_daemon_on_the_same_folder_is_refused_and_the_first_goes_on(self):
        data = self.scratch / "data"
        with Daemon(data) as daemon:
            self.reject("--listen", "127.0.0.1:0", "--data", data, hint="data")
            self.server = daemon.address
            self.fine("list")

    def test_a_port_in_use_is_named(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            self.reject("--listen", f"127.0.0.1:{port}", "--data", self.scratch / "data", hint=str(port))

    def test_a_folder_that_cannot_be_written_is_named(self):
        (self.scratch / "file").write_text("in the way")
        self.reject("--listen", "127.0.0.1:0", "--data", self.scratch / "file" / "data", hint="file")
        self.reject("--listen", "127.0.0.1:0", "--data", "/proc/sculptd", hint="/proc/sculptd")

    def test_a_config_that_cannot_be_used_is_named(self):
        (self.scratch / "server.json").write_text('{"wokers": 2}')
        self.reject("--config", self.scratch / "server.json", "--data", self.scratch / "data", hint="wokers")
        self.reject("--config", self.scratch / "nothere.json", "--data", self.scratch / "data", hint="nothere.json")
        self.reject("--listen", "nowhere", "--data", self.scratch / "data", hint="nowhere")

    def test_nothing_is_left_running(self):
        marker = str(self.scratch / "data")
        with Daemon(marker, "--workers", "2") as daemon:
            self.server = daemon.address
            mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
            self.fine("submit", mesh, "--resolution", 8, "--robot", "panda-turntable", "--wait")
            self.assertTrue(processes_with(marker), "the test must see the daemon while it runs")
        self.assertEqual(processes_with(marker), [])


def processes_with(argument):
    """Ids of processes that have this argument."""
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if argument.encode() in entry.read_bytes().split(b"\0"):
                found.append(entry.parent.name)
        except OSError:
            pass  # it ended meanwhile
    return found


def parent_of(process):
    """Nothing once it has ended, reaped or not."""
    try:
        state, parent = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[:2]
    except OSError:
        return None
    return None if state in "ZX" else int(parent)


if __name__ == "__main__":
    unittest.main()
