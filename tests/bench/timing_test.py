"""bench/timing: all of it runs on a small plan, and what it says adds up."""

import os
import subprocess
import sys
import unittest

from harness import PATIENCE_S, SOURCE, environment

DIALECTS = {"krl", "rapid", "fanuc", "urscript", "gcode", "ros2"}


class Timing(unittest.TestCase):
    def run_bench(self, *options):
        return subprocess.run([sys.executable, "-B", str(SOURCE / "bench/timing"), "--sculpt", os.environ["SCULPT"], "--sculptd", os.environ["SCULPTD"],
                               *options], env=environment(), capture_output=True, text=True, timeout=PATIENCE_S)

    def test_laws_programs_and_samples_are_measured(self):
        ended = self.run_bench("--mesh", str(SOURCE / "config/samples/bust.stl"), "--resolution", "16")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        laws, programs, samples = ([[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[2:]]
                                   for table in ended.stdout.strip().split("\n\n"))
        self.assertEqual([row[2] for row in laws], ["20", "50", "200"])
        seconds = [float(row[3]) for row in laws]
        self.assertEqual(seconds, sorted(seconds, reverse=True), "the faster the feed the sooner it ends")
        self.assertTrue(all(float(row[4]) >= 1 for row in laws), laws)
        self.assertEqual({row[0] for row in programs}, DIALECTS)
        self.assertGreater(sum(row[2] != "-" for row in programs), 3, programs)
        self.assertGreater(float(samples[0][3]), 0)

    def test_a_program_that_is_not_there_is_refused(self):
        ended = self.run_bench("--sculptd", "/nowhere/sculptd")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("/nowhere/sculptd", ended.stderr)


if __name__ == "__main__":
    unittest.main()
