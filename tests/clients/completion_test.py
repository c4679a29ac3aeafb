"""sculpt completion: the scripts offer what --help says; bash's is run."""

import re
import shutil
import subprocess
import unittest

from harness import PATIENCE_S, ClientTest


class Completion(ClientTest):
    def options_in_help(self, *command):
        return set(re.findall(r"--[a-z][a-z-]*", self.fine(*command, "--help").split("Options:")[1].split("Exit codes")[0]))

    def complete(self, *words):
        """What bash offers with the cursor at the end of the last word."""
        line = " ".join(f"'{word}'" for word in ("sculpt", *words))
        script = self.fine("completion", "bash") + f'\nCOMP_WORDS=({line}); COMP_CWORD={len(words)}; _sculpt; printf "%s\\n" "${{COMPREPLY[@]}}"'
        return set(subprocess.run(["bash", "-eu", "-c", script], check=True, capture_output=True, text=True, timeout=PATIENCE_S).stdout.split())

    def test_bash_completes_commands_and_their_options(self):
        self.assertEqual(self.complete("wa"), {"watch", "wait"})
        self.assertLessEqual({"submit", "top", "--version"}, self.complete(""))
        for command in ("submit", "fetch", "plan", "top"):
            self.assertEqual({word for word in self.complete(command, "--")}, self.options_in_help(command))
        self.assertEqual(self.complete("--server", "localhost:1", "plan", "--res"), {"--resolution"})
        self.assertEqual(self.complete("verify", ""), set())  # files, by bash itself

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
