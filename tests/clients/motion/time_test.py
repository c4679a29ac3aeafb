"""sculpt time: how long a plan takes on its robot."""

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
        faster = json.loads(self.fine("time", "bust.sct", "--robot", "panda-turntable", "--feed", 0.2, "--json"))["time"]
        self.assertLess(faster["total_s"], time["total_s"])
        self.assertRegex(self.fine("time", "bust.sct", "--feed", 0.05), r"^\d+:\d\d:\d\d h ")

    def test_what_cannot_be_timed_is_refused(self):
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", "gantry", "-o", "bust.ndjson")
        self.refused(2, "usage", "time", "bust.ndjson")
        self.assertIn("above 0", self.refused(4, "feed_invalid", "time", "bust.ndjson", "--feed", 0))
        self.assertIn("--robot", self.refused(4, "cell_mismatch", "time", "bust.ndjson", "--feed", 0.1, "--robot", "panda-turntable"))
        self.assertIn("keyframe", self.refused(4, "feed_not_kept", "time", "bust.ndjson", "--feed", 0.4, "--keep-feed", 0.99))
        text = (pathlib.Path(self.scratch) / "bust.ndjson").read_text().splitlines(keepends=True)
        (pathlib.Path(self.scratch) / "cut.ndjson").write_text("".join(text[:-1]))
        self.refused(4, "trajectory_invalid", "time", "cut.ndjson", "--feed", 0.1)


if __name__ == "__main__":
    unittest.main()
