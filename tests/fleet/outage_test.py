#!/usr/bin/env python3
"""What clients see when the database is away, and how a daemon hears of others behind a connection that is half gone.

    tests/fleet/with_postgres tests/fleet/outage_test.py
"""

import contextlib
import os
import pathlib
import socket
import subprocess
import sys
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "torture"))
import kit  # noqa: E402
import torture  # noqa: E402
from kit import sculpt  # noqa: E402

FOLDER = os.environ.get("SCULPT_TEST_POSTGRES_FOLDER", "")


class Proxy:
    """Between a daemon and the database's socket. When it is frozen the connections that there are carry nothing any more, and nobody is told."""

    def __init__(self):
        self.listening = socket.create_server(("127.0.0.1", 0))
        self.address = f"postgresql://sculptd@127.0.0.1:{self.listening.getsockname()[1]}/postgres?sslmode=disable"
        self.frozen, self.made, self.open = 0, 0, []
        threading.Thread(target=self._accept, daemon=True).start()

    def freeze(self):
        self.frozen = self.made

    def close(self):
        self.listening.close()
        for connection in self.open:
            connection.close()

    def _accept(self):
        while True:
            try:
                client, _ = self.listening.accept()
            except OSError:
                return
            database = socket.socket(socket.AF_UNIX)
            try:
                database.connect(f"{FOLDER}/.s.PGSQL.5432")
            except OSError:  # it is away
                client.close()
                continue
            self.made += 1
            self.open += [client, database]
            for ends in ((client, database), (database, client)):
                threading.Thread(target=self._carry, args=(*ends, self.made), daemon=True).start()

    def _carry(self, source, target, number):
        try:
            while data := source.recv(65536):
                if number > self.frozen:
                    target.sendall(data)
        except OSError:
            pass
        if number > self.frozen:
            for end in (source, target):
                with contextlib.suppress(OSError):  # it is closed
                    end.shutdown(socket.SHUT_RDWR)  # close() is not seen while another thread reads


class Fleet(unittest.TestCase):
    def setUp(self):
        scratch = kit.scratch_folder()
        self.scratch = scratch.__enter__()
        self.addCleanup(scratch.__exit__, None, None, None)
        subprocess.run(["psql", "-X", "-q", "-c", "SET client_min_messages=warning; DROP SCHEMA IF EXISTS sculptd CASCADE", torture.POSTGRES], check=True)
        self.mesh = kit.ball()

    def member(self, number, store=torture.POSTGRES, lease_s=30):
        daemon = kit.Daemon(self.scratch / f"data-{number}", "--store", store, "--shared", str(self.scratch / "shared"), "--lease-s", str(lease_s), "--workers", "1")
        self.addCleanup(daemon.stop)
        return daemon

    def test_clients_are_told_and_what_runs_goes_on(self):
        daemon = self.member(1)
        with sculpt.Client(daemon.address) as client:
            client.upload(self.mesh)
            job = client.submit(kit.spec(self.mesh, "panda-turntable", 64), key="order")["job"]
            while client.call("job.get", job=job)["state"] == "queued":
                time.sleep(0.02)
            torture.control("stop", "-m", "fast")
            try:
                with self.assertRaises(sculpt.Failure) as refused:
                    client.call("job.get", job=job)
                self.assertEqual(refused.exception.code, "db_unavailable")
                with self.assertRaises(sculpt.Failure) as refused:
                    client.submit(kit.spec(self.mesh), key="another")
                self.assertEqual(refused.exception.code, "db_unavailable")
            finally:
                torture.control("start")
            ended = torture.patiently(lambda: client.wait(job))
            self.assertEqual(ended["state"], "succeeded")
            self.assertEqual(client.call("job.get", job=job)["attempt"], 1, "it ran on meanwhile")
            self.assertEqual(torture.patiently(lambda: client.submit(kit.spec(self.mesh, "panda-turntable", 64), key="order"))["job"], job)

    def test_a_daemon_behind_connections_that_are_half_gone_goes_on(self):
        proxy = Proxy()
        self.addCleanup(proxy.close)
        behind, other = self.member(1, proxy.address), self.member(2)
        with sculpt.Client(other.address) as client, sculpt.Client(behind.address) as deaf:
            client.upload(self.mesh)
            first = client.submit(kit.spec(self.mesh))["job"]
            self.assertEqual(deaf.wait(first)["state"], "succeeded")
            proxy.freeze()
            second = client.submit(kit.spec(self.mesh))["job"]
            self.assertEqual(torture.patiently(lambda: deaf.wait(second))["state"], "succeeded")
            third = torture.patiently(lambda: deaf.submit(kit.spec(self.mesh), key="third"))["job"]
            self.assertEqual(client.wait(third)["state"], "succeeded")
        self.assertGreater(proxy.made, proxy.frozen, "it made its connections anew")

    def test_top_shows_who_is_there(self):
        daemons = [self.member(number) for number in (1, 2)]
        shown = ""
        while not all(daemon.address in shown for daemon in daemons):
            shown = subprocess.run([os.environ["SCULPT"], "--server", daemons[0].address, "top", "--once"], capture_output=True, text=True, check=True).stdout
        self.assertIn("0 of   1 at work", shown)

    def test_the_shared_folder_belongs_to_one_store(self):
        self.member(1).stop()
        subprocess.run(["psql", "-X", "-q", "-c", "SET client_min_messages=warning; DROP SCHEMA sculptd CASCADE", torture.POSTGRES], check=True)
        with self.assertRaises(AssertionError) as refused:
            self.member(2)
        self.assertIn("belongs to the store", str(refused.exception))

    def test_a_password_is_never_shown(self):
        result = subprocess.run([os.environ["SCULPTD"], "--data", str(self.scratch / "data"), "--store", "postgresql://me:secret@nowhere.invalid/db"], capture_output=True, text=True)
        self.assertEqual(result.returncode, 73)
        self.assertIn("nowhere.invalid", result.stderr)
        self.assertNotIn("secret", result.stderr)
        shown = subprocess.run([os.environ["SCULPTD"], "--store", "postgresql://me:secret@nowhere/db", "config"], capture_output=True, text=True).stdout
        self.assertIn("me:***@nowhere", shown)
        self.assertNotIn("secret", shown)


if __name__ == "__main__":
    unittest.main(verbosity=2)
