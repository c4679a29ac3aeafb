#!/usr/bin/env python3
"""Cuts the power: at a chance moment all that the daemon wrote and did not sync is undone and the daemon is killed.

Every second seed tears: half of the newest write stays, in whole sectors. What a client was told must be there afterwards, the database
must be sound, and the next daemon must finish every job.
"""

import argparse
import collections
import os
import random

import kit
from crash_points import Session
from kit import sculpt

HUGE = 10 ** 9


def run_with_cut(data, session, cut_at, tear, lies=False):
    """Plays the session on a daemon whose power is cut before that operation. Gives the number of operations that there were."""
    count_file = data.parent / "count"
    fault = {"LD_PRELOAD": os.environ["SCULPT_DISK_FAULT"], "SCULPT_FAULT_ROOT": str(data), "SCULPT_POWER_CUT": str(cut_at),
             "SCULPT_TEAR": str(int(tear)), "SCULPT_SYNC_LIES": str(int(lies)),
             "SCULPT_COUNT_FILE": str(count_file)}
    before = dict(os.environ)
    os.environ.update(fault)
    try:
        daemon = kit.Daemon(data, "--workers", "2", "--isolate", "false")
    except AssertionError:
        daemon = None  # the power was cut before it could say where it listens
    finally:
        for name in fault:
            os.environ.pop(name)
        os.environ.update(before)
    if daemon:
        try:
            session.run(daemon.address)
        except (sculpt.Failure, OSError, ValueError):
            pass
        daemon.stop()
    return int(count_file.read_text().split()[0])


def cut_and_recover(data, mesh, cut_at, tear, lies=False):
    session = Session(mesh)
    run_with_cut(data, session, cut_at, tear, lies)
    with kit.Daemon(data, "--workers", "2") as daemon:
        session.run(daemon.address)
        kit.expect(daemon.stop() == 0, "the daemon did not stop in order")
    kit.expect_clean(data, session.acked())
    kit.expect([result["state"] for result in session.results.values()].count("succeeded") == 2, f"{session.results}")


def find_loss(mesh, operations):
    """A disk that only says that it syncs must be found out: else this test could not fail."""
    for seed in range(1, 11):
        with kit.scratch_folder() as folder:
            try:
                cut_and_recover(folder / "data", mesh, random.Random(seed).randint(operations // 2, operations), False, lies=True)
            except (AssertionError, sculpt.Failure):
                return
    raise AssertionError("syncs were not done and nothing was found to be lost")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=6)
    parser.add_argument("--first", type=int, default=1, help="the first seed")
    arguments = parser.parse_args()
    mesh = kit.ball()
    with kit.scratch_folder() as folder:
        operations = run_with_cut(folder / "data", Session(mesh), HUGE, False)
    kit.expect(operations > 50, f"only {operations} operations were seen: the library does not see what the daemon writes")
    find_loss(mesh, operations)
    cuts = collections.Counter()
    for seed in range(arguments.first, arguments.first + arguments.seeds):
        cut_at = random.Random(seed).randint(1, operations)
        with kit.scratch_folder() as folder:
            try:
                cut_and_recover(folder / "data", mesh, cut_at, seed % 2)
            except AssertionError as error:
                raise AssertionError(f"seed {seed}, power cut before operation {cut_at} of {operations}: {error}") from error
        cuts[bool(seed % 2)] += 1
    print(f"{cuts[False]} power cuts, {cuts[True]} more with a torn write, in about {operations} operations: nothing lost")


if __name__ == "__main__":
    main()
