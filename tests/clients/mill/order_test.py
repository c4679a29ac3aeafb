"""Milling tools of a job: both clients order them in the same words."""

import contextlib
import json
import sqlite3
import unittest

import shapes
from harness import SCULPT, SCULPT_PY, SOURCE, ClientTest, Daemon

import sculpt

LIBRARY = SOURCE / "config/tools/carving.json"


class Tools(ClientTest):
    def order(self, client, *options):
        self.client = client
        return self.fine("submit", self.mesh, "--resolution", 64, "--robot", "studio", "--tools", "D20,D6", *options).strip()

    def test_both_clients_order_the_same(self):
        with Daemon(self.scratch / "data") as daemon:
            self.server = daemon.address
            self.mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))
            with sculpt.Client(self.server) as client:
                client.call("queue.pause")
                lengths = ("--tool-library", LIBRARY, "--tolerance", "0.0005", "--scallop", "0.0001", "--allowance", "0.0002")
                jobs = [self.order(who, *lengths) for who in (SCULPT, SCULPT_PY)]
        with contextlib.closing(sqlite3.connect(self.scratch / "data/sculptd.db")) as store:
            specs = dict(store.execute("SELECT id, spec FROM job"))
        cpp, python = (json.loads(specs[job])["mill"] for job in jobs)
        self.assertEqual(cpp, python)
        self.assertEqual(python["tools"], ["D20", "D6"])
        self.assertEqual((python["tolerance_m"], python["scallop_m"], python["allowance_m"]), (0.0005, 0.0001, 0.0002))

    def test_what_is_no_library_is_refused_before_anything_is_sent(self):
        self.client, self.server = SCULPT_PY, "127.0.0.1:1"
        mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))
        torn, list_ = self.scratch / "torn.json", self.scratch / "list.json"
        torn.write_text(LIBRARY.read_text()[:300])
        list_.write_text(json.dumps([]))
        for options, word in (((), "--tool-library"), (("--tool-library", torn), "tools_invalid"),
                              (("--tool-library", list_), "tools_invalid"), (("--tool-library", "nowhere.json"), "file_missing")):
            ended = self.run_client("submit", mesh, "--resolution", 64, "--robot", "studio", "--tools", "D20", *options)
            self.assertNotEqual(ended.returncode, 0)
            self.assertIn(word, ended.stderr)


if __name__ == "__main__":
    unittest.main()
