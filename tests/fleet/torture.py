#!/usr/bin/env python3
"""Several daemons over one database, killed and frozen at random; the database is restarted and its connections are cut.

    tests/fleet/with_postgres [--durable] tests/fleet/torture.py [--daemons N] [--jobs N] [--seconds S] [--seed K] [--quiet-database]
        [--files folder|database]
Each job must end once, with the bytes that a single undisturbed daemon gives; runs that lost their job must be refused.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import shlex
import signal
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "torture"))
import kit  # noqa: E402
from kit import sculpt  # noqa: E402

LEASE_S = 4
# What a daemon says in its log of work that was no longer its own.
LATE = {"late ends refused": "does not own its job any more", "leases lost": "its lease is lost", "taken from the silent": "was silent for longer than its lease"}
POSTGRES = os.environ.get("SCULPT_TEST_POSTGRES", "")


def psql(sql):
    """The rows, as lines of fields between bars."""
    result = subprocess.run(["psql", "-X", "-q", "-A", "-t", "-c", sql, POSTGRES], capture_output=True, text=True, check=True)
    return [line.split("|") for line in result.stdout.splitlines()]


def control(*words):
    subprocess.run([*shlex.split(os.environ["SCULPT_TEST_POSTGRES_CONTROL"]), *words], check=True, cwd="/", stdout=subprocess.DEVNULL)


class Member:
    """One place in the fleet: a data folder, and the daemon that has it now."""

    def __init__(self, scratch, number, *options, files="folder"):
        self.data = scratch / f"data-{number}"
        self.options = [*options, *(["--shared", str(scratch / "shared")] if files == "folder" else [])]
        self.address, self.daemon = None, None
        self.late = collections.Counter()

    def start(self):
        while True:
            try:
                self.daemon = kit.Daemon(self.data, "--store", POSTGRES, "--lease-s", str(LEASE_S), "--workers", "1", *self.options)
                self.address = self.daemon.address
                return
            except AssertionError as error:  # the database is away: systemd would start it again too
                if "database" not in str(error):
                    raise
                time.sleep(0.2)

    def kill(self):
        self.daemon.kill()
        self.count_late()

    def stop(self):
        code = self.daemon.stop()
        self.count_late()
        return code

    def count_late(self):
        """Of a daemon that has ended; the next one writes its log anew."""
        log = self.daemon.log()
        self.late.update({what: log.count(words) for what, words in LATE.items()})

    def freeze(self, seconds):
        """Stops the daemon, not the processes that plan its jobs: as a machine that hangs, or is cut off."""
        os.kill(self.daemon.process.pid, signal.SIGSTOP)
        time.sleep(seconds)
        os.kill(self.daemon.process.pid, signal.SIGCONT)


def patiently(work):
    """What `work` gives, tried again while daemons or the database are away."""
    while True:
        try:
            return work()
        except (OSError, ValueError):
            time.sleep(0.1)
        except sculpt.Failure as failure:
            if failure.code not in ("db_unavailable", "stopping", "unreachable", "connection_lost") and failure.exit_code != sculpt.UNREACHABLE:
                raise
            time.sleep(0.1)


class Fleet:
    def __init__(self, scratch, arguments):
        self.random = random.Random(arguments.seed)
        self.arguments, self.stop = arguments, threading.Event()
        self.members = [Member(scratch, number, files=arguments.files) for number in range(arguments.daemons)]
        for member in self.members:
            member.start()
        self.done = collections.Counter()

    def address(self):
        return self.random.choice(self.members).address

    def ask(self, work):
        def once():
            with sculpt.Client(self.address()) as client:
                return work(client)
        return patiently(once)

    def disturb(self):
        """Until stop: each two seconds something happens to a daemon or to the database."""
        while not self.stop.wait(self.random.uniform(0.5, 2)):
            member = self.random.choice(self.members)
            what = self.random.choice(["kill", "kill", "freeze", "freeze long", "stop"] + ([] if self.arguments.quiet_database else ["cut", "restart"]))
            self.done[what] += 1
            if what == "kill":
                member.kill()
                member.start()
            elif what == "stop":
                member.stop()
                member.start()
            elif what.startswith("freeze"):
                member.freeze(LEASE_S * 2 if what == "freeze long" else 0.5)
            elif what == "cut":
                patiently_psql("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid<>pg_backend_pid()")
            else:
                control("restart", "-m", "fast")


def patiently_psql(sql):
    while True:
        try:
            return psql(sql)
        except subprocess.CalledProcessError:
            time.sleep(0.2)


def check(jobs_by_number, expected):
    """What the database says of the jobs that were acknowledged; `expected`: the bytes of each."""
    rows = patiently_psql("SELECT id, state, attempt, (SELECT sha256 FROM sculptd.artifact WHERE artifact.job=number AND artifact='trajectory') FROM sculptd.job")
    jobs = {row[0]: row[1:] for row in rows}
    acknowledged = set(jobs_by_number.values())
    kit.expect(acknowledged <= set(jobs), "an acknowledged job is gone")
    kit.expect(len(jobs) == len(acknowledged), f"{len(jobs)} jobs, {len(acknowledged)} were acknowledged: a key made two")
    for job, (state, attempt, sha256) in jobs.items():
        kit.expect(state == "succeeded", f"job {job} is {state}")
        kit.expect(sha256 == expected[job], f"job {job} has other bytes than a single daemon gives: {sha256}, attempt {attempt}")
    ended = patiently_psql("SELECT job, count(*) FILTER (WHERE state='succeeded'), count(*), max(seq), count(DISTINCT seq) FROM sculptd.event GROUP BY job")
    for job, succeeded, count, last, distinct in ended:
        kit.expect(succeeded == "1", f"row {job} succeeded {succeeded} times")
        kit.expect(count == last == distinct, f"row {job}: its events are not numbered 1, 2, 3 without a gap")
    claims = patiently_psql("SELECT job, count(*) FROM sculptd.event WHERE state='running' GROUP BY job HAVING count(*) <> (SELECT attempt FROM sculptd.job WHERE number=event.job)")
    kit.expect(not claims, f"attempts are not what the events say: {claims}")
    kit.expect(not patiently_psql("SELECT 1 FROM sculptd.lease"), "a job that has ended is still held")
    return collections.Counter(int(attempt) for _, attempt, _ in jobs.values())


def expected_bytes(scratch, mesh, specs):
    """The hashes of the trajectories that one daemon with a folder of its own makes."""
    hashes = []
    with kit.Daemon(scratch / "alone", "--workers", "1") as daemon, sculpt.Client(daemon.address) as client:
        client.upload(mesh)
        for spec in specs:
            job = client.submit(spec)["job"]
            kit.expect(client.wait(job)["state"] == "succeeded", "the undisturbed job failed")
            hashes.append(kit.trajectory_sha256(client, job))
    return hashes


def torture(scratch, arguments):
    mesh = kit.ball()
    # Mostly jobs that are over before anything happens to them; each tenth has checkpoints to go on from.
    specs = [kit.spec(mesh, "panda-turntable", 16), *[kit.spec(mesh)] * 9]
    short, long = expected_bytes(scratch, mesh, [specs[1], specs[0]])
    hashes = [long, *[short] * 9]
    fleet = Fleet(scratch, arguments)
    fleet.ask(lambda client: client.upload(mesh))
    trouble = threading.Thread(target=fleet.disturb)
    trouble.start()
    begun, jobs = time.monotonic(), {}
    for number in range(arguments.jobs):
        jobs[number] = fleet.ask(lambda client: client.submit(specs[number % len(specs)], key=f"order-{number}")["job"])
        pause = begun + arguments.seconds * number / arguments.jobs - time.monotonic()
        time.sleep(max(0, pause))
    fleet.stop.set()
    trouble.join()
    for job in jobs.values():
        ended = fleet.ask(lambda client: client.wait(job))
        kit.expect(ended["state"] == "succeeded", f"job {job} is {ended['state']}: {ended.get('error')}")
    expected = {job: hashes[number % len(hashes)] for number, job in jobs.items()}
    for job, sha256 in expected.items():
        kit.expect(fleet.ask(lambda client: kit.trajectory_sha256(client, job)) == sha256, f"a daemon tells another hash of job {job}")
    attempts = check(jobs, expected)
    totals = collections.Counter()
    for member in fleet.members:
        kit.expect(member.stop() == 0, "a daemon did not stop in order:\n" + member.daemon.log())
        totals.update(member.late)
    print(f"{arguments.daemons} daemons, {len(jobs)} jobs in {time.monotonic() - begun:.0f} s, each ended once with the same bytes. "
          f"Done to them: {dict(fleet.done)}. Attempts: {dict(sorted(attempts.items()))}. Of all lives: {json.dumps(totals)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--daemons", type=int, default=4)
    parser.add_argument("--jobs", type=int, default=2000)
    parser.add_argument("--seconds", type=float, default=600, help="how long jobs are submitted and things happen")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--files", choices=("folder", "database"), default="folder", help="where uploads and results are")
    parser.add_argument("--quiet-database", action="store_true", help="leave the database alone")
    arguments = parser.parse_args()
    if not POSTGRES:
        parser.error("run it with tests/fleet/with_postgres")
    print(f"seed {arguments.seed}", flush=True)
    with kit.scratch_folder() as folder:
        torture(folder, arguments)


if __name__ == "__main__":
    main()
