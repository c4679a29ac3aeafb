#!/usr/bin/env python3
"""A search that finds no circle anywhere is no search: trees with and without one."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().with_name("include_circles.py")


class IncludeCircles(unittest.TestCase):
    def search(self, files, *folders):
        """Exit code and output for a tree of these files, each with the names that it includes."""
        with tempfile.TemporaryDirectory() as tree:
            for name, included in files.items():
                file = pathlib.Path(tree, name)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text("".join(f'#include "{other}"\n' for other in included))
            done = subprocess.run([sys.executable, "-B", SCRIPT, tree, *folders], capture_output=True, text=True)
            return done.returncode, done.stdout

    def test_no_circle(self):
        code, text = self.search({"core/a/x.hpp": [], "core/a/x.cpp": ["core/a/x.hpp"], "core/b/y.cpp": ["core/a/x.hpp"]})
        self.assertEqual((code, text), (0, "include circles: none\n"))

    def test_circle_of_headers(self):
        code, text = self.search({"proto/x.hpp": ["proto/y.hpp"], "proto/y.hpp": ["proto/x.hpp"]})
        self.assertEqual((code, text), (1, "circle: proto/x -> proto/y -> proto/x\ninclude circles: 1\n"))

    def test_circle_that_only_a_source_closes(self):
        code, text = self.search({"server/net/x.hpp": [], "server/net/x.cpp": ["server/net/x.hpp", "server/run/y.hpp"],
                                  "server/run/y.hpp": ["server/net/x.hpp"]})
        self.assertEqual(code, 1)
        self.assertIn("circle: server/net/x -> server/run/y -> server/net/x", text)

    def test_circle_of_three_in_subfolders(self):
        code, text = self.search({"clients/cpp/x.hpp": ["clients/cli/y.hpp"], "clients/cli/y.hpp": ["core/z.hpp"],
                                  "core/z.hpp": [], "core/z.cpp": ["clients/cpp/x.hpp"]})
        self.assertEqual(code, 1)
        self.assertEqual(text.count("circle: "), 1)

    def test_every_circle_is_told(self):
        code, text = self.search({"core/a.hpp": ["core/b.hpp"], "core/b.hpp": ["core/a.hpp"],
                                  "core/c.hpp": ["core/d.hpp"], "core/d.hpp": ["core/c.hpp"]})
        self.assertEqual((code, text.count("circle: ")), (1, 2))

    def test_only_the_folders_asked_for(self):
        files = {"server/x.hpp": ["server/y.hpp"], "server/y.hpp": ["server/x.hpp"], "core/a.hpp": []}
        self.assertEqual(self.search(files, "core")[0], 0)
        self.assertEqual(self.search(files, "core", "server")[0], 1)


if __name__ == "__main__":
    unittest.main()
