"""A daemon that is stopped while a milled job runs: the job goes on with the tool that was put in last."""

import json
import time
import unittest

import shapes
from harness import PATIENCE_S, ClientTest, Daemon
from mill import milled


class Stopped(ClientTest):
    def setUp(self):
        super().setUp()
        self.data = self.scratch / "data"
        self.cell = milled.write_cell(self.scratch)
        self.mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))

    def submit(self, *options):
        return self.fine("submit", self.mesh, "--resolution", 16, "--robot", self.cell, "--tools", "D20,D12", "--tolerance", 0.0005, *options).split()[0]

    def report(self, job):
        report = json.loads(self.fine("report", job, "--json"))
        return {name: value for name, value in report.items() if name not in ("job", "seconds", "peak_memory_bytes")}

    def test_a_job_that_is_stopped_goes_on_with_its_tool(self):
        daemon = Daemon(self.data, "--workers", "1")
        self.server = daemon.address
        expected = self.report(self.submit("--wait"))
        job = self.submit()
        trajectory = self.data / "jobs" / job / "trajectory.ndjson"
        end = time.monotonic() + PATIENCE_S
        while not (trajectory.exists() and b'"type":"cut"' in trajectory.read_bytes().partition(b'"type":"tool"')[2]):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        self.assertEqual(daemon.stop(), 0)
        checkpoint = json.loads((trajectory.parent / "checkpoint-0").read_text().splitlines()[1])
        self.assertEqual([tool["name"] for tool in checkpoint["milling"]["tools"]], ["D20", "D12"])
        with Daemon(self.data, "--workers", "1") as daemon:
            self.server = daemon.address
            self.fine("wait", job)
            self.assertEqual(self.report(job), expected)
            self.assertEqual(json.loads(self.fine("status", job, "--json"))["attempt"], 2)


if __name__ == "__main__":
    unittest.main()
