#!/usr/bin/env python3
"""Lets the daemon die at each of its named crash points, then goes on with the next one: nothing that a client was told may be lost.

A point that is never reached is a failure: the list of points comes from the daemon itself.
"""

import argparse
import os
import re
import signal
import subprocess
import time

import kit
from kit import sculpt

REMOVING = {"job_removed", "files_removed"}  # not reached while jobs are kept


def crash_points():
    """Their names, as the daemon gives them when it is asked for one that does not exist."""
    refused = subprocess.run([os.environ["SCULPTD"], "--listen", "127.0.0.1:0"], env={**os.environ, "SCULPT_CRASH_AT": "?"},
                             capture_output=True, text=True, check=False)
    kit.expect(refused.returncode == 78, f"an unknown crash point must end the daemon with 78, not {refused.returncode}")
    return re.search(r"NAME one of (.*)\n", refused.stderr).group(1).split(", ")


class Session:
    """What a client does and what it was told: an upload, jobs, a download, a cancel. It can be done again after a crash."""

    def __init__(self, mesh):
        self.mesh, self.jobs, self.results = mesh, {}, {}

    def acked(self):
        return [{"job": job, "key": key, **self.results.get(job, {})} for key, job in self.jobs.items()]

    def run(self, address):
        with sculpt.Client(address) as client:
            client.upload(self.mesh)
            first, second = self.submit(client, "first"), self.submit(client, "second", seed=2)
            cancelled = self.submit(client, "cancelled", robot="panda-turntable", resolution=32)
            if cancelled not in self.results:
                client.call("job.cancel", job=cancelled)
                self.results[cancelled] = {"state": client.wait(cancelled)["state"]}
            for job in (first, second):
                ended = client.wait(job)
                self.results[job] = {"state": ended["state"]}
                if ended["state"] == "succeeded":
                    self.results[job]["sha256"] = kit.trajectory_sha256(client, job)
                    list(client.read_artifact(job, format="csv"))

    def submit(self, client, key, **fields):
        job = client.submit(kit.spec(self.mesh, **fields), key=key)["job"]
        kit.expect(self.jobs.setdefault(key, job) == job, f"the key {key} stands for {self.jobs[key]} and {job}")
        return job


def run_until_killed(data, session, point):
    """Whether the daemon reached the point and died there."""
    os.environ["SCULPT_CRASH_AT"] = point
    try:
        daemon = kit.Daemon(data, "--workers", "1", "--isolate", "false")  # so that the points of a run are the daemon's
    except AssertionError:
        return True  # it died before it could say where it listens
    finally:
        del os.environ["SCULPT_CRASH_AT"]
    try:
        session.run(daemon.address)
    except (sculpt.Failure, OSError, ValueError):
        pass
    return daemon.stop() == -signal.SIGKILL


def crash_and_recover(data, mesh, point):
    """False if the point was not reached."""
    session = Session(mesh)
    if not run_until_killed(data, session, point):
        return False
    if session.jobs:  # before the first job there may be no database yet
        kit.expect_clean(data, session.acked(), killed=True)
    with kit.Daemon(data, "--workers", "1") as daemon:
        session.run(daemon.address)
        kit.expect(daemon.stop() == 0, "the daemon did not stop in order")
    kit.expect_clean(data, session.acked())
    kit.expect([result["state"] for result in session.results.values()].count("succeeded") == 2, f"{session.results}")
    return True


def await_no_files(data, daemon):
    # There is no event for it. Ends when the daemon has died, too.
    while daemon.process.poll() is None and any((data / "jobs").iterdir()):
        time.sleep(0.02)


def crash_while_removing(data, mesh, point):
    """As crash_and_recover, of a daemon that keeps no results: the next one ends what was begun, and no id is forgotten."""
    session = Session(mesh)
    with kit.Daemon(data, "--workers", "1") as daemon:
        session.run(daemon.address)
    os.environ["SCULPT_CRASH_AT"] = point
    try:
        daemon = kit.Daemon(data, "--keep-bytes", "0")
    finally:
        del os.environ["SCULPT_CRASH_AT"]
    await_no_files(data, daemon)
    if daemon.stop() != -signal.SIGKILL:
        return False
    kit.expect_clean(data, session.acked(), killed=True)
    with kit.Daemon(data, "--keep-bytes", "0") as daemon, sculpt.Client(daemon.address) as client:
        await_no_files(data, daemon)
        told = {job: state_or_error(client, job) for job in session.results}
        wanted = {job: "gone" if result["state"] == "succeeded" else result["state"] for job, result in session.results.items()}
        kit.expect(told == wanted, f"{told}, not {wanted}")
    kit.expect_clean(data, session.acked())
    return True


def state_or_error(client, job):
    try:
        return client.call("job.get", job=job)["state"]
    except sculpt.Failure as failure:
        return failure.code


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--visits", type=int, default=2, help="die at the first, second, ... of so many visits of a point")
    arguments = parser.parse_args()
    mesh, unvisited, crashes = kit.ball(), [], 0
    for name in crash_points():
        for visit in range(1, arguments.visits + 1):
            with kit.scratch_folder() as folder:
                try:
                    crash = crash_while_removing if name in REMOVING else crash_and_recover
                    reached = crash(folder / "data", mesh, f"{name}:{visit}")
                except AssertionError as error:
                    raise AssertionError(f"{name}:{visit}: {error}") from error
            crashes += reached
            if not reached:
                unvisited += [name] if visit == 1 else []
                break
    kit.expect(not unvisited, f"these crash points were never visited: {unvisited}")
    print(f"{crashes} crashes at {len(crash_points())} points: nothing lost")


if __name__ == "__main__":
    main()
