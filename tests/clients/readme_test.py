"""README's first session: its commands are run, and what they print is what it shows."""

import os
import pathlib
import re
import subprocess
import unittest

from harness import PATIENCE_S, SCULPT, SOURCE, ClientTest, Daemon, environment

BY_CHANCE = r"(?:queued|running|(?:load|voxelize|octree|plan|verify|write) \d+/\d+)$"  # what is told while it runs
JOB = re.compile(r"\b[0-9A-HJKMNP-TV-Z]{26}\b")


def commands():
    """Each command of the session with the lines shown below it."""
    session = (SOURCE / "README.md").read_text().partition("## A first session by hand")[2].partition("\n## ")[0]
    found = []
    for block in re.findall(r"^```\n(\$ .*?)^```$", session, re.M | re.S):
        for line in block.splitlines():
            if line.startswith("$ "):
                found.append((line[2:], []))
            else:
                found[-1][1].append(line)
    return found


def plain(lines):
    """Without what the clock, the machine's arithmetic or chance decide."""
    text = "\n".join(line for line in lines if not re.match(BY_CHANCE, line))
    text = re.sub(r"\b[0-9a-f]{64}\b", "HASH", JOB.sub("JOB", text))
    text = re.sub(r"(?m)^(keyframes +)\d+", r"\1N", re.sub(r"-?\b\d+\.\d+(?:e-?\d+)?\b(?!\.)", "0.0", text))
    return text.splitlines()


def missing(shown, printed):
    """The first part of what is shown, between lines of dots, that was not printed in its place."""
    rest = "\n".join(plain(printed)) + "\n"
    for part in re.split(r"(?m)^\.\.\.$\n?", "\n".join(plain(shown)) + "\n"):
        found = rest.find(part)
        if found < 0:
            return part
        rest = rest[found + len(part):]
    return None


class Readme(ClientTest):
    def test_the_first_session_is_as_printed(self):
        (self.scratch / "config").symlink_to(SOURCE / "config")
        daemon = Daemon(self.scratch / "data")
        self.addCleanup(daemon.stop)
        env = {**environment(daemon.address), "PATH": f"{pathlib.Path(SCULPT[0]).parent}:{os.environ['PATH']}"}
        jobs = {}
        run = 0
        for command, shown in commands():
            with self.subTest(command=command):
                if command.startswith("sculptd "):
                    self.assertRegex(shown[0].replace("127.0.0.1:7878", daemon.address), r"\Asculptd \S+ listening on " + daemon.address + r"\Z")
                    self.assertIn(shown[0].replace("127.0.0.1:7878", daemon.address), daemon.log())
                    continue
                ours = JOB.sub(lambda job: jobs.get(job[0], job[0]), command)
                done = subprocess.run(["bash", "-c", ours], cwd=self.scratch, env=env, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S)
                self.assertEqual(done.returncode, 0, done.stderr)
                printed = done.stdout.splitlines()
                if command.startswith("sculpt submit "):
                    jobs[shown[0]] = printed[0]
                if shown:
                    self.assertIsNone(missing(shown, printed + done.stderr.splitlines()), done.stdout + done.stderr)
                run += 1
        self.assertGreaterEqual(run, 7)


if __name__ == "__main__":
    unittest.main()
