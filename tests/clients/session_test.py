"""A session with a live daemon, once with the C++ client and once with the Python client: the same verbs, the same answers."""

import hashlib
import json
import unittest

import shapes
from harness import SCULPT, SCULPT_PY, SOURCE, DaemonTest, shared_data

import sculpt


# What stands round the arm of ROS: floor, turntable, and a tool that starts below the fingers.
ROOM = """
  <link name="room"><collision><origin xyz="0.3 0 -0.05"/><geometry><box size="2 2 0.1"/></geometry></collision></link>
  <joint name="mount" type="fixed"><parent link="room"/><child link="panda_link0"/></joint>
  <link name="disc"><collision><origin xyz="0 0 -0.01"/><geometry><cylinder radius="0.1" length="0.02"/></geometry></collision></link>
  <joint name="table" type="continuous"><parent link="room"/><child link="disc"/><origin xyz="0.5 0 0.12"/><axis xyz="0 0 1"/></joint>
  <link name="nose"/>
  <joint name="nose_joint" type="fixed"><parent link="panda_hand"/><child link="nose"/><origin xyz="0 0 0.13"/></joint>
</robot>"""


class Verbs:
    """Every verb that needs a server; run by both clients."""

    def submit(self, *options, triangles=None, robot="gantry", resolution=8):
        mesh = shapes.write_stl(self.scratch / "steps.stl", triangles or shapes.steps())
        return self.fine("submit", mesh, "--resolution", resolution, "--robot", robot, *options)

    def finished(self, *options, **shape):
        job = self.submit(*options, **shape).strip()
        self.fine("wait", job)
        return job

    def test_submit_prints_the_job_alone(self):
        self.assertRegex(self.submit(), r"^[0-9A-Z]{26}\n$")
        reply = json.loads(self.submit("--json"))
        self.assertEqual(set(reply), {"job", "state", "duplicate"})
        self.assertFalse(reply["duplicate"])

    def test_submit_with_wait_ends_with_the_job(self):
        reply = json.loads(self.submit("--wait", "--json"))
        self.assertEqual(reply["state"], "succeeded")

    def test_the_same_key_is_the_same_job(self):
        key = self.id() + " key"
        first = json.loads(self.submit("--key", key, "--json"))
        second = json.loads(self.submit("--key", key, "--json"))
        self.assertEqual((first["job"], first["duplicate"], second["job"], second["duplicate"]), (first["job"], False, first["job"], True))
        mesh = self.scratch / "steps.stl"
        self.refused(4, "key_conflict", "submit", mesh, "--resolution", 16, "--robot", "gantry", "--key", key)

    def test_the_newest_jobs_are_listed_first_when_asked_for(self):
        jobs = [self.submit().strip() for _ in range(3)]
        newest = [entry["job"] for entry in json.loads(self.fine("list", "--newest", "--json"))["jobs"]]
        self.assertEqual(newest, sorted(newest, reverse=True))
        self.assertEqual(newest[:3], jobs[::-1])
        limited = self.fine("list", "--newest", "--limit", 2).splitlines()
        self.assertEqual([row.split()[0] for row in limited[1:]], jobs[:0:-1])
        self.assertEqual(len(self.fine("list", "--limit", 1).splitlines()), 2)

    def test_status_and_list_show_the_job(self):
        job = self.finished("--seed", 5, "--priority", -3)
        status = json.loads(self.fine("status", job, "--json"))
        self.assertEqual((status["job"], status["state"], status["seed"], status["priority"]), (job, "succeeded", 5, -3))
        listed = {entry["job"]: entry for entry in json.loads(self.fine("list", "--json"))["jobs"]}
        self.assertEqual(listed[job]["state"], "succeeded")
        self.assertEqual(list(listed), sorted(listed))
        self.assertIn(job, self.fine("list"))
        self.assertIn("succeeded", self.fine("status", job))

    def test_watch_tells_the_way_to_the_end(self):
        job = self.submit().strip()
        lines = self.fine("watch", job).splitlines()
        self.assertEqual((lines[0], lines[-1]), ("queued", "succeeded"))
        self.assertEqual(json.loads(self.fine("watch", job, "--json"))["state"], "succeeded")

    def test_wait_is_silent(self):
        job = self.submit().strip()
        result = self.run_client("wait", job)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        self.assertEqual(json.loads(self.fine("wait", job, "--json"))["state"], "succeeded")

    def test_report_has_the_promised_fields(self):
        job = self.finished(robot="panda-turntable")
        report = json.loads(self.fine("report", job, "--json"))
        fields = {"job", "state", "mesh", "robot", "search", "seed", "resolution", "voxels", "residue", "octree", "path", "seconds",
                  "peak_memory_bytes", "threads", "plan_sha256", "verify"}
        self.assertLessEqual(fields, set(report))
        self.assertEqual(report["voxels"]["removed"] + report["voxels"]["residue"], report["voxels"]["remove"])
        self.assertTrue(report["verify"]["clean"])
        self.assertIn(report["plan_sha256"], self.fine("report", job))

    def test_fetch_writes_each_artifact_whole(self):
        job = self.finished()
        self.fine("fetch", job, "-o", "t.ndjson")
        lines = (self.scratch / "t.ndjson").read_bytes().splitlines(keepends=True)
        self.assertEqual(json.loads(lines[0])["type"], "header")
        self.assertEqual(json.loads(lines[-1])["sha256"], hashlib.sha256(b"".join(lines[:-1])).hexdigest())
        self.assertEqual(self.fine("fetch", job, "-o", "-"), b"".join(lines).decode())
        self.fine("fetch", job, "-o", "t.csv", "--format", "csv")
        self.fine("fetch", job, "-o", "t.sct", "--format", "binary")
        self.assertTrue((self.scratch / "t.sct").read_bytes().startswith(b"SCULPTRJ"))
        self.fine("fetch", job, "-o", "v.binvox", "--artifact", "voxels")
        self.assertTrue((self.scratch / "v.binvox").read_bytes().startswith(b"#binvox 1\n"))
        self.fine("fetch", job, "-o", "r.ndjson", "--artifact", "residue")
        self.fine("fetch", job, "-o", "r.json", "--artifact", "report")
        self.assertEqual(json.loads((self.scratch / "r.json").read_text())["resolution"], 8)
        self.assertEqual(list(self.scratch.glob("*.part")), [])

    def test_fetch_of_a_new_job_waits_for_its_end(self):
        job = self.submit(robot="panda-turntable", triangles=shapes.ball(), resolution=16).strip()
        lines = self.fine("fetch", job, "-o", "-").splitlines()
        self.assertEqual(json.loads(lines[-1])["type"], "end")

    def test_verify_replays_the_job(self):
        job = self.finished()
        verdict = json.loads(self.fine("verify", job, "--json"))
        self.assertTrue(verdict["clean"])
        self.assertEqual(verdict["collisions"], 0)
        self.assertRegex(self.fine("verify", job), r"clean, \d+ voxels checked, 0 findings\n")

    def test_cancel_ends_a_running_job(self):
        job = self.submit("--priority", 50, robot="panda-turntable", triangles=shapes.ball(24), resolution=64).strip()
        self.assertIn(json.loads(self.fine("cancel", job, "--json"))["state"], ("cancelling", "cancelled"))
        self.refused(1, "cancelled", "wait", job)
        self.assertEqual(json.loads(self.fine("status", job, "--json"))["state"], "cancelled")
        self.refused(1, "cancelled", "fetch", job, "-o", "t.ndjson")
        self.assertFalse((self.scratch / "t.ndjson").exists())
        done = self.finished()
        self.refused(4, "wrong_state", "cancel", done)

    def test_a_job_is_held_until_its_time_and_can_be_paused_before(self):
        reply = json.loads(self.submit("--not-before", "2100-01-01T00:00:00Z", "--max-runtime", 60, "--json"))
        job = reply["job"]
        self.assertEqual(reply["state"], "held")
        self.assertEqual(json.loads(self.fine("status", job, "--json"))["until"], "2100-01-01T00:00:00.000Z")
        self.assertEqual(self.fine("pause", job), "paused\n")
        self.assertEqual(json.loads(self.fine("resume", job, "--json")), {"job": job, "state": "held"})
        self.refused(4, "wrong_state", "retry", job)
        self.assertEqual(self.fine("cancel", job), "cancelled\n")
        self.refused(4, "params_invalid", "submit", self.scratch / "steps.stl", "--resolution", 8, "--robot", "gantry",
                     "--start-by", "tomorrow")

    def test_a_job_that_misses_its_start_expires(self):
        job = self.submit("--start-by", "2020-01-01T00:00:00Z").strip()
        self.refused(1, "expired", "wait", job)

    def test_a_running_job_is_paused_and_runs_again_when_it_is_resumed(self):
        job = self.submit("--priority", 50, "--search", "octree", robot="panda-turntable", triangles=shapes.ball(24), resolution=64).strip()
        with sculpt.Client(self.server) as client:
            client.call("events.subscribe", job=job)
            self.wait_for_state(client, "running")
            self.assertEqual(self.fine("pause", job), "pausing\n")
            self.wait_for_state(client, "paused")
            self.assertEqual(self.fine("resume", job), "queued\n")
            self.wait_for_state(client, "running")
            self.assertEqual(self.fine("cancel", job), "cancelling\n")
            self.wait_for_state(client, "cancelled")

    def wait_for_state(self, client, state):
        while client.next_event().get("data", {}).get("to") != state:
            pass

    def test_a_job_is_pinned(self):
        job = self.finished()
        self.assertEqual(self.fine("pin", job), "pinned\n")
        self.assertTrue(json.loads(self.fine("status", job, "--json"))["pinned"])
        self.assertEqual(json.loads(self.fine("pin", job, "--off", "--json")), {"job": job, "pinned": False})
        self.assertIn("expires_at", json.loads(self.fine("status", job, "--json")))

    def test_while_the_queue_is_paused_no_job_starts(self):
        self.assertEqual(self.fine("queue", "pause"), "paused\n")
        try:
            job = self.submit().strip()
            self.assertTrue(json.loads(self.fine("status", job, "--json"))["state"] == "queued")
        finally:
            self.assertEqual(self.fine("queue", "resume"), "open\n")
        self.fine("wait", job)

    def test_a_cell_file_is_sent_with_its_urdf(self):
        cell = json.loads((SOURCE / "config/cells/gantry.json").read_text())
        urdf = SOURCE / "config/cells" / cell["urdf"]
        (self.scratch / "my.urdf").write_bytes(urdf.read_bytes())
        (self.scratch / "my.json").write_text(json.dumps({**cell, "urdf": "my.urdf"}))
        job = self.finished(robot="my.json")
        own = json.loads(self.fine("report", job, "--json"))
        shipped = json.loads(self.fine("report", self.finished(), "--json"))
        self.assertEqual(own["robot"], "my")
        self.assertEqual(own["path"], shipped["path"])

    def test_a_cell_of_ros_is_sent_with_its_meshes(self):
        package = shared_data(self, "ros/moveit_resources_panda_description")
        urdf = (package / "urdf/panda.urdf").read_text().replace("</robot>", ROOM)
        (self.scratch / "room.urdf").write_text(urdf)
        (self.scratch / "ros.json").write_text(json.dumps({
            "urdf": "room.urdf", "packages": {package.name: str(package)},
            "stock": {"link": "disc", "size_m": 0.16, "origin_m": [-0.08, -0.08, 0]},
            "tool": {"link": "nose", "stickout_m": 0.2, "ball_radius_voxels": 0.45, "shank_radius_voxels": 0.4},
            "home": {"panda_joint2": -0.139, "panda_joint4": -1.612, "panda_joint6": 1.473, "panda_joint7": 0.717,
                     "panda_finger_joint1": 0.02}}))
        job = self.finished(robot="ros.json")
        report = json.loads(self.fine("report", job, "--json"))
        self.assertTrue(report["verify"]["clean"])
        self.assertGreater(report["voxels"]["removed"], 0)

    def test_placement_and_stock_reach_the_planner(self):
        job = self.finished("--scale", "0.025", "--rotate", "0,0,90", "--offset", "0.05,-0.05,0", "--stock-box", "0,0,0,0.2,0.2,0.1")
        voxels = json.loads(self.fine("report", job, "--json"))["voxels"]
        low, high = 4 * 4 * 2, 2 * 2 * 2  # 0.1 m wide in a grid of 0.2 m, so half of its 8 voxels: 4 x 4 x 2 below, 2 x 2 x 2 above
        self.assertEqual(voxels, {**voxels, "air": 256, "keep": low + high, "remove": 256 - low - high})

    def test_an_address_that_is_none_is_usage(self):
        for address in ("nohost", "host:", ":80", "127.0.0.1:99999", "127.0.0.1:http"):
            self.refused(2, "usage", "list", "--server", address)
        self.refused(3, "unreachable", "list", "--server", "127.0.0.1:1")
        self.refused(3, "unreachable", "--server", "127.0.0.1:1", "list")

    def test_an_unknown_job_is_refused_by_every_verb(self):
        for verb in ("status", "watch", "wait", "cancel", "report", "verify"):
            self.refused(4, "not_found", verb, "nosuchjob")
        self.refused(4, "not_found", "fetch", "nosuchjob", "-o", "x")


class CommandLineSession(Verbs, DaemonTest):
    client = SCULPT


class PythonSession(Verbs, DaemonTest):
    client = SCULPT_PY

    def test_the_module_is_a_client(self):
        mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())
        with sculpt.Client(self.server) as client:
            job = client.submit({"mesh": client.upload_file(mesh), "robot": "gantry", "resolution": 8})["job"]
            self.assertEqual(client.wait(job)["state"], "succeeded")
            text = b"".join(client.read_artifact(job))
            self.assertEqual(client.call("job.report", job=job)["plan_sha256"], json.loads(text.splitlines()[-1])["sha256"])
            with self.assertRaises(sculpt.Failure) as caught:
                client.call("job.get", job="nosuchjob")
            self.assertEqual((caught.exception.exit_code, caught.exception.code), (sculpt.REFUSED, "not_found"))


class SameAnswers(DaemonTest):
    def test_server_and_plan_give_the_same_bytes(self):
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        options = ["--resolution", 16, "--robot", "panda-turntable", "--seed", 3]
        local = json.loads(self.fine("plan", mesh, *options, "--json", "-o", "local.ndjson"))
        hashes = {local["plan_sha256"]}
        for _ in range(2):
            job = self.fine("submit", mesh, *options, "--wait").strip()
            hashes.add(json.loads(self.fine("report", job, "--json"))["plan_sha256"])
        self.assertEqual(len(hashes), 1)
        self.fine("fetch", job, "-o", "remote.ndjson")
        self.assertEqual((self.scratch / "local.ndjson").read_bytes(), (self.scratch / "remote.ndjson").read_bytes())
        self.fine("verify", "remote.ndjson", "--mesh", mesh, "--robot", "panda-turntable")


if __name__ == "__main__":
    unittest.main()
