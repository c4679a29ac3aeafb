#!/usr/bin/env python3
"""Kills the daemon (now and then stops it in order) at chance moments of one long job after another: each ends with the bytes of one that nobody disturbed."""

import argparse
import random
import statistics
import time

import kit
from kit import sculpt


class Life:
    """A daemon with one job, and the seconds that the job ran in it."""

    def __init__(self, data, mesh, spec, key):
        self.daemon = kit.Daemon(data, "--workers", "1")
        with sculpt.Client(self.daemon.address) as client:
            client.upload(mesh)
            self.job = client.submit(spec, key=key)["job"]
        self.started = time.monotonic()

    def run_until_killed(self, after_s, end):
        """Whether the job was disturbed by `end`, a method of the daemon; else it had ended."""
        with sculpt.Client(self.daemon.address) as client:
            ended = client.call("job.wait", job=self.job, timeout_s=after_s)["state"] == "succeeded"
        if not ended:
            end(self.daemon)
        return not ended

    def end(self):
        """(hash of the trajectory, seconds) of the job."""
        with self.daemon, sculpt.Client(self.daemon.address) as client:
            ended = client.wait(self.job)
            seconds = time.monotonic() - self.started
            kit.expect(ended["state"] == "succeeded", f"job {self.job} is {ended['state']}: {ended.get('error')}")
            return kit.trajectory_sha256(client, self.job), seconds


def torture(data, mesh, spec, kills, chance):
    """Seconds of the undisturbed job, and of each disturbed one with how often it was."""
    wanted, whole_s = Life(data, mesh, spec, "undisturbed").end()
    jobs, left = [], kills
    while left > 0:
        seconds, count, key = 0.0, 0, f"job {len(jobs)}"
        while True:
            life = Life(data, mesh, spec, key)
            killed = left > 0 and life.run_until_killed(chance.uniform(0, whole_s), chance.choice([kit.Daemon.kill, kit.Daemon.kill, kit.Daemon.stop]))
            if not killed:
                break
            seconds, count, left = seconds + time.monotonic() - life.started, count + 1, left - 1
        got, last_s = life.end()
        kit.expect(got == wanted, f"{key} has the trajectory {got} after {count} kills, not {wanted}")
        jobs.append((seconds + last_s, count))
    return whole_s, jobs


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=2, help="of each kind of job")
    parser.add_argument("--octree", type=int, default=16, help="resolution of the octree jobs")
    parser.add_argument("--sweep", type=int, default=64, help="resolution of the sweep jobs")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    chance, mesh = random.Random(arguments.seed), kit.ball()
    print(f"seed {arguments.seed}")
    for search in ("octree", "sweep"):
        with kit.scratch_folder() as folder:
            spec = kit.spec(mesh, "panda-turntable", getattr(arguments, search), search=search)
            whole_s, jobs = torture(folder / "data", mesh, spec, arguments.kills, chance)
            kit.expect_clean(folder / "data", killed=True)
        again = [(seconds - whole_s) / count for seconds, count in jobs if count > 0]
        print(f"{search}: {whole_s:.1f} s undisturbed; {len(jobs)} jobs killed {arguments.kills} times have the same bytes"
              + (f"; {statistics.mean(again):.2f} s more for each kill, at most {max(again):.2f}" if again else ""))


if __name__ == "__main__":
    main()
