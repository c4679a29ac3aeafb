"""sculpt time and sample: how long a plan takes on its robot, and where the joints are when."""

import csv
import json
import pathlib
import unittest

from harness import SOURCE, ClientTest


class Time(ClientTest):
    """How long a plan takes."""

    def test_a_plan_is_timed_and_its_law_written(self):
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 16, "--robot", "panda-turntable", "-o", "bust.sct")
        time = json.loads(self.fine("time", "bust.sct", "--feed", 0.05, "--json", "-o", "bust.law"))["time"]
        self.assertGreater(time["total_s"], 500)
        by = time["by"]
        parts = [by["feed"], by["rapid"], *by["velocity"].values(), *by["acceleration"].values(), *by["jerk"].values()]
        self.assertAlmostEqual(sum(parts) + time["window_s"], time["total_s"], places=3)
        self.assertLess(1, time["ratio"])
        self.assertLessEqual(len(time["worst"]), 10)
        for place in time["worst"]:
            self.assertLess(place["feed_m_s"], 0.05)
            self.assertIn(place["joint"], by["velocity"])
        self.assertEqual((pathlib.Path(self.scratch) / "bust.law").stat().st_size, 8 + 8 + 12 + 24 + 8 * 8 + 16 * time["keyframes"] + 64)
        check = json.loads(self.fine("time", "bust.sct", "--feed", 0.05, "--json", "--check"))["check"]
        self.assertTrue(check["clean"])
        self.assertLessEqual(check["jerk"], 1)
        faster = json.loads(self.fine("time", "bust.sct", "--robot", "panda-turntable", "--feed", 0.2, "--json"))["time"]
        self.assertLess(faster["total_s"], time["total_s"])
        self.assertRegex(self.fine("time", "bust.sct", "--feed", 0.05), r"^\d+:\d\d:\d\d h ")

    def test_a_plan_with_milling_tools_has_a_feed_of_its_own(self):
        cell = json.loads((SOURCE / "config/cells/studio.json").read_text())
        cell["urdf"] = str(SOURCE / "config/robots/studio.urdf")
        cell["stock"].update(size_m=0.05, origin_m=[-0.025, -0.025, 0.3])
        (pathlib.Path(self.scratch) / "small.json").write_text(json.dumps(cell))
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", "./small.json", "--tools", "D20,D12",
                  "--tolerance", 0.001, "-o", "bust.sct")
        time = json.loads(self.fine("time", "bust.sct", "--robot", "./small.json", "--json", "--check"))
        self.assertTrue(time["check"]["clean"])
        self.assertLess(0, time["check"]["cutter_m"])
        time = time["time"]
        self.assertEqual([tool["name"] for tool in time["tools"]], ["D20", "D12"])
        self.assertAlmostEqual(sum(tool["seconds"] for tool in time["tools"]) + time["window_s"], time["total_s"], places=3)
        slower = json.loads(self.fine("time", "bust.sct", "--robot", "./small.json", "--feed", 0.01, "--json"))["time"]
        self.assertGreater(slower["total_s"], time["total_s"])
        self.fine("program", "bust.sct", "--robot", "./small.json", "--dialect", "krl", "-o", "bust")
        self.assertIn("MOUNT TOOL 2 D12", "".join(path.read_text() for path in (pathlib.Path(self.scratch) / "bust").iterdir()))

    def test_what_cannot_be_timed_is_refused(self):
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", "gantry", "-o", "bust.ndjson")
        self.refused(2, "usage", "time", "bust.ndjson")
        self.assertIn("fetch", self.refused(2, "usage", "time", "some-job", "--feed", 0.1, "--check"))
        self.assertIn("above 0", self.refused(4, "feed_invalid", "time", "bust.ndjson", "--feed", 0))
        self.assertIn("--robot", self.refused(4, "cell_mismatch", "time", "bust.ndjson", "--feed", 0.1, "--robot", "panda-turntable"))
        self.assertIn("keyframe", self.refused(4, "feed_not_kept", "time", "bust.ndjson", "--feed", 0.4, "--keep-feed", 0.99))
        text = (pathlib.Path(self.scratch) / "bust.ndjson").read_text().splitlines(keepends=True)
        (pathlib.Path(self.scratch) / "cut.ndjson").write_text("".join(text[:-1]))
        self.refused(4, "trajectory_invalid", "time", "cut.ndjson", "--feed", 0.1)


class Sample(ClientTest):
    """Where the joints are at fixed times."""

    def rows(self, *options):
        self.fine("sample", "bust.sct", "--feed", 0.1, *options, "-o", "samples.csv")
        with open(pathlib.Path(self.scratch) / "samples.csv") as table:
            return list(csv.DictReader(table))

    def test_samples_begin_and_end_at_rest_and_are_those_of_any_window(self):
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", "panda-turntable", "-o", "bust.sct")
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", "panda-turntable", "-o", "bust.ndjson")
        plan = [json.loads(line) for line in (pathlib.Path(self.scratch) / "bust.ndjson").read_text().splitlines()]
        joints = plan[0]["joints"]
        all_of_it = self.rows("--rate", 100)
        self.assertEqual(list(all_of_it[0]), ["t", *joints, *(joint + "_velocity" for joint in joints)])
        for row, q in ((all_of_it[0], plan[0]["home"]), (all_of_it[-1], plan[-2]["q"])):
            for joint, value in zip(joints, q):
                self.assertAlmostEqual(float(row[joint]), value, places=8)
                self.assertEqual(float(row[joint + "_velocity"]), 0)
        total = json.loads(self.fine("time", "bust.sct", "--feed", 0.1, "--json"))["time"]["total_s"]
        self.assertAlmostEqual(float(all_of_it[-1]["t"]), total, delta=0.011)
        for row, after in zip(all_of_it, all_of_it[1:]):
            for joint in joints:
                mean = (float(after[joint]) - float(row[joint])) * 100
                self.assertLess(abs(mean), 2.7)
        window = self.rows("--rate", 100, "--from", 12.5, "--to", 20)
        self.assertEqual(window, all_of_it[1250:2001])

    def test_windows_that_hold_nothing_are_refused(self):
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", "gantry", "-o", "bust.sct")
        self.refused(4, "window_empty", "sample", "bust.sct", "--feed", 0.1, "--rate", 10, "--from", 1e6, "-o", "x.csv")
        self.refused(2, "usage", "sample", "bust.sct", "--feed", 0.1, "--rate", 0, "-o", "x.csv")


if __name__ == "__main__":
    unittest.main()
