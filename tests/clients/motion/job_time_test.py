"""Time of a job: both clients ask for it in the same words, and its report tells it."""

import json
import unittest

import shapes
from harness import SCULPT, SCULPT_PY, SOURCE, DaemonTest


class JobTime(DaemonTest):
    def setUp(self):
        super().setUp()
        self.mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))

    def submit(self, *options, robot="panda-turntable"):
        return ("submit", self.mesh, "--resolution", 8, "--robot", robot, *options)

    def test_the_report_tells_what_sculpt_time_does(self):
        for self.client in (SCULPT, SCULPT_PY):
            job = self.fine(*self.submit("--feed", 0.1, "--rapid", 0.4, "--keep-feed", 0.01, "--wait")).strip()
            time = json.loads(self.fine("report", job, "--json"))["time"]
            self.client = SCULPT
            self.assertEqual(time, json.loads(self.fine("time", job, "--feed", 0.1, "--rapid", 0.4, "--json"))["time"])
            self.assertEqual((time["feed_m_s"], time["rapid_m_s"]), (0.1, 0.4))
            self.assertRegex(self.fine("report", job), r"time +\d+\.\d s, ")

    def test_a_job_that_does_not_ask_is_not_timed(self):
        job = self.fine(*self.submit("--wait")).strip()
        self.assertNotIn("time", json.loads(self.fine("report", job, "--json")))

    def test_a_feed_that_cannot_be_kept_fails_the_job_and_leaves_its_plan(self):
        result = self.run_client(*self.submit("--feed", 0.4, "--keep-feed", 0.99, "--wait", robot="gantry"))
        self.assertEqual(result.returncode, 1)
        job = result.stdout.strip()
        error = json.loads(self.fine("status", job, "--json"))["error"]
        self.assertEqual(error["code"], "feed_not_kept")
        self.assertIn("keyframe", error["message"])
        report = json.loads(self.fine("report", job, "--json"))
        self.assertTrue(report["verify"]["clean"])
        self.assertLess(0, report["time"]["total_s"])
        self.assertLess(report["time"]["worst"][0]["feed_m_s"], 0.4)
        for self.client in (SCULPT, SCULPT_PY):
            fetched = self.run_client("fetch", job, "-o", f"plan{len(self.client)}.ndjson")
            self.assertEqual(fetched.returncode, 1)  # the job failed
            self.assertTrue((self.scratch / f"plan{len(self.client)}.ndjson").read_text().count('"end"'))

    def test_what_cannot_be_asked_for_is_refused_at_once(self):
        self.assertIn("thin tool", self.refused(4, "feed_invalid", *self.submit("--rapid", 0.1)))
        self.assertIn("above 0", self.refused(4, "feed_invalid", *self.submit("--feed", 0)))
        self.refused(4, "feed_invalid", *self.submit("--feed", 0.1, "--rapid", -1))
        self.assertIn("1 at most", self.refused(4, "feed_invalid", *self.submit("--feed", 0.1, "--keep-feed", 1.5)))
        cell = json.loads((SOURCE / "config/cells/panda-turntable.json").read_text())
        cell["urdf"] = str(SOURCE / "config/robots/panda-turntable.urdf")
        del cell["limits"]["joint4"]
        (self.scratch / "slack.json").write_text(json.dumps(cell))
        self.assertIn("joint4", self.refused(4, "limits_missing", *self.submit("--feed", 0.1, robot="./slack.json")))
        self.fine(*self.submit(robot="./slack.json"))


if __name__ == "__main__":
    unittest.main()
