"""A data folder that something was done to: nothing is thrown away, nothing damaged is given out, and the operator's two commands."""

import json
import os
import subprocess
import unittest

import shapes
from harness import PATIENCE_S, SCULPT, SCULPT_PY, SOURCE, ClientTest, Daemon

import sculpt


class StoreTest(ClientTest):
    def setUp(self):
        super().setUp()
        self.data = self.scratch / "data"
        self.mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball())

    def submit(self):
        return self.fine("submit", self.mesh, "--resolution", 8, "--robot", "gantry", "--wait").strip()

    def operator(self, *arguments):
        return subprocess.run([os.environ["SCULPTD"], *arguments, "--data", str(self.data)], cwd=SOURCE, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=PATIENCE_S)

    def start_is_refused(self, words):
        before = self.listing()
        result = self.operator("--listen", "127.0.0.1:0", "--keep-s", "0.001")
        self.assertEqual(result.returncode, 78, result.stderr)
        for word in (words, "restore a backup", "sculptd adopt"):
            self.assertIn(word, result.stderr)
        self.assertEqual(self.listing(), before)

    def listing(self):
        """All files with their sizes, but for what SQLite makes by looking: its index of the log, and an empty log."""
        files = {path: path.stat().st_size for path in self.data.rglob("*") if path.is_file() and not path.name.endswith("-shm")}
        return {path: size for path, size in files.items() if size or not path.name.endswith("-wal")}


class Lost(StoreTest):
    def test_an_emptied_store_is_refused_and_adopted_and_no_result_is_deleted(self):
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            job = self.submit()
            plan = self.fine("fetch", job, "-o", "-")
        (self.data / "sculptd.db").write_bytes(b"")
        self.start_is_refused("missing or empty")
        (self.data / "sculptd.db").unlink()
        self.start_is_refused("missing or empty")
        self.assertEqual(self.operator("fsck").returncode, 1)
        adopted = self.operator("adopt")
        self.assertEqual(adopted.returncode, 0, adopted.stderr)
        self.assertIn(job, adopted.stdout)
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            self.assertEqual(json.loads(self.fine("list", "--json")), {"jobs": []})
            self.submit()
            self.assertEqual(daemon.stop(), 0)
        self.assertEqual((self.data / "jobs.orphaned" / job / "trajectory.ndjson").read_text(), plan)

    def test_a_log_that_is_cut_or_gone_after_a_kill_is_noticed(self):
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            self.submit()
        daemon = Daemon(self.data)
        self.server = daemon.address
        self.submit()
        daemon.kill()
        log = self.data / "sculptd.db-wal"
        whole = log.read_bytes()
        for left in (0, len(whole) // 2):
            log.write_bytes(whole[:left])
            self.start_is_refused("sculptd.db-wal was cut or removed")
        log.unlink()
        self.start_is_refused("sculptd.db-wal was cut or removed")
        log.write_bytes(whole)
        (self.data / "sculptd.db-shm").unlink(missing_ok=True)
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            self.assertEqual(len(json.loads(self.fine("list", "--json"))["jobs"]), 2)


class Damaged(StoreTest):
    clients = SCULPT, SCULPT_PY

    def damage(self, job, name="trajectory.ndjson"):
        path = self.data / "jobs" / job / name
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 1
        path.write_bytes(content)

    def test_every_client_refuses_a_damaged_result_and_retry_makes_the_same_one_again(self):
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            job = self.submit()
            plan = self.fine("fetch", job, "-o", "-")
            for self.client in self.clients:
                self.damage(job)
                self.refused(1, "artifact_damaged", "fetch", job, "-o", self.scratch / "plan.ndjson")
                self.assertEqual(list(self.scratch.glob("plan.ndjson*")), [])
                self.refused(1, "artifact_damaged", "verify", job)
                self.assertEqual(json.loads(self.fine("status", job, "--json"))["error"]["code"], "artifact_damaged")
                self.assertEqual(self.fine("retry", job), "queued\n")
                self.fine("wait", job)
                self.assertEqual(self.fine("fetch", job, "-o", "-"), plan)
                self.fine("verify", job)

    def test_fsck_finds_all_and_repairs_what_can_be(self):
        with Daemon(self.data) as daemon:
            self.server = daemon.address
            job = self.submit()
            result = self.operator("fsck")
            self.assertEqual(result.returncode, 73, "a daemon runs")
        self.assertEqual((self.operator("fsck").stdout, self.operator("fsck").returncode), ("nothing is wrong\n", 0))
        self.damage(job, "voxels.binvox")
        blob = next(self.data.glob("blobs/??/*"))
        content = blob.read_bytes()
        blob.write_bytes(b"else")
        (self.data / "jobs" / "stray").mkdir()
        (self.data / "jobs" / job / "report.json.draft").touch()
        found = self.operator("fsck")
        self.assertEqual(found.returncode, 1)
        for words in (f"job {job}: its voxels.binvox has other bytes", f"blob {blob.name}", "job folder stray", "report.json.draft", "4 faults, 0 repaired"):
            self.assertIn(words, found.stdout)
        repaired = self.operator("fsck", "--repair")
        self.assertIn("4 faults, 4 repaired", repaired.stdout)
        self.assertEqual(repaired.returncode, 0)
        again = self.operator("fsck", "--repair")
        self.assertEqual(again.returncode, 1)
        self.assertIn(f"its blob {blob.name} is missing", again.stdout)
        with Daemon(self.data) as daemon, sculpt.Client(daemon.address) as client:
            self.server = daemon.address
            self.assertEqual(json.loads(self.fine("status", job, "--json"))["error"]["code"], "artifact_damaged")
            client.upload(content)
            self.fine("retry", job)
            self.fine("wait", job)
            self.assertEqual(daemon.stop(), 0)
        self.assertEqual(self.operator("fsck").stdout, "nothing is wrong\n")

    def test_fsck_of_no_folder_makes_none(self):
        self.assertEqual(self.operator("fsck").returncode, 73)
        self.assertFalse(self.data.exists())


if __name__ == "__main__":
    unittest.main()
