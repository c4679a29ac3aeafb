"""Several clients of one daemon, and daemons that end and come back meanwhile."""

import json
import subprocess
import time
import unittest

import shapes
from harness import PATIENCE_S, SCULPT, SCULPT_PY, ClientTest, Daemon, environment

import sculpt


class TwoClients(ClientTest):
    def test_one_submits_and_watches_while_the_other_lists_cancels_and_fetches(self):
        with Daemon(self.scratch / "data", "--workers", "1") as daemon:
            self.server = daemon.address
            mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))
            first = self.fine("submit", mesh, "--resolution", 8, "--robot", "panda-turntable", "--wait").strip()
            long_job = self.fine("submit", mesh, "--resolution", 64, "--robot", "panda-turntable").strip()
            behind = self.fine("submit", mesh, "--resolution", 8, "--robot", "gantry").strip()
            watcher = subprocess.Popen([*SCULPT, "watch", long_job], env=environment(self.server), stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
            try:
                while "running" not in watcher.stdout.readline():
                    pass
                self.client = SCULPT_PY
                states = {job["job"]: job["state"] for job in json.loads(self.fine("list", "--json"))["jobs"]}
                self.assertEqual(states, {first: "succeeded", long_job: "running", behind: "queued"})
                self.fine("fetch", first, "-o", "first.ndjson")
                self.fine("cancel", long_job)
                output, errors = watcher.communicate()
            finally:
                watcher.kill()
                watcher.communicate()
            self.assertEqual(watcher.returncode, 1, output + errors)
            self.assertIn("cancelled", output.splitlines()[-1])
            self.fine("wait", behind)

    def test_a_daemon_that_dies_is_unreachable_to_those_who_wait_on_it(self):
        daemon = Daemon(self.scratch / "data", "--workers", "1")
        self.server = daemon.address
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))
        job = self.fine("submit", mesh, "--resolution", 256, "--robot", "panda-turntable").strip()
        verbs = (["watch", job], ["wait", job], ["fetch", job, "-o", "t.ndjson"])
        waiting = [subprocess.Popen([*client, *verb], env=environment(self.server), cwd=self.scratch, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, text=True) for client in (SCULPT, SCULPT_PY) for verb in verbs]
        with sculpt.Client(self.server) as client:
            client.call("job.wait", job=job, timeout_s=2)  # long enough for all of them to be connected
        daemon.kill()
        for process in waiting:
            _, errors = process.communicate()
            self.assertEqual(process.returncode, 3, f"{process.args}\n{errors}")
            self.assertRegex(errors, r"^sculpt: unreachable: ")
        self.assertEqual(list(self.scratch.glob("t.ndjson*")), [])

    def test_those_who_wait_find_the_daemon_that_comes_after(self):
        daemon = Daemon(self.scratch / "data", "--workers", "1", "--log", "debug")
        self.server = daemon.address
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        job = self.fine("submit", mesh, "--resolution", 16, "--robot", "panda-turntable", "--search", "octree").strip()
        patient = {**environment(self.server), "SCULPT_PATIENCE_S": str(PATIENCE_S)}
        clients = {"cpp": SCULPT, "python": SCULPT_PY}
        waiting = {(name, verb[0]): subprocess.Popen([*client, *verb], env=patient, cwd=self.scratch, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                   for name, client in clients.items() for verb in (["watch", job], ["wait", job], ["fetch", job, "-o", name])}
        for name in clients:
            while "running" not in waiting[name, "watch"].stdout.readline():
                pass
        while daemon.log().count(" client=") < 1 + len(waiting):  # of submit and of those: all have said hello
            time.sleep(0.02)
        daemon.kill()
        with Daemon(self.scratch / "data", "--workers", "1", listen=self.server):
            for process in waiting.values():
                output, errors = process.communicate()
                self.assertEqual(process.returncode, 0, f"{process.args}\n{output}\n{errors}")
                if "watch" in process.args:
                    states = [line.split()[0] for line in output.splitlines() if line.split()[0] in ("queued", "running", "succeeded")]
                    self.assertEqual(states, ["queued", "running", "succeeded"], output)
                    self.assertIn("looking for the server", output + errors)
            artifacts = json.loads(self.fine("status", job, "--json"))
            self.assertEqual(artifacts["state"], "succeeded")
        self.assertEqual((self.scratch / "cpp").read_bytes(), (self.scratch / "python").read_bytes())
        self.assertEqual((self.scratch / "cpp").read_bytes(), (self.scratch / "data/jobs" / job / "trajectory.ndjson").read_bytes())

    def test_the_subscription_to_all_jobs_goes_on_in_the_next_connection(self):
        with Daemon(self.scratch / "data") as daemon, sculpt.Client(daemon.address, patience_s=PATIENCE_S) as client:
            mesh = client.upload_file(shapes.write_stl(self.scratch / "steps.stl", shapes.steps()))
            spec, events = {"mesh": mesh, "robot": "gantry", "resolution": 8}, []

            def hear(job, state):
                while (events[-1]["job"], events[-1]["data"]["to"]) != (job, state) if events else True:
                    event = client.next_event()
                    events.extend([event] if event["type"] == "state" else [])

            client.call("events.subscribe", after=client.list()["last"])
            first = client.submit(spec)["job"]
            hear(first, "succeeded")
            daemon.kill()
            with Daemon(self.scratch / "data", listen=daemon.address) as again, sculpt.Client(again.address) as other:
                second = other.submit(spec)["job"]
                hear(second, "succeeded")
            numbers = [event["number"] for event in events]
            self.assertEqual(numbers, list(range(1, 7)), "none is lost and none comes twice")
            self.assertEqual([event["job"] for event in events], 3 * [first] + 3 * [second])

    def test_a_job_that_has_ended_is_not_followed_into_the_next_connection(self):
        with Daemon(self.scratch / "data") as daemon, sculpt.Client(daemon.address, patience_s=PATIENCE_S) as client:
            mesh = client.upload_file(shapes.write_stl(self.scratch / "steps.stl", shapes.steps()))
            job = client.submit({"mesh": mesh, "robot": "gantry", "resolution": 8})["job"]
            client.call("events.subscribe", job=job)
            while client.next_event().get("data", {}).get("to") != "succeeded":
                self.assertIn(job, client.followed)
            self.assertEqual(client.followed, {})
            daemon.kill()
            with Daemon(self.scratch / "data", "--keep-bytes", "0", listen=daemon.address):
                while (self.scratch / "data/jobs" / job).exists():
                    time.sleep(0.02)
                self.assertEqual(client.call("job.list")["jobs"], [])

    def test_interrupting_a_watch_leaves_the_job_running(self):
        with Daemon(self.scratch / "data", "--workers", "1") as daemon:
            self.server = daemon.address
            mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))
            job = self.fine("submit", mesh, "--resolution", 64, "--robot", "panda-turntable").strip()
            for client in (SCULPT, SCULPT_PY):
                watcher = subprocess.Popen([*client, "watch", job], env=environment(self.server), stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True)
                while "running" not in watcher.stdout.readline():
                    pass
                watcher.send_signal(2)
                _, errors = watcher.communicate()
                self.assertEqual(watcher.returncode, 1, errors)
                self.assertIn(f"job {job} goes on", errors)
            self.assertEqual(json.loads(self.fine("status", job, "--json"))["state"], "running")
            self.fine("cancel", job)


if __name__ == "__main__":
    unittest.main()
