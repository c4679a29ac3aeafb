#!/usr/bin/env python3
"""Mixed work for a long time: jobs that are planned, paused, cancelled, verified, downloaded and followed on connections that
come and go, planners and daemons that are killed. Memory, descriptors, logs and tables must stay as they are.

    tests/fleet/soak.py --store sqlite --seconds 7200
    tests/fleet/with_postgres [--durable] tests/fleet/soak.py --store postgres [--files database] --seconds 7200

One daemon is watched; with PostgreSQL it is never killed, the other one is, again and again; with SQLite the only daemon is
killed three times. What has ended is removed after half a minute, so that nothing has a reason to grow.
"""

import argparse
import collections
import os
import pathlib
import random
import signal
import statistics
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import torture  # noqa: E402
from torture import kit, sculpt  # noqa: E402

CLIENTS, LOOKS, KEEP_S, WARM_S = 4, 200, 30, 90
# What may grow from the second quarter of the time to the last, beyond a seventh.
SLACK = {"memory_mb": 8, "descriptors": 12, "sqlite_log_mb": 64, "tables_mb": 16, "files_mb": 16}


class Watched:
    """Places of the fleet, the first of which is watched."""

    def __init__(self, scratch, arguments):
        self.scratch, self.arguments, self.random = scratch, arguments, random.Random(arguments.seed)
        self.options = ["--keep-s", str(KEEP_S), "--workers", "1"]
        self.in_postgres = arguments.store == "postgres"
        if self.in_postgres:
            self.options += ["--store", torture.POSTGRES, "--lease-s", "4"]
            if arguments.files == "folder":
                self.options += ["--shared", str(scratch / "shared")]
        self.daemons = [self.start(number) for number in range(2 if self.in_postgres else 1)]
        self.kills = collections.Counter()

    def start(self, number):
        return kit.Daemon(self.scratch / f"data-{number}", *self.options)

    def address(self):
        return self.random.choice(self.daemons).address

    def kill_a_daemon(self):
        number = len(self.daemons) - 1
        self.daemons[number].kill()
        self.daemons[number] = self.start(number)
        self.kills["daemons"] += 1

    def kill_a_planner(self):
        for daemon in self.daemons:
            for process in planners(daemon.process.pid):
                if self.random.random() < 0.3:
                    try:
                        os.kill(process, signal.SIGKILL)
                        self.kills["planners"] += 1
                    except ProcessLookupError:
                        pass

    def figures(self):
        process = self.daemons[0].process.pid
        pages = int(pathlib.Path(f"/proc/{process}/statm").read_text().split()[1])
        found = {"memory_mb": pages * os.sysconf("SC_PAGE_SIZE") / 2**20, "descriptors": len(os.listdir(f"/proc/{process}/fd"))}
        log = self.scratch / "data-0/sculptd.db-wal"
        if log.exists():
            found["sqlite_log_mb"] = log.stat().st_size / 2**20
        if self.in_postgres:
            sizes = torture.psql("SELECT relname, pg_total_relation_size(oid) FROM pg_class WHERE relnamespace='sculptd'::regnamespace AND relkind='r'")
            found["files_mb"] = sum(int(size) for name, size in sizes if name in ("file", "piece")) / 2**20
            found["tables_mb"] = sum(int(size) for _, size in sizes) / 2**20 - found["files_mb"]
        return found


def planners(daemon):
    """The processes that plan its jobs; those that check and replay are left alone."""
    try:
        children = [word for task in pathlib.Path(f"/proc/{daemon}/task").iterdir() for word in (task / "children").read_text().split()]
        return [int(child) for child in children if b"--run-job" in pathlib.Path(f"/proc/{child}/cmdline").read_bytes()]
    except OSError:  # one has just ended
        return []


class Client(threading.Thread):
    """Does one thing after another, each on a connection of its own."""

    def __init__(self, watched, mesh, number, stop):
        super().__init__()
        self.watched, self.mesh, self.stop, self.done = watched, mesh, stop, collections.Counter()
        self.random, self.error = random.Random(watched.arguments.seed * 1000 + number), None

    def run(self):
        try:
            while not self.stop.is_set():
                what = self.random.choice([self.plan, self.plan, self.cancel, self.pause, self.follow, self.list, self.leave])
                torture.patiently(lambda: self.connected(what))
                self.done[what.__name__] += 1
        except Exception as error:  # told by who joins
            self.error = error
            self.stop.set()

    def connected(self, what):
        with sculpt.Client(self.watched.address()) as client:
            what(client)

    def submit(self, client, resolution=8):
        client.upload(self.mesh)
        return client.submit(kit.spec(self.mesh, self.random.choice(["gantry", "panda-turntable"]), resolution, seed=self.random.randrange(1 << 30)))["job"]

    def plan(self, client):
        job = self.submit(client)
        if client.wait(job)["state"] != "succeeded":
            return  # its planner was killed twice
        try:
            kit.expect(client.call("job.verify", job=job)["clean"], f"the plan of {job} is not clean")
            client.call("artifact.read", job=job, artifact="trajectory", format="csv", offset=0, bytes=1000)
        except sculpt.Failure as failure:
            if failure.code not in ("gone", "not_found"):  # its time of keeping was over
                raise

    def cancel(self, client):
        job = self.submit(client, 32)
        time.sleep(self.random.uniform(0, 0.5))
        self.tolerantly(client, "job.cancel", job)
        client.wait(job)

    def pause(self, client):
        job = self.submit(client, 32)
        time.sleep(self.random.uniform(0, 0.5))
        self.tolerantly(client, "job.pause", job)
        while not self.stop.is_set() and client.call("job.get", job=job)["state"] == "pausing":
            time.sleep(0.05)
        self.tolerantly(client, "job.resume", job)
        client.wait(job)

    @staticmethod
    def tolerantly(client, method, job):
        try:
            client.call(method, job=job)
        except sculpt.Failure as failure:
            if failure.code != "wrong_state":
                raise

    def follow(self, client):
        job = self.submit(client)
        client.call("events.subscribe", job=job, after=0)

    def list(self, client):
        client.call("job.list", limit=100, order="newest")
        client.call("server.info")

    def leave(self, client):
        """A connection that ends in the middle."""
        client.call("ping")


def quarters(samples):
    """The median of each figure in each quarter of the time."""
    length = max(1, len(samples) // 4)
    parts = [samples[i * length:(i + 1) * length] for i in range(4)]
    return {name: [statistics.median(sample[name] for sample in part) for part in parts if any(name in sample for sample in part)]
            for name in sorted(set().union(*samples)) if all(name in sample for sample in samples)}


def check_store(watched, scratch):
    if not watched.in_postgres:
        kit.expect_clean(scratch / "data-0")
        return
    rows = torture.psql("SELECT job, count(*), max(seq), count(DISTINCT seq), count(*) FILTER (WHERE state='succeeded') FROM sculptd.event GROUP BY job")
    for job, count, last, distinct, succeeded in rows:
        kit.expect(count == last == distinct, f"row {job}: its events are not numbered 1, 2, 3 without a gap")
        kit.expect(int(succeeded) <= 1, f"row {job} succeeded {succeeded} times")
    kit.expect(not torture.psql("SELECT 1 FROM sculptd.lease"), "a daemon that stopped still holds a job")
    kit.expect(not torture.psql("SELECT 1 FROM sculptd.job WHERE state IN ('running', 'pausing', 'cancelling')"), "a job is in nobody's hands")


def soak(scratch, arguments):
    watched, mesh, stop = Watched(scratch, arguments), kit.ball(), threading.Event()
    clients = [Client(watched, mesh, number, stop) for number in range(CLIENTS)]
    for client in clients:
        client.start()
    begun, samples, kills_left = time.monotonic(), [], 3
    pause = max(2.0, arguments.seconds / LOOKS)
    while not stop.wait(pause) and time.monotonic() - begun < arguments.seconds:
        age = time.monotonic() - begun
        watched.kill_a_planner()
        if watched.in_postgres and watched.random.random() < 0.2:
            watched.kill_a_daemon()
        if not watched.in_postgres and kills_left > 0 and age > arguments.seconds * (4 - kills_left) / 4:
            kills_left -= 1
            watched.kill_a_daemon()
        if age > WARM_S:
            samples.append(watched.figures())
    stop.set()
    for client in clients:
        client.join()
        if client.error:
            raise client.error
    for daemon in watched.daemons:
        kit.expect(daemon.stop() == 0, "a daemon did not stop in order:\n" + daemon.log())
    check_store(watched, scratch)
    done = sum((client.done for client in clients), collections.Counter())
    print(f"{arguments.store}, files in the {arguments.files if watched.in_postgres else 'folder'}: {time.monotonic() - begun:.0f} s, done: {dict(done)}, killed: {dict(watched.kills)}")
    grown = []
    for name, medians in quarters(samples).items():
        print(f"  {name:<14} in each quarter: " + "  ".join(f"{median:8.1f}" for median in medians))
        if medians[-1] > medians[1] * 8 / 7 + SLACK[name]:
            grown.append(name)
    kit.expect(not grown, f"these grew: {', '.join(grown)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--store", choices=("sqlite", "postgres"), required=True)
    parser.add_argument("--files", choices=("folder", "database"), default="folder")
    parser.add_argument("--seconds", type=float, default=7200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if arguments.store == "postgres" and not torture.POSTGRES:
        parser.error("run it with tests/fleet/with_postgres")
    print(f"seed {arguments.seed}", flush=True)
    with kit.scratch_folder() as folder:
        soak(folder, arguments)


if __name__ == "__main__":
    main()
