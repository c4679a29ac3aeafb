"""What `cmake --install` puts where; and that it works there, away from the source tree."""

import os
import subprocess
import unittest

import shapes
from harness import PATIENCE_S, ClientTest


class Install(ClientTest):
    def test_the_installed_programs_find_their_cells(self):
        prefix = self.scratch / "prefix"
        subprocess.run(["cmake", "--install", os.environ["SCULPT_BUILD"], "--prefix", prefix], check=True, capture_output=True, timeout=PATIENCE_S)
        for path in ("share/man/man1/sculpt.1", "share/man/man5/sculptd.json.5", "share/man/man8/sculptd.8", "etc/sculptd/sculptd.json",
                     "share/bash-completion/completions/sculpt", "share/zsh/site-functions/_sculpt", "share/fish/vendor_completions.d/sculpt.fish"):
            self.assertGreater((prefix / path).stat().st_size, 0, path)
        unit = (prefix / "lib/systemd/system/sculptd.service").read_text()
        self.assertRegex(unit, r"(?m)^ExecStart=/\S*/sculptd --config /\S*/sculptd/sculptd.json ")
        self.assertNotIn("@CMAKE", unit)

        env = {name: value for name, value in os.environ.items() if not name.startswith("SCULPT")}
        config = [prefix / "bin/sculptd", "config", "--config", prefix / "etc/sculptd/sculptd.json"]
        shown = subprocess.run(config, check=True, capture_output=True, text=True, cwd=self.scratch, env=env, timeout=PATIENCE_S).stdout
        self.assertIn(str(prefix / "share/sculptd/cells"), shown)
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        plan = [prefix / "bin/sculpt", "plan", mesh, "--resolution", "8", "--robot", "gantry", "-o", "ball.ndjson"]
        subprocess.run(plan, check=True, capture_output=True, cwd=self.scratch, env=env, timeout=PATIENCE_S)


if __name__ == "__main__":
    unittest.main()
