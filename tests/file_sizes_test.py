"""file_sizes.py notices what it is for."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("file_sizes.py")


class FileSizes(unittest.TestCase):
    def breaches(self, files):
        with tempfile.TemporaryDirectory() as name:
            for file, text in files.items():
                path = pathlib.Path(name, file)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            run = subprocess.run([sys.executable, "-B", str(SCRIPT), name], capture_output=True, text=True)
            self.assertEqual(run.returncode, 0 if "all kept" in run.stdout else 1)
            return run.stdout.splitlines()[:-1]

    def test_a_full_folder_is_found(self):
        self.assertEqual(self.breaches({f"core/base/f{i}.hpp": "" for i in range(25)}), [])
        self.assertEqual(len(self.breaches({f"core/base/f{i}.hpp": "" for i in range(26)})), 1)

    def test_a_long_file_must_say_why(self):
        long = "int x;\n" * 301
        self.assertEqual(self.breaches({"core/a.cpp": "int x;\n" * 300}), [])
        self.assertEqual(len(self.breaches({"core/a.cpp": long})), 1)
        self.assertEqual(self.breaches({"core/a.cpp": "// Above 300 lines: a reason.\n" + long}), [])


if __name__ == "__main__":
    unittest.main()
