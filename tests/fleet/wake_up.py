#!/usr/bin/env python3
"""How soon a daemon takes a job that another one was given: undisturbed, with its connections cut every five seconds, with
connections that are half gone, and after a restart of the database. In seconds, so by hand and not as a test:

    tests/fleet/with_postgres [--durable] tests/fleet/wake_up.py [--rounds N]

Ends with 1 where a job waits for longer than 5 s, or where it takes longer than 15 s until a daemon behind connections that
are half gone has new ones and hears at once again.
"""

import argparse
import pathlib
import statistics
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import outage_test  # noqa: E402
import torture  # noqa: E402
from torture import kit, sculpt  # noqa: E402

WAKE_S, LISTENER_S, CUT_EVERY_S = 5, 15, 5


class Pair:
    """A daemon that only answers, and one behind a proxy that does the work."""

    def __init__(self, scratch):
        self.proxy = outage_test.Proxy()
        shared = ["--shared", str(scratch / "shared"), "--lease-s", "30"]
        self.front = kit.Daemon(scratch / "front", "--store", torture.POSTGRES, "--queues", "[]", *shared)
        self.worker = kit.Daemon(scratch / "worker", "--store", self.proxy.address, "--workers", "1", "--isolate", "false", *shared)
        self.mesh = kit.ball()
        self.number = 0
        torture.patiently(lambda: self.ask(lambda client: client.upload(self.mesh)))
        self.wake()  # the mesh is checked once, and the worker has been heard of

    def ask(self, work):
        with sculpt.Client(self.front.address) as client:
            return work(client)

    def wake(self):
        """Seconds from the acknowledged submit to the claim, by the database's clock."""
        self.number += 1
        job = torture.patiently(lambda: self.ask(lambda client: client.submit(kit.spec(self.mesh, seed=self.number), key=f"wake-{self.number}")["job"]))
        ended = torture.patiently(lambda: self.ask(lambda client: client.wait(job)))
        kit.expect(ended["state"] == "succeeded", f"job {job} is {ended['state']}: {ended.get('error')}")
        return float(torture.patiently_psql(
            f"SELECT extract(epoch FROM started_at::timestamptz - submitted_at::timestamptz) FROM sculptd.job WHERE id='{job}'")[0][0])

    def stop(self):
        self.worker.stop()
        self.front.stop()
        self.proxy.close()


def told(what, times, limit):
    print(f"{what:<40} {len(times):4} jobs   median {statistics.median(times):6.3f} s   longest {max(times):6.3f} s   (at most {limit})", flush=True)
    return max(times) <= limit


def cut_again_and_again(stop):
    while not stop.wait(CUT_EVERY_S):
        torture.patiently_psql("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid<>pg_backend_pid() AND backend_type='client backend'")


def with_cuts(pair, rounds):
    stop = threading.Event()
    cutter = threading.Thread(target=cut_again_and_again, args=(stop,))
    cutter.start()
    try:
        times = []
        for _ in range(rounds):
            times.append(pair.wake())
            time.sleep(0.5)
        return times
    finally:
        stop.set()
        cutter.join()


def behind_half_gone(pair):
    """The wake-up right after the connections were frozen, and how long it took until all four are made anew and a job is heard of at once."""
    made = pair.proxy.made
    pair.proxy.freeze()
    begun = time.monotonic()
    first = pair.wake()
    while pair.proxy.made < made + 3 or pair.wake() > 0.5:
        if time.monotonic() - begun > 60:
            break
        time.sleep(0.05)
    return first, time.monotonic() - begun


def after_restart(pair):
    torture.control("restart", "-m", "fast")
    return pair.wake()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=20)
    arguments = parser.parse_args()
    if not torture.POSTGRES:
        parser.error("run it with tests/fleet/with_postgres")
    with kit.scratch_folder() as scratch:
        pair = Pair(scratch)
        try:
            fine = told("undisturbed", [pair.wake() for _ in range(arguments.rounds)], WAKE_S)
            fine &= told("connections cut every 5 s", with_cuts(pair, arguments.rounds * 2), WAKE_S)
            firsts, anew = zip(*(behind_half_gone(pair) for _ in range(max(1, arguments.rounds // 4))))
            fine &= told("connections half gone", firsts, WAKE_S)
            fine &= told("until it hears at once again", anew, LISTENER_S)
            fine &= told("database restarted", [after_restart(pair) for _ in range(max(1, arguments.rounds // 4))], WAKE_S)
        finally:
            pair.stop()
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
