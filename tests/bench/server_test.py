"""bench/server: a short run adds up, and what cannot be measured is refused."""

import json
import os
import subprocess
import sys
import unittest

from harness import PATIENCE_S, SOURCE, environment


class Server(unittest.TestCase):
    def run_bench(self, *options):
        return subprocess.run([sys.executable, "-B", str(SOURCE / "bench/server"), "--sculptd", os.environ["SCULPTD"], *options],
                              env=environment(), capture_output=True, text=True, timeout=PATIENCE_S)

    def test_a_short_run_asks_for_what_it_says(self):
        ended = self.run_bench("--connections", "20", "--polls", "40", "--submits", "4", "--downloads", "2", "--megabytes", "5", "--seconds", "2",
                               "--queued", "3000")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        figures = json.loads(ended.stdout)
        self.assertAlmostEqual(figures["status"]["count"], 80, delta=20)
        self.assertAlmostEqual(figures["submit"]["count"], 8, delta=2)
        self.assertGreater(figures["download_mb_per_s"], 0)
        self.assertEqual(figures["long_queue"]["queued"], 3000)
        self.assertGreater(figures["long_queue"]["page"]["count"], 3)
        self.assertEqual(figures["errors"], 0)

    def test_too_few_connections_are_refused(self):
        ended = self.run_bench("--connections", "20", "--downloads", "10")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("give at least 22", ended.stderr)


if __name__ == "__main__":
    unittest.main()
