"""scripts/long-lines notices a line that is too long, and lets off what cannot be broken."""

import os
import pathlib
import subprocess
import tempfile
import unittest

LONG_LINES = pathlib.Path(os.environ["SCULPT_SOURCE"]) / "scripts/long-lines"
WORDS = "word " * 23  # 115 columns


class LongLines(unittest.TestCase):
    def check(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "page.md"
            file.write_text(text)
            done = subprocess.run([LONG_LINES, file], capture_output=True, text=True)
            return done.returncode, [line.split(":")[1] for line in done.stdout.splitlines()]

    def test_a_line_of_119_columns_is_fine_and_one_of_120_is_not(self):
        self.assertEqual(self.check(WORDS + "1234\n"), (0, []))
        self.assertEqual(self.check("\n" + WORDS + "12345\n"), (1, ["2"]))

    def test_columns_are_counted_not_bytes(self):
        self.assertEqual(self.check(WORDS + "éééé\n"), (0, []))

    def test_code_is_no_excuse(self):
        self.assertEqual(self.check(f"```\n{WORDS}12345\n```\n"), (1, ["2"]))

    def test_tables_sessions_and_links_are_let_off(self):
        self.assertEqual(self.check(f"| {WORDS} | {WORDS} |\n"), (0, []))
        self.assertEqual(self.check(f"```session\nC {WORDS}12345\n```\n"), (0, []))
        self.assertEqual(self.check(f"{WORDS}[page](https://example.org/{'a' * 60})\n"), (0, []))

    def test_after_a_session_lines_are_looked_at_again(self):
        self.assertEqual(self.check(f"```session\nC {WORDS}12345\n```\n{WORDS}12345\n"), (1, ["4"]))


if __name__ == "__main__":
    unittest.main()
