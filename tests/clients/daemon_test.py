"""sculptd as its operator meets it: settings on the command line, signals, service managers."""

import json
import os
import subprocess
import unittest

from harness import PATIENCE_S, ClientTest, environment


class Config(ClientTest):
    client = [os.environ["SCULPTD"]]

    def test_config_shows_every_value_and_where_it_is_from(self):
        file = self.scratch / "server.json"
        file.write_text('{"stall_s": 7, "log": "warn"}')
        shown = json.loads(self.fine("config", "--json", "--config", file, "--log", "debug"))["settings"]
        values = {row["name"]: (row["value"], row["from"]) for row in shown}
        self.assertEqual(values["stall_s"], (7, "file"))
        self.assertEqual(values["log"], ("debug", "flag"))
        self.assertEqual(values["workers"], (0, "default"))
        self.assertIn("stall_s            7", self.fine("--config", file, "config"))

    def test_the_environment_stands_between_file_and_flags(self):
        env = {**environment(), "SCULPTD_STALL_S": "8"}
        result = subprocess.run([*self.client, "config", "--json"], env=env, capture_output=True, text=True, timeout=PATIENCE_S)
        values = {row["name"]: (row["value"], row["from"]) for row in json.loads(result.stdout)["settings"]}
        self.assertEqual(values["stall_s"], (8, "environment"))

    def test_mistakes_end_it_with_the_exit_code_that_says_whose(self):
        file = self.scratch / "server.json"
        file.write_text('{"stal_s": 7}')
        result = self.run_client("config", "--config", file)
        self.assertEqual(result.returncode, 78)
        self.assertIn("/stal_s is not known; the nearest setting is stall_s;", result.stderr)
        result = self.run_client("--workers", "many")
        self.assertEqual(result.returncode, 2)
        self.assertIn("workers must be a number", result.stderr)


if __name__ == "__main__":
    unittest.main()
