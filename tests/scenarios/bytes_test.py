"""scripts/make-scenarios writes the committed files of tests/scenarios, byte by byte."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SCULPT_SOURCE"])
COMMITTED = SOURCE / "tests/scenarios"
MESHES = (".stl", ".binvox")


def meshes(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix in MESHES}


class BytesTest(unittest.TestCase):
    def test_the_script_writes_what_is_committed(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", SOURCE / "scripts/make-scenarios", folder], check=True, stdout=subprocess.DEVNULL)
            self.assertGreater(len(meshes(COMMITTED)), 0)
            self.assertEqual(meshes(pathlib.Path(folder)).keys(), meshes(COMMITTED).keys())
            for name, data in meshes(COMMITTED).items():
                self.assertEqual(meshes(pathlib.Path(folder))[name], data, f"{name}: run scripts/make-scenarios and look at what changes")


if __name__ == "__main__":
    unittest.main()
