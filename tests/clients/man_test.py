"""The man pages say what --help says."""

import json
import os
import re
import shutil
import subprocess
import unittest

from harness import PATIENCE_S, SCULPT, SOURCE, ClientTest

PAGES = SOURCE / "docs/man"


def read(page):
    return (PAGES / page).read_text()


def options_of(page):
    return set(re.findall(r"Fl (-[a-z][a-z-]*)", page))


class Man(ClientTest):
    def help(self, *command):
        return subprocess.run([*command, "--help"], check=True, capture_output=True, text=True, timeout=PATIENCE_S).stdout

    def options(self, *command):
        return set(re.findall(r"^  (?:-[a-z],)?-(-[a-z][a-z-]*)", self.help(*command), re.M))

    def test_sculpt_has_every_command_and_option_and_no_other(self):
        page = read("sculpt.1")
        commands = re.findall(r"^  (\w+)", self.help(*SCULPT).partition("Subcommands:")[2].partition("\n\n")[0], re.M)
        self.assertGreater(len(commands), 10)
        told = set()
        for command in commands:
            self.assertRegex(page, rf"(?m)^\.Ss {command}\b")
            told |= self.options(*SCULPT, command)
            for inner in re.findall(r"^  (\w+)", self.help(*SCULPT, command).partition("Subcommands:")[2], re.M):
                self.assertRegex(page, rf"(?m)^\.Ss {command} {inner}\b")
                told |= self.options(*SCULPT, command, inner)
        self.assertEqual(options_of(page), told)

    def test_sculptd_has_the_options_that_are_no_settings(self):
        settings = {row["flag"][1:] for row in self.settings()}
        told = self.options(os.environ["SCULPTD"]) | set().union(*(self.options(os.environ["SCULPTD"], verb) for verb in ("config", "fsck", "adopt", "migrate")))
        self.assertLessEqual(told - settings, options_of(read("sculptd.8")))
        self.assertLessEqual(options_of(read("sculptd.8")), told)

    def settings(self):
        shown = subprocess.run([os.environ["SCULPTD"], "config", "--json"], check=True, capture_output=True, text=True, timeout=PATIENCE_S)
        return json.loads(shown.stdout)["settings"]

    def test_every_setting_has_its_entry(self):
        page = read("sculptd.json.5")
        for row in self.settings():
            entry = ".It Cm {} Pq {}{}\n{}\n".format(row["name"], row["type"], "; reload" if row["reload"] else "", row["help"])
            self.assertIn(entry, page)

    @unittest.skipUnless(shutil.which("groff"), "no groff")
    def test_they_are_good_mdoc(self):
        for page in PAGES.iterdir():
            result = subprocess.run(["groff", "-mdoc", "-Tutf8", "-ww", "-z", page], capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual((result.returncode, result.stderr), (0, ""), page.name)


if __name__ == "__main__":
    unittest.main()
