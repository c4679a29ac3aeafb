"""sculpt completion: the scripts offer what --help says; bash's is run."""

import re
import shutil
import subprocess
import unittest

from harness import PATIENCE_S, SCULPT, SOURCE, ClientTest, environment


class Completion(ClientTest):
    def options_in_help(self, *command):
        return set(re.findall(r"--[a-z][a-z-]*", self.fine(*command, "--help").split("Options:")[1].split("Exit codes")[0]))

    def complete(self, *words):
        """What bash offers with the cursor at the end of the last word."""
        line = " ".join(f"'{word}'" for word in (*SCULPT, *words))
        script = self.fine("completion", "bash") + f'\nCOMP_WORDS=({line}); COMP_CWORD={len(words)}; _sculpt; printf "%s\\n" "${{COMPREPLY[@]}}"'
        return set(subprocess.run(["bash", "-u", "-c", script], env=environment(), check=True, capture_output=True, text=True, timeout=PATIENCE_S).stdout.split())

    def test_bash_completes_commands_and_their_options(self):
        self.assertEqual(self.complete("wa"), {"watch", "wait"})
        self.assertLessEqual({"submit", "top", "--version"}, self.complete(""))
        for command in ("submit", "fetch", "plan", "top"):
            self.assertEqual({word for word in self.complete(command, "--")}, self.options_in_help(command))
        self.assertEqual(self.complete("--server", "localhost:1", "plan", "--res"), {"--resolution"})
        self.assertEqual(self.complete("verify", ""), set())  # files, by bash itself

    def test_bash_completes_what_options_and_commands_take(self):
        for command in ("plan", "submit"):
            self.assertEqual(self.complete(command, "a.stl", "--robot", "pan"), {"panda-turntable", "panda-turntable-6mm"})
            self.assertEqual(self.complete(command, "--search", ""), {"sweep", "octree", "voxel", "mill"})
        self.assertEqual(self.complete("fetch", "JOB", "--format", ""), {"ndjson", "binary", "csv", "tokens", "gzip", "binvox", "zip"})
        self.assertEqual(self.complete("fetch", "--artifact", "r"), {"residue", "report"})
        self.assertEqual(self.complete("queue", ""), {"pause", "resume"})
        self.assertEqual(self.complete("cell", ""), {"new", "gantry", "panda-turntable", "panda-turntable-6mm", "six-axis-turntable", "studio", "ur10e-plinth"})
        self.assertEqual(self.complete("cell", "new", "a.urdf", "--stock-"), {"--stock-at", "--stock-link", "--stock-size"})
        self.assertEqual(self.complete("cell", "new", "a.urdf", "--table", ""), {"turntable", "fixed"})
        self.assertEqual(self.complete("queue", "p"), {"pause"})
        self.assertEqual(self.complete("queue", "--js"), {"--json"})

    def test_zsh_and_fish_know_what_options_and_commands_take(self):
        zsh, fish = self.fine("completion", "zsh"), self.fine("completion", "fish")
        for script in (zsh, fish):
            for values in ("sweep octree voxel", "ndjson binary csv tokens gzip binvox zip", "trajectory timeline voxels stock surface residue report", "pause resume", "completion cells"):
                self.assertIn(values, script)

    def test_the_names_of_cells_are_asked_for(self):
        self.assertEqual(self.fine("completion", "cells").split(), sorted(cell.stem for cell in (SOURCE / "config/cells").glob("*.json")))

    def test_zsh_and_fish_know_the_same_words(self):
        for shell, option in (("zsh", "'{}:"), ("fish", "-l {} ")):
            script = self.fine("completion", shell)
            for word in self.options_in_help("plan"):
                self.assertIn(option.format(word if shell == "zsh" else word[2:]), script)
            if shutil.which(shell):
                subprocess.run([shell, "-n", "-c", script], check=True, timeout=PATIENCE_S)

    def test_it_is_for_packagers_and_knows_three_shells(self):
        self.assertNotIn("completion", self.fine("--help"))
        self.assertEqual(self.run_client("completion", "tcsh").returncode, 2)


if __name__ == "__main__":
    unittest.main()
