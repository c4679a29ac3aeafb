"""What the tests of bench/cells and bench/planner share: a stand-in for `sculpt plan`, and running the program to its end."""

import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from harness import PATIENCE_S, SOURCE, environment

# A report by its arguments. What differs from test to test stands in `calls` (words for a line of the file CALLS), in
# `report`, and in the file CHANGES: by the keys that `keys` gives, what is changed of the report. The changes "sleep"
# and "replay" take that many seconds, "refuse" prints its words and makes no plan.
PLANNER = """#!{python}
import json, pathlib, sys, time
option = lambda name: sys.argv[sys.argv.index(name) + 1]
size, threads, mesh = int(option("--resolution")), int(option("--threads")), pathlib.Path(sys.argv[2]).stem
what = {what}
calls = pathlib.Path({calls!r})
with calls.open("a") as out:
    out.write(f"{{mesh}} {{what}} {{size}} {{threads}}\\n")
run = calls.read_text().count(f" {{what}} {{size}} {{threads}}\\n")
pathlib.Path(option("-o")).write_bytes(b"x" * size)
report = {{"voxels": {{"remove": 1000, "removed": 990, "residue": 10}}, "residue": [{{"reason": "enclosed", "voxels": 10}}], "threads": threads,
          "peak_memory_bytes": 300 << 20, "plan_sha256": what + "-plan-of-any-number-of-threads", "verify": {{"clean": True, "collisions": 0}}, {report}}}
changes = json.loads(pathlib.Path({changes!r}).read_text())
for key in ({keys}):
    for name, value in changes.get(key, {{}}).items():
        if name == "replay":
            print("plan 9/9\\nverify 0/9", file=sys.stderr, flush=True)
        if name in ("sleep", "replay"):
            time.sleep(value)
        if name == "refuse":
            sys.exit(f"sculpt: {{value}}")
        report[name] = {{**report[name], **value}} if isinstance(value, dict) and value else value
print(json.dumps(report))
sys.exit(0 if report["verify"]["clean"] else 1)
"""


class BenchTest(unittest.TestCase):
    """A program of bench/ with the stand-in, in a folder of its own. Each program says what the stand-in does:"""

    name = None    # of the program
    what = None    # Python, for the stand-in: what is measured
    report = None  # fields of its report
    keys = None    # those of CHANGES that count for a run

    @classmethod
    def load_program(cls):
        folder = str(SOURCE / "bench")
        if folder not in sys.path:
            sys.path.insert(0, folder)  # as Python does for the program itself
        loader = importlib.machinery.SourceFileLoader(cls.name, f"{folder}/{cls.name}")
        module = importlib.util.module_from_spec(importlib.util.spec_from_loader(cls.name, loader))
        loader.exec_module(module)
        return module

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        self.addCleanup(folder.cleanup)
        self.scratch = pathlib.Path(folder.name)
        self.out, self.calls, self.changes = self.scratch / "out", self.scratch / "calls", self.scratch / "changes"
        self.shared, self.program = self.scratch / "shared", self.scratch / "sculpt"
        self.program.write_text(PLANNER.format(python=sys.executable, what=self.what, report=self.report, keys=self.keys,
                                               calls=str(self.calls), changes=str(self.changes)))
        self.program.chmod(0o755)
        self.change({})

    def add_david(self):
        (self.shared / "meshes").mkdir(parents=True)
        (self.shared / "meshes/david.stl").write_text("stands in for David")

    def change(self, changes):
        self.changes.write_text(json.dumps(changes))

    def run_program(self, *options, program=None):
        command = [sys.executable, "-B", SOURCE / "bench" / self.name, "--sculpt", program or self.program, "--out", self.out, *options]
        return subprocess.run([str(word) for word in command], env={**environment(), "SCULPT_SHARED_DATA": str(self.shared)},
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S)

    def fine(self, *options, **named):
        result = self.run_program(*options, **named)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def fault(self, words, *options):
        result = self.run_program(*options)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn(words, result.stderr)
        self.assertTrue(any(words in fault for fault in self.document()["faults"]))
        self.assertIn(f"**Faults**\n\n- {self.document()['faults'][0]}\n", self.page())

    def refused(self, words, *options, **named):
        result = self.run_program(*options, **named)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertRegex(result.stderr, rf"\Abench/{self.name}: .*\n\Z")
        for word in words:
            self.assertIn(word, result.stderr)

    def document(self):
        return json.loads((self.out / f"{self.name}.json").read_text())

    def page(self):
        return (self.out / f"{self.name}.md").read_text()

    def called(self):
        return sorted(set(self.calls.read_text().splitlines()))
