"""bench/page: a short run adds up, and what cannot be measured is refused."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from harness import PATIENCE_S, SOURCE, environment

sys.path.insert(0, str(SOURCE / "tests/web"))
import browser  # noqa: E402


class Page(unittest.TestCase):
    def run_bench(self, *options):
        return subprocess.run([sys.executable, "-B", str(SOURCE / "bench/page"), "--sculptd", os.environ["SCULPTD"], *options],
                              env=environment(), capture_output=True, text=True, timeout=PATIENCE_S)

    def test_a_short_run_has_each_row(self):
        browser.find_chromium()
        with tempfile.TemporaryDirectory(prefix="sculpt-test-") as folder:
            file = pathlib.Path(folder) / "page.json"
            ended = self.run_bench("--rows", "first,seek,play,memory", "--resolutions", "16", "--runs", "1", "--json", str(file))
            self.assertEqual(ended.returncode, 0, ended.stderr)
            figures = json.loads(file.read_text())
        self.assertEqual(set(figures), {"first", "again", "seek", "play", "memory"})
        self.assertGreater(figures["first"]["16"]["bytes"], 200_000)
        self.assertLess(figures["again"]["16"]["bytes"], figures["first"]["16"]["bytes"])
        self.assertEqual((figures["seek"]["16"]["count"], figures["play"]["16"]["count"]), (40, 360))
        self.assertIn("| seek | 16^3 |", ended.stdout)

    def test_a_row_that_is_none_is_refused(self):
        ended = self.run_bench("--rows", "first,last")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("there is no row last", ended.stderr)


if __name__ == "__main__":
    unittest.main()
