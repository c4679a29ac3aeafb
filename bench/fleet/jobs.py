#!/usr/bin/env python3
"""Jobs a second of 1, 2 and 4 daemons with one worker each that share a queue: jobs so small that the queue is the work.

    tests/fleet/with_postgres --durable bench/fleet/jobs.py [--jobs N] [--daemons 1 2 4]
"""

import argparse
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests/fleet"))
import torture  # noqa: E402
from torture import kit, sculpt  # noqa: E402


def measure(count, jobs):
    torture.psql("SET client_min_messages=warning; DROP SCHEMA IF EXISTS sculptd CASCADE")
    mesh = kit.ball()
    with kit.scratch_folder() as scratch:
        members = [torture.Member(scratch, number, "--isolate", "false") for number in range(count)]
        for member in members:
            member.start()
        with sculpt.Client(members[0].address) as client:
            client.upload(mesh)
            client.call("queue.pause")
            names = [client.submit(kit.spec(mesh), key=str(number))["job"] for number in range(jobs)]
            begun = time.monotonic()
            client.call("queue.resume")
            for name in names:
                kit.expect(client.wait(name)["state"] == "succeeded", f"job {name} failed")
            seconds = time.monotonic() - begun
        twice = torture.psql("SELECT count(*) FROM sculptd.job WHERE attempt<>1")[0][0]
        for member in members:
            member.daemon.stop()
    print(f"{count} daemons: {jobs / seconds:.1f} jobs a second, {twice} claimed more than once")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=300)
    parser.add_argument("--daemons", type=int, nargs="+", default=[1, 2, 4])
    arguments = parser.parse_args()
    for count in arguments.daemons:
        measure(count, arguments.jobs)


if __name__ == "__main__":
    main()
