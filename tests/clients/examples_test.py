"""The programs of clients/examples do what their first lines say."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

import shapes
from harness import PATIENCE_S, SOURCE, DaemonTest

EXAMPLES = SOURCE / "clients/examples"
PROGRAMS = pathlib.Path(os.environ["SCULPT_BUILD"]) / "bin"


class Examples(DaemonTest):
    def run_example(self, name, *arguments):
        program = [sys.executable, "-B", EXAMPLES / name] if name.endswith(".py") else [PROGRAMS / name]
        run = subprocess.run([*program, self.daemon.address, *arguments], capture_output=True, text=True, cwd=self.scratch, timeout=PATIENCE_S)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def setUp(self):
        super().setUp()
        self.mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())

    def last_job(self):
        return json.loads(self.fine("list", "--json"))["jobs"][-1]["job"]

    def test_plan(self):
        for program in ("01_plan", "01_plan.py"):
            with self.subTest(program):
                self.assertIn("removed 1536 of 1536 voxels", self.run_example(program, self.mesh, "plan.ndjson"))
                self.assertEqual(json.loads((self.scratch / "plan.ndjson").read_text().splitlines()[-1])["removed"], 1536)
        self.assertEqual(len(json.loads(self.fine("list", "--json"))["jobs"]), 1)  # the same key: one job

    def test_watch_and_read(self):
        self.run_example("01_plan", self.mesh, "plan.ndjson")
        lines = [json.loads(line)["type"] for line in (self.scratch / "plan.ndjson").read_text().splitlines()]
        cuts, moves = lines.count("cut"), lines.count("move")
        for program in ("02_watch", "02_watch.py"):
            self.assertRegex(self.run_example(program, self.last_job()), r"(?m)^\d+ succeeded$")
        self.assertEqual(self.run_example("03_stream", self.last_job()), f"{cuts} cuts, {moves} moves, whole\n")
        self.assertEqual(self.run_example("03_keyframes.py", self.last_job()), f"{cuts} cuts, {moves} moves\n")

    def test_each_is_named_in_the_readme_and_run(self):
        here = pathlib.Path(__file__).read_text()
        for file in EXAMPLES.glob("0*"):
            self.assertIn(f"`{file.name}`", (EXAMPLES / "README.md").read_text())
            self.assertRegex(here, rf'"{re.escape(file.name.removesuffix(".cpp"))}"')


if __name__ == "__main__":
    unittest.main()
