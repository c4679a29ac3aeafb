"""sculpt program: a plan in the languages of controllers."""

import json
import pathlib
import re
import shutil
import subprocess
import unittest

from harness import SOURCE, ClientTest, shared_data


class Program(ClientTest):
    def plan(self, cell):
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", cell, "-o", "bust.sct")

    def program(self, dialect, *options):
        report = json.loads(self.fine("program", "bust.sct", "--dialect", dialect, "--feed", 0.05, "--json", *options, "-o", dialect))
        return report, pathlib.Path(self.scratch) / dialect

    def test_each_dialect_of_a_six_axis_arm(self):
        self.plan("six-axis-turntable")
        for dialect, files in (("krl", 2), ("rapid", 1), ("fanuc", 1)):
            report, folder = self.program(dialect, "--part-keyframes", 100)
            self.assertGreater(report["parts"], 2)
            self.assertEqual(report["files"], files * (report["parts"] + 1))
            self.assertEqual(len(list(folder.iterdir())), report["files"])
            self.assertEqual(sum(path.stat().st_size for path in folder.iterdir()), report["bytes"])
            for path in folder.iterdir():
                self.assertNotIn(b"\n", path.read_bytes().replace(b"\r\n", b""))
        self.refused(4, "axes_unfit", "program", "bust.sct", "--dialect", "urscript", "--feed", 0.05, "-o", "ur")

    def test_stock_files_and_counts_of_voxels(self):
        self.plan("six-axis-turntable")
        report, folder = self.program("krl", "--part-keyframes", 100, "--stock-files")
        self.assertEqual(report["files"], 3 * report["parts"] + 2)
        removed = 0
        for part in range(1, report["parts"] + 1):
            self.assertTrue((folder / f"krl_{part:04}.binvox").read_bytes().startswith(b"#binvox 1"))
            before, after = map(int, re.findall(r"; VOXELS CUT (?:BEFORE|AFTER) (\d+)", (folder / f"krl_{part:04}.src").read_text()))
            self.assertEqual(before, removed)
            removed = after
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 8, "--robot", "six-axis-turntable", "-o", "bust.ndjson")
        self.assertEqual(removed, json.loads((self.scratch / "bust.ndjson").read_text().splitlines()[-1])["removed"])

    def test_parts_of_so_many_bytes(self):
        self.plan("six-axis-turntable")
        for dialect, limit in (("krl", 30000), ("rapid", 20000), ("fanuc", 30000)):
            report, folder = self.program(dialect, "--part-bytes", limit)
            self.assertGreater(report["parts"], 2)
            for part in range(1, report["parts"] + 1):
                self.assertLessEqual(sum(path.stat().st_size for path in folder.glob(f"{dialect}_{part:04}.*")), limit)
            self.assertIn("--part-bytes", self.refused(4, "part_invalid", "program", "bust.sct", "--dialect", dialect, "--feed", 0.05,
                                                       "--part-bytes", 1000, "-o", "small"))

    def test_digits_that_are_enough_where_the_tool_is_looked_at_closely(self):
        self.fine("plan", shared_data(self, "meshes/david.stl"), "--resolution", 16, "--robot", "six-axis-turntable", "-o", "bust.sct")
        report, _ = self.program("fanuc")
        self.assertEqual(report["moves"], 2047)

    def test_other_digits_where_the_nearest_ones_are_too_coarse(self):
        self.fine("plan", SOURCE / "config/samples/bust.stl", "--resolution", 32, "--robot", "six-axis-turntable", "-o", "bust.sct")
        report, _ = self.program("fanuc", "--part-keyframes", 1000)  # seams too
        self.assertGreater(report["parts"], 2)

    def test_a_universal_robot_and_ros(self):
        self.plan("ur10e-plinth")
        report, folder = self.program("urscript")
        self.assertEqual(report["parts"], len(list(folder.glob("*.script"))))
        report, folder = self.program("ros2")
        self.assertEqual((folder / "ros2.yaml").read_text().count("time_from_start"), report["moves"])
        self.refused(4, "part_invalid", "program", "bust.sct", "--dialect", "ros2", "--feed", 0.05, "--part-keyframes", 5, "-o", "r")
        self.refused(2, "usage", "program", "bust.sct", "--dialect", "apt", "--feed", 0.05, "-o", "r")
        self.refused(4, "name_invalid", "program", "bust.sct", "--dialect", "urscript", "--feed", 0.05, "-o", "No-Name")

    @unittest.skipUnless(shutil.which("rs274"), "no rs274: install linuxcnc-uspace to have LinuxCNC read the G-code")
    def test_linuxcnc_reads_its_program(self):
        self.plan("gantry")
        report, folder = self.program("gcode")
        text = (folder / "gcode_0001.ngc").read_text()
        alone = pathlib.Path(self.scratch) / "alone.ngc"
        alone.write_text("\n".join(line for line in text.splitlines() if line.startswith(("G1", "G93", "G94", "G21", "M2"))) + "\n")
        read = subprocess.run(["rs274", "-g", str(alone)], capture_output=True, text=True, timeout=60)
        self.assertEqual(read.returncode, 0, read.stderr)
        self.assertEqual(read.stdout.count("STRAIGHT_FEED"), report["moves"])


if __name__ == "__main__":
    unittest.main()
