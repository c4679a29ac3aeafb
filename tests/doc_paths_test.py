"""doc_paths.py notices a name that leads nowhere."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("doc_paths.py")


class DocPaths(unittest.TestCase):
    def run_on(self, text):
        with tempfile.TemporaryDirectory() as name:
            pathlib.Path(name, "core/base").mkdir(parents=True)
            pathlib.Path(name, "core/base/watch.hpp").write_text("")
            pathlib.Path(name, "README.md").write_text(text)
            return subprocess.run([sys.executable, "-B", str(SCRIPT), name], capture_output=True).returncode

    def test_what_is_there_may_be_named(self):
        self.assertEqual(self.run_on("See `core/base`, `core/base/watch` and `core/base/watch.hpp`, `core/NAME`."), 0)

    def test_what_is_not_there_is_found(self):
        self.assertEqual(self.run_on("See `core/base/clock.hpp`."), 1)


if __name__ == "__main__":
    unittest.main()
