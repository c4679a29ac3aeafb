"""What the torture programs share. They are run by ctest in a short form and by hand in a long one, each with --help.

By hand they take the programs of build/release, or those that SCULPTD and SCULPT name.
"""

import contextlib
import hashlib
import os
import pathlib
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
os.environ.setdefault("SCULPT_SOURCE", str(SOURCE))
for program in ("sculptd", "sculpt"):
    os.environ.setdefault(program.upper(), str(SOURCE / "build/release/bin" / program))
os.environ.setdefault("SCULPT_DISK_FAULT", str(SOURCE / "build/release/tests/torture/libdisk_fault.so"))
os.environ["SCULPT_CACHE"] = ""  # nothing of another run, nothing in the home of who runs the tests
os.environ.setdefault("SCULPT_CELLS", str(SOURCE / "config/cells"))
sys.path.insert(0, str(SOURCE / "tests/clients"))

from harness import Daemon  # noqa: E402
import sculpt  # noqa: E402
import shapes  # noqa: E402
import invariants  # noqa: E402

SKIPPED = 77  # ctest shows such an end as a skipped test


@contextlib.contextmanager
def scratch_folder():
    with tempfile.TemporaryDirectory(prefix="sculpt-torture-") as folder:
        yield pathlib.Path(folder)


def ball():
    """The bytes of a small mesh that every cell can carve."""
    with scratch_folder() as folder:
        return shapes.write_stl(folder / "ball.stl", shapes.ball()).read_bytes()


def spec(mesh, robot="gantry", resolution=8, **fields):
    """The spec of a job for an uploaded mesh."""
    return {"mesh": {"blob": hashlib.sha256(mesh).hexdigest(), "name": "ball.stl"}, "robot": robot, "resolution": resolution, **fields}


def trajectory_sha256(client, job):
    """The hash of a finished job's trajectory, as the server tells it."""
    artifacts = client.call("artifact.list", job=job)["artifacts"]
    return next(artifact["sha256"] for artifact in artifacts if artifact["artifact"] == "trajectory")


def all_jobs(client):
    jobs, more = [], True
    while more:
        page = client.call("job.list", limit=1000, **({"after": jobs[-1]["job"]} if jobs else {}))
        jobs, more = jobs + page["jobs"], page["more"]
    return jobs


def expect(holds, sentence):
    """A check that is there whatever flags Python runs with."""
    if not holds:
        raise AssertionError(sentence)


def expect_clean(data, acked=(), killed=False):
    found = invariants.breaches(data, acked, killed)
    expect(not found, "\n".join(found))


def skip(why):
    print("skipped: " + why)
    sys.exit(SKIPPED)
