#!/usr/bin/env python3
"""The way to the database: TLS that knows its server, a role for migration and one with the least rights for daemons, and a
password that nobody reads.

    tests/fleet/with_postgres --tls tests/fleet/security_test.py
"""

import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import torture  # noqa: E402
from torture import kit, sculpt  # noqa: E402

WHERE = os.environ.get("SCULPT_TEST_POSTGRES_TLS", "")
SECRET = "hunter2-hunter3"
# What a daemon has no business with.
FORBIDDEN = ("CREATE TABLE sculptd.mine(x int)", "DROP TABLE sculptd.job", "ALTER TABLE sculptd.job ADD COLUMN x int", "TRUNCATE sculptd.event",
             "CREATE ROLE another", "SELECT * FROM pg_authid", "COPY sculptd.job TO PROGRAM 'true'")


class Security(unittest.TestCase):
    def setUp(self):
        scratch = kit.scratch_folder()
        self.scratch = scratch.__enter__()
        self.addCleanup(scratch.__exit__, None, None, None)
        torture.psql("SET client_min_messages=warning; DROP SCHEMA IF EXISTS sculptd CASCADE")
        for role in ("owner", "daemon"):
            torture.psql(f"SET client_min_messages=warning; DO $$ BEGIN DROP OWNED BY fleet_{role}; EXCEPTION WHEN undefined_object THEN END $$")
            torture.psql(f"SET client_min_messages=warning; DROP ROLE IF EXISTS fleet_{role}; CREATE ROLE fleet_{role} LOGIN PASSWORD '{SECRET}'")
        torture.psql("GRANT CREATE ON DATABASE postgres TO fleet_owner")
        self.password = self.scratch / "password"
        self.password.write_text(SECRET + "\n")

    def url(self, role="daemon", mode="verify-full", authority=os.environ.get("SCULPT_TEST_POSTGRES_CA", "")):
        return f"postgresql://fleet_{role}@{WHERE}/postgres?sslmode={mode}&sslrootcert={authority}"

    def options(self, url, *more):
        return ["--store", url, "--store-password-file", str(self.password), *more]

    def sculptd(self, *words):
        """A run that is expected to end."""
        result = subprocess.run([os.environ["SCULPTD"], "--data", str(self.scratch / "once"), *words], capture_output=True, text=True)
        self.assertNotIn(SECRET, result.stdout + result.stderr)
        return result

    def migrate(self):
        result = self.sculptd(*self.options(self.url("owner")), "migrate", "--daemon-role", "fleet_daemon")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_owner_makes_the_tables_and_the_daemon_works_with_the_least_rights(self):
        refused = self.sculptd(*self.options(self.url()))
        self.assertEqual(refused.returncode, 73)
        self.assertIn("sculptd migrate --daemon-role", refused.stderr, "it may make no tables, and says who may")
        self.migrate()
        self.migrate()
        mesh = kit.ball()
        with kit.Daemon(self.scratch / "data", *self.options(self.url(), "--log", "trace")) as daemon, sculpt.Client(daemon.address) as client:
            client.upload(mesh)
            job = client.submit(kit.spec(mesh))["job"]
            self.assertEqual(client.wait(job)["state"], "succeeded")
            self.assertEqual(len(kit.trajectory_sha256(client, job)), 64)
            for secret in (SECRET, "SCRAM"):
                self.assertNotIn(secret, daemon.log())
            for process in self.family(daemon.process.pid):
                self.assertNotIn(SECRET, self.of_process(process, "cmdline") + self.of_process(process, "environ"))
            encrypted = torture.psql("SELECT count(*), count(*) FILTER (WHERE ssl) FROM pg_stat_ssl JOIN pg_stat_activity USING (pid) WHERE usename='fleet_daemon'")
            self.assertEqual(encrypted[0][0], encrypted[0][1])
            self.assertNotEqual(encrypted[0][0], "0")
        for statement in FORBIDDEN:
            with self.subTest(statement):
                done = subprocess.run(["psql", "-X", "-q", "-c", statement, self.url()], capture_output=True, text=True, env={**os.environ, "PGPASSWORD": SECRET})
                self.assertNotEqual(done.returncode, 0)
                self.assertRegex(done.stderr, "permission denied|must be owner|must be")

    def test_a_server_that_is_not_known_is_not_spoken_to(self):
        self.migrate()
        stranger = self.sculptd(*self.options(self.url(authority=os.environ["SCULPT_TEST_POSTGRES_OTHER_CA"])))
        self.assertEqual(stranger.returncode, 73)
        self.assertIn("certificate", stranger.stderr)
        other_name = self.sculptd(*self.options(self.url().replace("localhost", "127.0.0.1")))
        self.assertEqual(other_name.returncode, 73)
        self.assertIn("does not match", other_name.stderr)
        open_wire = self.sculptd(*self.options(self.url(mode="disable")))
        self.assertEqual(open_wire.returncode, 73)
        self.assertIn("no encryption", open_wire.stderr)

    def test_a_wrong_password_is_refused_and_not_told(self):
        self.migrate()
        self.password.write_text(SECRET[::-1] + "\n")
        refused = self.sculptd(*self.options(self.url()))
        self.assertEqual(refused.returncode, 73)
        self.assertIn("password authentication failed", refused.stderr)
        self.assertNotIn(SECRET[::-1], refused.stderr)
        self.password.unlink()
        missing = self.sculptd(*self.options(self.url()))
        self.assertEqual(missing.returncode, 73)
        self.assertIn("write it into the first line", missing.stderr)

    def test_a_password_in_the_environment_reaches_no_planner(self):
        self.migrate()
        os.environ["PGPASSWORD"] = SECRET
        self.addCleanup(os.environ.pop, "PGPASSWORD")
        mesh = kit.ball()
        with kit.Daemon(self.scratch / "data", "--store", self.url(), "--workers", "1") as daemon, sculpt.Client(daemon.address) as client:
            client.upload(mesh)
            job = client.submit(kit.spec(mesh, "panda-turntable", 64))["job"]
            planners = []
            while not planners and client.call("job.get", job=job)["state"] in ("queued", "running"):
                planners = [process for process in self.family(daemon.process.pid) if "--run-job" in self.of_process(process, "cmdline")]
            self.assertTrue(planners)
            for planner in planners:
                self.assertNotIn(SECRET, self.of_process(planner, "environ"))
            client.call("job.cancel", job=job)
            self.assertNotIn(SECRET, daemon.log())

    @staticmethod
    def of_process(process, what):
        try:
            return pathlib.Path(f"/proc/{process}/{what}").read_bytes().decode(errors="replace")
        except OSError:
            return ""  # it has ended

    def family(self, process):
        children = [int(word) for task in pathlib.Path(f"/proc/{process}/task").glob("*") for word in self.of_process(f"{process}/task/{task.name}", "children").split()]
        return [process, *children]


if __name__ == "__main__":
    unittest.main(verbosity=2)
