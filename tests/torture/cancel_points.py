#!/usr/bin/env python3
"""Cancels running jobs at chance moments: each ends as cancelled (or had ended), and its worker takes the next job."""

import argparse
import collections
import random
import time

import kit
from kit import sculpt


def cancel_one(client, spec, wait_s):
    """How the job ended, and the seconds from the cancel to the end."""
    job = client.submit(spec)["job"]
    time.sleep(wait_s)
    started = time.monotonic()
    try:
        client.call("job.cancel", job=job)
    except sculpt.Failure as failure:
        kit.expect(failure.code == "wrong_state", str(failure))
    state = client.wait(job)["state"]
    return job, state, time.monotonic() - started


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cancels", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    chance, mesh, ends, longest = random.Random(arguments.seed), kit.ball(), collections.Counter(), 0.0
    print(f"seed {arguments.seed}")
    with kit.scratch_folder() as folder:
        data, told = folder / "data", []
        with kit.Daemon(data, "--workers", "1") as daemon, sculpt.Client(daemon.address) as client:
            client.upload(mesh)
            for n in range(arguments.cancels):
                robot, resolution, lasts_s = chance.choice([("panda-turntable", 16, 0.6), ("panda-turntable", 32, 2.0), ("gantry", 32, 0.6)])
                job, state, seconds = cancel_one(client, kit.spec(mesh, robot, resolution, seed=n), chance.uniform(0, lasts_s))
                kit.expect(state in ("cancelled", "succeeded"), f"job {job} is {state}")
                ends[state], longest = ends[state] + 1, max(longest, seconds)
                told.append({"job": job, "state": state})
            free = client.submit(kit.spec(mesh))["job"]
            kit.expect(client.wait(free)["state"] == "succeeded", "the worker did not take another job")
            kit.expect(daemon.stop() == 0, "the daemon did not stop in order")
        kit.expect_clean(data, told)
    print(f"{ends['cancelled']} cancelled, {ends['succeeded']} had ended; at most {longest:.3f} s from cancel to end")


if __name__ == "__main__":
    main()
