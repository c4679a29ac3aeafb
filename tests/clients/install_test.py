"""What `cmake --install` puts where; and that it works there, away from the source tree."""

import os
import pathlib
import re
import subprocess
import unittest

import shapes
from harness import PATIENCE_S, ClientTest


class Install(ClientTest):
    def test_the_installed_programs_find_their_cells(self):
        build, root = pathlib.Path(os.environ["SCULPT_BUILD"]), self.scratch / "root"
        prefix = root / "opt/sculpt"
        subprocess.run(["cmake", "--install", build, "--prefix", "/opt/sculpt"], check=True, capture_output=True, timeout=PATIENCE_S,
                       env={**os.environ, "DESTDIR": str(root)})
        # Debian's packages and the Dockerfile have /etc, which is below no prefix.
        etc = re.search(r"(?m)^CMAKE_INSTALL_SYSCONFDIR:\w+=(.*)$", (build / "CMakeCache.txt").read_text())[1]
        settings = (root / etc[1:] if etc.startswith("/") else prefix / etc) / "sculptd/sculptd.json"
        for path in (settings, *(prefix / "share" / path for path in (
                "man/man1/sculpt.1", "man/man5/sculptd.json.5", "man/man8/sculptd.8", "bash-completion/completions/sculpt",
                "zsh/site-functions/_sculpt", "fish/vendor_completions.d/sculpt.fish"))):
            self.assertGreater(path.stat().st_size, 0, path)
        unit = (prefix / "lib/systemd/system/sculptd.service").read_text()
        self.assertRegex(unit, r"(?m)^ExecStart=/\S*/sculptd --config /\S*/sculptd/sculptd.json ")
        self.assertNotIn("@CMAKE", unit)

        env = {name: value for name, value in os.environ.items() if not name.startswith("SCULPT")}
        config = [prefix / "bin/sculptd", "config", "--config", settings]
        shown = subprocess.run(config, check=True, capture_output=True, text=True, cwd=self.scratch, env=env, timeout=PATIENCE_S).stdout
        self.assertIn(str(prefix / "share/sculptd/cells"), shown)
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())
        plan = [prefix / "bin/sculpt", "plan", mesh, "--resolution", "8", "--robot", "gantry", "-o", "ball.ndjson"]
        subprocess.run(plan, check=True, capture_output=True, cwd=self.scratch, env=env, timeout=PATIENCE_S)


if __name__ == "__main__":
    unittest.main()
