"""A wall clock that is set forward and back under a daemon that works (libfaketime)."""

import contextlib
import glob
import os
import time
import unittest

import kit
from kit import sculpt

LIBRARY = next(iter(sorted(glob.glob("/usr/lib/*/faketime/libfaketimeMT.so.1"))), None)
HOUR_S, DAY_S = 3600, 86400


class Clock:
    """What a daemon takes for wall time; its monotonic clock goes on as it is."""

    def __init__(self, file):
        self.file, self.offset_s = file, 0
        self.set(0)

    def set(self, offset_s):
        draft = self.file.with_suffix(".draft")
        draft.write_text(f"{offset_s:+d}\n")
        draft.rename(self.file)
        self.offset_s = offset_s

    def utc(self, ahead_s):
        return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(time.time() + self.offset_s + ahead_s))

    @contextlib.contextmanager
    def daemon(self, data, *options):
        settings = {"LD_PRELOAD": LIBRARY, "FAKETIME_TIMESTAMP_FILE": str(self.file), "FAKETIME_NO_CACHE": "1", "FAKETIME_DONT_FAKE_MONOTONIC": "1"}
        before = dict(os.environ)
        os.environ.update(settings)
        try:
            daemon = kit.Daemon(data, "--workers", "1", *options)
        finally:
            os.environ.clear()
            os.environ.update(before)
        with daemon, sculpt.Client(daemon.address) as client:
            yield client


class ClockTest(unittest.TestCase):
    def setUp(self):
        folder = kit.scratch_folder()
        self.scratch = folder.__enter__()
        self.addCleanup(folder.__exit__, None, None, None)
        self.data, self.mesh = self.scratch / "data", kit.ball()
        self.clock = Clock(self.scratch / "clock")

    def submit(self, client, spec=None, **options):
        client.upload(self.mesh)
        return client.submit(spec or kit.spec(self.mesh), **options)["job"]

    def await_state(self, client, job, state):
        with sculpt.Client(client.server) as watcher:
            watcher.call("events.subscribe", job=job)
            while watcher.next_event().get("data", {}).get("to") != state:
                pass

    def test_a_job_that_waits_for_its_time_starts_when_the_clock_is_set_forward(self):
        with self.clock.daemon(self.data) as client:
            held = self.submit(client, not_before=self.clock.utc(HOUR_S))
            self.assertEqual(client.call("job.get", job=held)["state"], "held")
            self.clock.set(2 * HOUR_S)
            self.assertEqual(client.wait(held)["state"], "succeeded")
        kit.expect_clean(self.data)

    def test_the_time_limit_of_a_run_knows_no_wall_clock(self):
        with self.clock.daemon(self.data) as client:
            job = self.submit(client, kit.spec(self.mesh, "panda-turntable", 16, search="octree"), max_runtime_s=4 * HOUR_S)
            self.await_state(client, job, "running")
            for offset_s in (5 * HOUR_S, -5 * HOUR_S, DAY_S):
                self.clock.set(offset_s)
            self.assertEqual(client.wait(job)["state"], "succeeded")
        kit.expect_clean(self.data)

    def test_a_clock_that_is_set_back_lets_nobody_overtake(self):
        with self.clock.daemon(self.data) as client:
            client.call("queue.pause")
            jobs = [self.submit(client)]
            self.clock.set(-DAY_S)
            jobs.append(self.submit(client))
        self.clock.set(-2 * DAY_S)
        with self.clock.daemon(self.data) as client:
            jobs.append(self.submit(client))
            self.assertEqual([client.call("job.get", job=job)["position"] for job in jobs], [0, 1, 2])
            self.assertEqual([job["job"] for job in kit.all_jobs(client)], jobs)
            client.call("queue.resume")
            started = [client.wait(job)["state"] for job in jobs]
            self.assertEqual(started, ["succeeded"] * 3)
        kit.expect_clean(self.data)

    def test_what_is_kept_for_a_week_goes_when_the_clock_says_so_and_comes_back_never(self):
        with self.clock.daemon(self.data) as client:
            old, pinned = self.submit(client), self.submit(client)
            for job in (old, pinned):
                client.wait(job)
            client.call("artifact.pin", job=pinned)
        self.clock.set(30 * DAY_S)
        with self.clock.daemon(self.data) as client:
            while (self.data / "jobs" / old).exists():
                time.sleep(0.02)
            self.clock.set(0)
            with self.assertRaises(sculpt.Failure) as gone:
                client.call("job.get", job=old)
            self.assertEqual(gone.exception.code, "gone")
            self.assertEqual(client.call("job.get", job=pinned)["state"], "succeeded")
            self.assertGreater(self.submit(client), pinned)
        kit.expect_clean(self.data)


if __name__ == "__main__":
    if LIBRARY is None:
        kit.skip("there is no libfaketime: apt-get install libfaketime")
    unittest.main(verbosity=2)
