#!/usr/bin/env python3
"""Kills the daemon again and again while clients submit and jobs run; nothing that a client was told may be lost or doubled."""

import argparse
import random
import statistics
import threading
import time

import kit
from kit import sculpt

LINGER_S = 1.0  # a daemon lives for at most so long once it is ready


class Record:
    """What clients were told, in all lives of the daemon."""

    def __init__(self):
        self.lock, self.jobs, self.results, self.breaches = threading.Lock(), {}, {}, []

    def acknowledge(self, key, job):
        with self.lock:
            if self.jobs.setdefault(key, job) != job:
                self.breaches.append(f"the key {key} stands for the jobs {self.jobs[key]} and {job}")

    def finish(self, key, sha256):
        with self.lock:
            if self.results.setdefault(key, sha256) != sha256:
                self.breaches.append(f"the job of the key {key} has the results {self.results[key]} and {sha256}")

    def acked(self):
        result = {key: {"state": "succeeded", "sha256": sha256} for key, sha256 in self.results.items()}
        return [{"job": job, "key": key, **result.get(key, {})} for key, job in self.jobs.items()]


class Submitter:
    """Submits under keys of its own; one that was not answered is submitted again to the next daemon."""

    def __init__(self, name, spec, seed, record):
        self.name, self.spec, self.record = name, spec, record
        self.random, self.count = random.Random(f"{seed} {name}"), 0

    def work(self, address):
        """Until the daemon is killed."""
        try:
            with sculpt.Client(address) as client:
                while True:
                    self.step(client)
        except (sculpt.Failure, OSError, ValueError):
            pass  # it was killed; half a line of a reply is no JSON

    def step(self, client):
        key = f"{self.name}/{self.count}"
        job = client.submit(self.spec, key=key)["job"]
        self.record.acknowledge(key, job)
        self.count += 1
        if self.random.random() < 0.75:
            ended = client.wait(job)
            if ended["state"] != "succeeded":
                self.record.breaches.append(f"job {job} is {ended['state']}: {ended.get('error')}")
            else:
                self.record.finish(key, kit.trajectory_sha256(client, job))


def timed_daemon(data, *options):
    """A daemon, and the seconds until it answered."""
    started = time.monotonic()
    daemon = kit.Daemon(data, *options)
    with sculpt.Client(daemon.address) as client:
        client.call("server.info")
    return daemon, time.monotonic() - started


def live_and_die(daemon, submitters, linger_s):
    threads = [threading.Thread(target=submitter.work, args=(daemon.address,)) for submitter in submitters]
    for thread in threads:
        thread.start()
    time.sleep(linger_s)
    daemon.kill()
    for thread in threads:
        thread.join()


def finish_all(daemon, record):
    """Lets all jobs end and asks for their results."""
    keys = {job: key for key, job in record.jobs.items()}
    with sculpt.Client(daemon.address) as client:
        for job in kit.all_jobs(client):
            ended = client.wait(job["job"])
            kit.expect(ended["state"] == "succeeded", f"job {job['job']} is {ended['state']}: {ended.get('error')}")
            if job["job"] in keys:
                record.finish(keys[job["job"]], kit.trajectory_sha256(client, job["job"]))


def torture(data, arguments):
    mesh = kit.ball()
    record, chance, ready = Record(), random.Random(arguments.seed), []
    kinds = {"short": (kit.spec(mesh), arguments.submitters), "long": (kit.spec(mesh, "panda-turntable", 16), arguments.long)}
    submitters = [Submitter(f"{kind} {n}", spec, arguments.seed, record) for kind, (spec, count) in kinds.items() for n in range(count)]
    for _ in range(arguments.kills):
        daemon, seconds = timed_daemon(data, "--workers", "2")
        ready.append(seconds)
        with sculpt.Client(daemon.address) as client:
            client.upload(mesh)
        live_and_die(daemon, submitters, chance.uniform(0, LINGER_S))
        kit.expect(not record.breaches, "\n".join(record.breaches))
    daemon, seconds = timed_daemon(data, "--workers", "2")
    with daemon:
        finish_all(daemon, record)
        kit.expect(daemon.stop() == 0, "the last daemon did not stop in order")
    kit.expect_clean(data, record.acked())
    kit.expect(not record.breaches, "\n".join(record.breaches))
    for kind in kinds:
        results = {sha256 for key, sha256 in record.results.items() if key.startswith(kind)}
        kit.expect(len(results) <= 1, f"equal jobs have different results: {results}")
    print(f"{arguments.kills} kills, {len(record.jobs)} jobs acknowledged, {len(record.results)} results: none lost, none doubled. "
          f"Start to ready: median {statistics.median(ready):.3f} s, longest {max(ready + [seconds]):.3f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=5)
    parser.add_argument("--submitters", type=int, default=8, help="clients with jobs of a few milliseconds")
    parser.add_argument("--long", type=int, default=4, help="clients with jobs of a second or so")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    print(f"seed {arguments.seed}")
    with kit.scratch_folder() as folder:
        torture(folder / "data", arguments)


if __name__ == "__main__":
    main()
