#!/usr/bin/env python3
"""Two versions of the daemon side by side over one database whose tables the newer one has brought up to date.

    tests/fleet/with_postgres tests/fleet/rolling_update.py --old SCULPTD

SCULPTD is a daemon of an older version of the tables, its cells and its worker beside it: tests/fleet/older_sculptd builds one.
"""

import argparse
import os
import pathlib
import sys
import time
import urllib.error
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import torture  # noqa: E402
from torture import kit, sculpt  # noqa: E402


def start(program, data, shared):
    """A daemon of this program."""
    before = os.environ["SCULPTD"]
    os.environ["SCULPTD"] = program
    try:
        return kit.Daemon(data, "--store", torture.POSTGRES, "--shared", str(shared), "--lease-s", "5", "--workers", "1")
    finally:
        os.environ["SCULPTD"] = before


def readiness(daemon):
    try:
        with urllib.request.urlopen(f"http://{daemon.address}/readyz") as reply:
            return reply.read().decode()
    except urllib.error.HTTPError as error:
        return error.read().decode()


def version():
    return torture.psql("SELECT value FROM sculptd.meta WHERE name='schema'")[0][0]


def await_state(client, job, state):
    while (now := client.call("job.get", job=job))["state"] != state:
        kit.expect(now["state"] in ("queued", "running"), f"job {job} is {now['state']}: {now.get('error')}")
        time.sleep(0.05)


def ended_well(client, job):
    ended = client.wait(job)
    kit.expect(ended["state"] == "succeeded", f"job {job} is {ended['state']}: {ended.get('error')}")
    return kit.trajectory_sha256(client, job)


def update(old_program, scratch):
    shared, mesh = scratch / "shared", kit.ball()
    small, long = kit.spec(mesh, "panda-turntable", 16), kit.spec(mesh, "panda-turntable", 64)
    old = start(old_program, scratch / "old", shared)
    before = version()
    with sculpt.Client(old.address) as client:
        client.upload(mesh)
        first = client.submit(small)["job"]
        as_old = ended_well(client, first)
        running = client.submit(long)["job"]
        await_state(client, running, "running")

        new = start(os.environ["SCULPTD"], scratch / "new", shared)
        kit.expect(version() > before, f"both daemons know version {before} of the tables: --old is not older")
        print(f"tables of version {before} brought to {version()} while the older daemon ran a job", flush=True)
        ended_well(client, running)
        kit.expect(client.call("job.get", job=running)["attempt"] == 1, "the older daemon did not end its run")

        handed = client.submit(small, key="through the older one")["job"]
        kit.expect(ended_well(client, handed) == as_old, "the newer daemon comes to other bytes")
        while "update it" not in (said := readiness(old)):
            time.sleep(0.1)
        print(f"the older one answers, takes no more, and says: {said.strip()}", flush=True)
        with sculpt.Client(new.address) as newer:
            kit.expect("ready" in readiness(new), readiness(new))
            for client_of in (client, newer):
                kit.expect({job["job"] for job in kit.all_jobs(client_of)} == {first, running, handed}, "a daemon does not know all jobs")
            paused = newer.submit(long, key="cancelled through the older one")["job"]
            await_state(newer, paused, "running")
            client.call("job.cancel", job=paused)
            kit.expect(newer.wait(paused)["state"] == "cancelled", "a cancel through the older daemon did nothing")
    kit.expect(old.stop() == 0, "the older daemon did not stop in order:\n" + old.log())
    try:
        start(old_program, scratch / "old", shared)
        raise SystemExit("the older daemon started over tables that are newer than it")
    except AssertionError as error:
        kit.expect("start a newer sculptd" in str(error), str(error))
    kit.expect(new.stop() == 0, new.log())
    print("started again, the older one refuses tables that are newer than it")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--old", required=True)
    arguments = parser.parse_args()
    if not torture.POSTGRES:
        parser.error("run it with tests/fleet/with_postgres")
    with kit.scratch_folder() as scratch:
        update(arguments.old, scratch)


if __name__ == "__main__":
    main()
