"""A sync that fails, and a disk that is full: by a library in front of the disk, and for real on a small tmpfs."""

import contextlib
import os
import pathlib
import subprocess
import unittest

import kit
from crash_points import Session
from kit import sculpt

FULL = ("storage_error", "storage_full")
IO_ERROR_EXIT = 74


@contextlib.contextmanager
def faulty_daemon(data, **fault):
    """A daemon whose disk has this fault; what is set here is not there for the next one."""
    settings = {"LD_PRELOAD": os.environ["SCULPT_DISK_FAULT"], "SCULPT_FAULT_ROOT": str(data), **fault}
    before = dict(os.environ)
    os.environ.update(settings)
    try:
        daemon = kit.Daemon(data, "--workers", "1", "--isolate", "false")  # a process of its own would get no such library
    finally:
        os.environ.clear()
        os.environ.update(before)
    with daemon:
        yield daemon


class DiskTest(unittest.TestCase):
    def setUp(self):
        folder = kit.scratch_folder()
        self.data = folder.__enter__() / "data"
        self.addCleanup(folder.__exit__, None, None, None)
        self.mesh = kit.ball()

    def count(self, place):
        """How many operations (0), syncs (1), writes (2) there are before one session and at its end; more come with the stop."""
        count_file = self.data.with_name("count")
        with faulty_daemon(self.data.with_name("counted"), SCULPT_COUNT_FILE=str(count_file)) as daemon:
            started = int(count_file.read_text().split()[place])
            Session(self.mesh).run(daemon.address)
            return started, int(count_file.read_text().split()[place])


class SyncFails(DiskTest):
    def test_the_daemon_ends_at_once_and_loses_nothing(self):
        started, all_syncs = self.count(1)
        ended = 0
        for nth in range(started + 1, all_syncs, max(1, (all_syncs - started) // 5)):
            data, session = self.data.with_name(f"data {nth}"), Session(self.mesh)
            with self.subTest(sync=nth):
                with faulty_daemon(data, SCULPT_SYNC_FAILS=str(nth)) as daemon:
                    with contextlib.suppress(sculpt.Failure, OSError, ValueError):
                        session.run(daemon.address)
                    exit_code = daemon.stop()
                    # 0: SQLite does not look at how the sync of the folder ended that it makes for a new log; or there were fewer syncs.
                    self.assertIn(exit_code, (0, IO_ERROR_EXIT), daemon.log())
                    if exit_code == IO_ERROR_EXIT:
                        ended += 1
                        self.assertIn("failed to sync", daemon.log())
                with kit.Daemon(data) as daemon:
                    session.run(daemon.address)
                kit.expect_clean(data, session.acked())
        self.assertGreaterEqual(ended, 3)


class DiskFull(DiskTest):
    def test_each_write_in_its_turn(self):
        """Whichever write finds no space: the daemon lives on, says so, and works again by itself when there is space."""
        started, all_writes = self.count(2)
        for nth in range(started + 1, all_writes, max(1, (all_writes - started) // 8)):
            data, session = self.data.with_name(f"data {nth}"), Session(self.mesh)
            with self.subTest(write=nth), faulty_daemon(data, SCULPT_DISK_FULL=f"{nth},{nth + 2}") as daemon:
                self.run_in_spite_of_it(session, daemon)
                self.assertEqual(daemon.stop(), 0, daemon.log())
                kit.expect_clean(data, session.acked())

    def run_in_spite_of_it(self, session, daemon):
        """As a client would that tries again what is refused for want of space."""
        for _ in range(10):
            try:
                session.run(daemon.address)
                return self.check_failures(session, daemon)
            except sculpt.Failure as failure:
                self.assertIn(failure.code, FULL, f"{failure}\n{daemon.log()}")
        return self.fail("it never worked again:\n" + daemon.log())

    def check_failures(self, session, daemon):
        """A job may fail, but only for want of space."""
        with sculpt.Client(daemon.address) as client:
            for job in session.jobs.values():
                error = client.call("job.get", job=job).get("error")
                self.assertIn(error and error["code"], (None, *FULL, "file_unwritable"), daemon.log())

    def test_a_tmpfs_that_is_full_and_has_space_again(self):
        self.data.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", str(self.data)], capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("a tmpfs cannot be mounted here: run as root")
        self.addCleanup(subprocess.run, ["umount", str(self.data)], check=True)
        with kit.Daemon(self.data, "--workers", "1") as daemon, sculpt.Client(daemon.address) as client:
            client.upload(self.mesh)
            done = client.submit(kit.spec(self.mesh))["job"]
            client.wait(done)
            filler = self.data / "filler"
            fill(filler)
            refused = self.refused_submits(client)
            self.assertIn(refused, FULL)
            self.assertEqual(client.call("job.get", job=done)["state"], "succeeded", "reading must go on")
            self.assertTrue(b"".join(client.read_artifact(done)))
            filler.unlink()
            again = client.submit(kit.spec(self.mesh, seed=77), key="again")["job"]
            self.assertEqual(client.wait(again)["state"], "succeeded")
            for job in kit.all_jobs(client):
                self.assertIn(client.wait(job["job"])["state"], ("succeeded", "failed"))
            self.assertEqual(daemon.stop(), 0)
        kit.expect_clean(self.data, [{"job": again, "key": "again", "state": "succeeded"}])

    def refused_submits(self, client):
        """The code of the first refusal; the log may take a few before it must grow."""
        for seed in range(100000):
            try:
                client.submit(kit.spec(self.mesh, seed=1000 + seed))
            except sculpt.Failure as failure:
                return failure.code
        return None


def fill(path):
    """Takes all space that there is."""
    with pathlib.Path(path).open("wb", buffering=0) as file:
        for size in (1 << 16, 1 << 12, 1 << 8, 1):
            try:
                while file.write(bytes(size)) == size:
                    pass
            except OSError:
                continue


if __name__ == "__main__":
    unittest.main()
