"""The checker finds nothing in a good folder, and each kind of breach in a spoilt one."""

import json
import shutil
import sqlite3
import subprocess
import sys
import unittest

import kit
import invariants


class Invariants(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = kit.scratch_folder()
        cls.scratch = folder.__enter__()
        cls.addClassCleanup(folder.__exit__, None, None, None)
        cls.good = cls.scratch / "good"
        mesh = kit.ball()
        with kit.Daemon(cls.good) as daemon, kit.sculpt.Client(daemon.address) as client:
            client.upload(mesh)
            cls.job = client.submit(kit.spec(mesh), key="first")["job"]
            client.wait(cls.job)
            cls.sha256 = kit.trajectory_sha256(client, cls.job)
        cls.acked = {"job": cls.job, "key": "first", "state": "succeeded", "sha256": cls.sha256}

    def setUp(self):
        self.data = self.scratch / self.id()
        shutil.copytree(self.good, self.data)

    def change(self, sql):
        database = sqlite3.connect(self.data / "sculptd.db")
        with database:
            database.execute(sql)
        database.close()

    def found(self, acked=(), **options):
        return "\n".join(invariants.breaches(self.data, acked, **options))

    def test_a_good_folder_is_clean(self):
        self.assertEqual(self.found([self.acked]), "")

    def test_a_database_that_knows_less_than_its_mark(self):
        self.change("UPDATE meta SET value='1' WHERE name='changes'")
        self.assertIn("knows fewer changes", self.found())

    def test_a_mark_of_another_store(self):
        self.change("UPDATE meta SET value='other' WHERE name='epoch'")
        self.assertIn("of another store", self.found())
        (self.data / "sculptd.mark").write_text("nothing")
        self.assertIn("cannot be read", self.found())

    def test_a_lost_job(self):
        self.assertIn("is lost", self.found([{"job": "01M7XRMDB8NWM1BF9DPP1KFA0R"}]))

    def remove(self):
        for sql in ("DELETE FROM event", "DELETE FROM artifact", "INSERT INTO removed SELECT id FROM job", "DELETE FROM job"):
            self.change(sql)

    def test_a_removed_job_is_not_lost_if_it_had_ended(self):
        self.remove()
        self.assertEqual(self.found([self.acked]), "")
        self.assertIn("is lost", self.found([{**self.acked, "state": "running"}]))

    def test_a_removed_job_that_is_still_there(self):
        self.change("INSERT INTO removed SELECT id FROM job")
        self.assertIn("is still there", self.found())

    def test_a_blob_that_is_gone(self):
        next(self.data.glob("blobs/??/" + kit.hashlib.sha256(kit.ball()).hexdigest())).unlink()
        self.assertRegex(self.found(), "its blob .* is missing")

    def test_a_job_under_another_key(self):
        self.assertIn("stored with 'first'", self.found([{**self.acked, "key": "second"}]))

    def test_a_result_that_a_client_was_told_and_is_not_so(self):
        self.assertIn("was said to have failed", self.found([{**self.acked, "state": "failed"}]))
        self.assertIn("told of", self.found([{**self.acked, "sha256": "0" * 64}]))

    def test_a_worker_that_is_gone(self):
        self.change("UPDATE job SET state='running'")
        self.assertIn("no daemon runs", self.found())
        self.assertNotIn("no daemon runs", self.found(killed=True))

    def test_a_gap_in_the_events(self):
        self.change("UPDATE event SET seq=9 WHERE seq=3")
        self.assertIn("numbered [1, 2, 9]", self.found())

    def test_two_ends(self):
        self.change("""INSERT INTO event(job, seq, time, state, data, number) SELECT job, 4, time, 'failed', '{"from":"succeeded","to":"failed"}', 1000 FROM event WHERE seq=3""")
        self.assertIn("ended as succeeded", self.found())

    def test_a_move_that_no_job_makes(self):
        self.change("""UPDATE event SET data=replace(data, 'finished', 'claimed') WHERE seq=3""")
        self.assertIn("makes it succeeded from running because it is claimed", self.found())

    def test_an_attempt_that_is_not_counted(self):
        self.change("""UPDATE event SET data=replace(data, '"attempt":1', '"attempt":2') WHERE seq=3""")
        self.assertIn("speaks of attempt 2, not 1", self.found())

    def test_a_job_that_expired_though_it_had_run(self):
        self.change("""UPDATE event SET state='expired', data=replace(data, 'succeeded', 'expired') WHERE seq=3""")
        self.assertIn("expired though it had run", self.found())

    def test_times_that_do_not_fit_the_state(self):
        self.change("UPDATE job SET wake_at='2100-01-31T12:00:00.000Z', finished_at=''")
        found = self.found()
        self.assertIn("waits for the time '2100", found)
        self.assertIn("ended at ''", found)

    def test_a_job_that_was_never_submitted(self):
        self.change("""UPDATE event SET data='{"to":"queued","reason":"found"}' WHERE seq=1""")
        self.assertIn("0 jobs were submitted", self.found())

    def test_an_artifact_that_is_changed_or_gone(self):
        path = self.data / "jobs" / self.job / "trajectory.ndjson"
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 1
        path.write_bytes(content)
        self.assertIn("is not the file", self.found())
        path.unlink()
        self.assertIn("is missing", self.found())

    def test_a_success_without_a_result(self):
        self.change("DELETE FROM artifact")
        self.assertIn("has no trajectory", self.found())

    def test_a_blob_that_is_changed(self):
        next(self.data.glob("blobs/??/*")).write_bytes(b"something else")
        self.assertIn("named by", self.found())

    def test_a_draft_that_is_left_behind(self):
        (self.data / "jobs" / self.job / "report.json.draft").touch()
        self.assertIn("left behind", self.found())
        self.assertEqual(self.found(killed=True), "")

    def test_by_hand(self):
        program = [sys.executable, invariants.__file__, str(self.data)]
        acked = self.scratch / "acked"
        acked.write_text(json.dumps(self.acked) + "\n")
        self.assertEqual(subprocess.run([*program, "--acked", str(acked)], check=False).returncode, 0)
        (self.data / "sculptd.db.draft").touch()
        self.assertEqual(subprocess.run(program, check=False, stdout=subprocess.DEVNULL).returncode, 1)

    def test_a_daemon_that_runs_is_not_disturbed(self):
        with kit.Daemon(self.data), self.assertRaises(invariants.DaemonRuns):
            self.found()


if __name__ == "__main__":
    unittest.main()
