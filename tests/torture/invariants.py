#!/usr/bin/env python3
"""What must hold in the data folder of a daemon that does not run, whatever was done to it before.

    invariants.py DATA [--acked FILE] [--killed]
FILE: one JSON object a line, what a client was told: {"job":ID,"key"?:KEY,"state"?:STATE,"sha256"?:HASH of the trajectory}.
--killed: the daemon did not stop in order, so jobs may stand as running and drafts of files may lie about.
Prints one line a breach and exits with 1 if there is one.
"""

import argparse
import collections
import contextlib
import fcntl
import hashlib
import json
import pathlib
import re
import sqlite3
import sys

ACTIVE = {"running", "pausing", "cancelling"}
FINAL = {"succeeded", "failed", "expired", "cancelled"}  # a job that crashed or whose result was damaged can be retried
# From each state, for which reason, to which (PROTOCOL.md, "The life of a job").
MOVES = {None: {"submitted": {"held", "queued"}},
         "held": {"due": {"queued"}, "start_by_passed": {"expired"}, "pause_requested": {"paused"}, "cancel_requested": {"cancelled"}},
         "queued": {"claimed": {"running"}, "start_by_passed": {"expired"}, "pause_requested": {"paused"}, "cancel_requested": {"cancelled"}},
         "running": {"finished": {"succeeded", "failed"}, "interrupted": {"queued"}, "failed": {"backoff"}, "crashed": {"backoff", "quarantined"},
                     "pause_requested": {"pausing"}, "cancel_requested": {"cancelling"}},
         "pausing": {"finished": {"succeeded", "failed"}, "interrupted": {"paused"}, "failed": {"paused"}, "crashed": {"paused", "quarantined"},
                     "cancel_requested": {"cancelling"}},
         "paused": {"resumed": {"queued", "held"}, "cancel_requested": {"cancelled"}},
         "backoff": {"due": {"queued"}, "pause_requested": {"paused"}, "cancel_requested": {"cancelled"}},
         "cancelling": {"finished": {"cancelled"}},
         "quarantined": {"retried": {"queued"}}, "succeeded": {"retried": {"queued"}}, "failed": {"retried": {"queued"}}}
STATES = (MOVES.keys() - {None}) | FINAL
MARK = re.compile(r"sculptd-mark 1 store (\w+) changes (\d+) check [0-9a-f]{8}\n")


class DaemonRuns(Exception):
    """The folder is in use, so nothing can be said about it."""


def breaches(data, acked=(), killed=False):
    """A list of sentences, empty if all is well. `acked` as in the FILE above. Raises DaemonRuns."""
    data = pathlib.Path(data)
    with (data / "lock").open() as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise DaemonRuns(f"a daemon uses {data}: stop it first") from None
        with contextlib.closing(sqlite3.connect(data / "sculptd.db")) as database:
            database.row_factory = sqlite3.Row
            return [*check_database(database), *check_mark(database, data), *check_jobs(database, killed), *check_events(database), *check_artifacts(database, data),
                    *check_acked(database, acked), *check_blobs(database, data), *check_files(data, killed)]


def check_database(database):
    verdict = [row[0] for row in database.execute("PRAGMA integrity_check")]
    if verdict != ["ok"]:
        yield f"integrity_check: {verdict}"
    if list(database.execute("PRAGMA foreign_key_check")):
        yield "foreign_key_check: rows without the job that they belong to"


def check_mark(database, data):
    """The mark names this store, and knows no more than it."""
    lines = MARK.findall((data / "sculptd.mark").read_text())
    if not lines:
        yield "sculptd.mark cannot be read"
        return
    facts = dict(database.execute("SELECT name, value FROM meta"))
    if {store for store, _ in lines} != {facts["epoch"]}:
        yield f"sculptd.mark is of another store: {lines}"
    if max(int(changes) for _, changes in lines) > int(facts.get("changes", 0)):
        yield f"the database knows fewer changes than sculptd.mark: {facts.get('changes')}, {lines}"


def check_jobs(database, killed):
    """Every job is in one known state, and none is in the hands of a worker that is gone."""
    counts = collections.Counter(row["state"] for row in database.execute("SELECT state FROM job"))
    for state in counts.keys() - STATES:
        yield f"{counts[state]} jobs are in the unknown state {state!r}"
    for row in database.execute("SELECT id FROM job JOIN removed USING(id)"):
        yield f"job {row['id']} was removed and is still there"
    submitted = database.execute("SELECT count(*) FROM event WHERE data ->> 'reason' = 'submitted'").fetchone()[0]
    if submitted != sum(counts.values()):
        yield f"{submitted} jobs were submitted, but there are {sum(counts.values())}: {dict(counts)}"
    for job in database.execute("SELECT id, state, wake_at, finished_at FROM job"):
        if (job["wake_at"] != "") != (job["state"] in {"held", "backoff"}):
            yield f"job {job['id']}: it is {job['state']} and waits for the time {job['wake_at']!r}"
        if (job["finished_at"] != "") != (job["state"] in FINAL | {"quarantined"}):
            yield f"job {job['id']}: it is {job['state']} and ended at {job['finished_at']!r}"
    if not killed:
        for state in ACTIVE & counts.keys():
            yield f"{counts[state]} jobs are {state}, but no daemon runs"


def check_events(database):
    """Numbered 1, 2, 3...; each goes on from where the one before ended; the last is the job's state; nothing follows a final one,
    and each says a reason that there is for it."""
    for job in database.execute("SELECT number, id, state FROM job ORDER BY number").fetchall():
        events = database.execute("SELECT seq, state, data FROM event WHERE job=? ORDER BY seq", (job["number"],)).fetchall()
        if [event["seq"] for event in events] != list(range(1, len(events) + 1)):
            yield f"job {job['id']}: its events are numbered {[event['seq'] for event in events]}"
        state, attempt = None, 0
        for event in events:
            data = json.loads(event["data"])
            if data.get("from") != state or data["to"] != event["state"]:
                yield f"job {job['id']}: event {event['seq']} goes from {data.get('from')} to {data['to']} in the state {state}"
            if state in FINAL and data.get("reason") != "retried":
                yield f"job {job['id']}: it ended as {state}, and then event {event['seq']} made it {data['to']}"
            elif data["to"] not in MOVES.get(state, {}).get(data.get("reason"), ()):
                yield f"job {job['id']}: event {event['seq']} makes it {data['to']} from {state} because it is {data.get('reason')}"
            attempt += data["to"] == "running"
            if data.get("attempt", 0) != attempt:
                yield f"job {job['id']}: event {event['seq']} speaks of attempt {data.get('attempt', 0)}, not {attempt}"
            if data["to"] == "expired" and attempt:
                yield f"job {job['id']}: it expired though it had run"
            state = event["state"]
        if state != job["state"]:
            yield f"job {job['id']}: it is {job['state']}, its last event says {state}"


def check_artifacts(database, data):
    """Every file that the database knows is there with its size and hash; every succeeded job has a trajectory."""
    for row in database.execute("SELECT id, artifact, format, size, sha256 FROM artifact JOIN job ON artifact.job = job.number"):
        path = data / "jobs" / row["id"] / f"{row['artifact']}.{row['format']}"
        content = path.read_bytes() if path.is_file() else None
        if content is None:
            yield f"job {row['id']}: {path} is missing"
        elif (len(content), hashlib.sha256(content).hexdigest()) != (row["size"], row["sha256"]):
            yield f"job {row['id']}: {path} is not the file that was stored"
    for row in database.execute("SELECT id FROM job WHERE state='succeeded' AND NOT EXISTS "
                                "(SELECT 1 FROM artifact WHERE artifact.job = job.number AND artifact='trajectory')"):
        yield f"job {row['id']}: it succeeded, but has no trajectory"


def check_acked(database, acked):
    for record in acked:
        job = database.execute("SELECT number, state, key FROM job WHERE id=?", (record["job"],)).fetchone()
        if job is None:
            if database.execute("SELECT 1 FROM removed WHERE id=?", (record["job"],)).fetchone() and record.get("state", "succeeded") in FINAL:
                continue  # its time of keeping was over
            yield f"job {record['job']} was acknowledged and is lost"
            continue
        if record.get("key") not in (None, job["key"]):
            yield f"job {record['job']} was acknowledged for the key {record['key']!r}, but is stored with {job['key']!r}"
        if record.get("state") in FINAL and record["state"] != job["state"]:
            yield f"job {record['job']} was said to have {record['state']}, but is {job['state']}"
        if "sha256" in record:
            stored = database.execute("SELECT sha256 FROM artifact WHERE job=? AND artifact='trajectory'", (job["number"],)).fetchone()
            if stored is None or stored["sha256"] != record["sha256"]:
                yield f"job {record['job']}: its trajectory is not the one that a client was told of"


def check_blobs(database, data):
    """What a job was submitted with is there as long as the job."""
    for row in database.execute("SELECT id, cell_bundle, spec ->> '$.mesh.blob' AS mesh, inherited FROM job"):
        left = [clamping["left"] for clamping in json.loads(row["inherited"] or "{}").get("clampings", [])]
        for blob in (row["mesh"], row["cell_bundle"], *left):
            if not (data / "blobs" / blob[:2] / blob).is_file():
                yield f"job {row['id']}: its blob {blob} is missing"


def check_files(data, killed):
    """Blobs are what they are called; no draft of a file is left."""
    for blob in (data / "blobs").glob("??/*"):
        if hashlib.sha256(blob.read_bytes()).hexdigest() != blob.name:
            yield f"the blob {blob} does not have the hash that it is named by"
    if not killed:
        for draft in data.glob("**/*.draft"):
            yield f"{draft} was left behind"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--acked", type=pathlib.Path)
    parser.add_argument("--killed", action="store_true")
    arguments = parser.parse_args()
    acked = [json.loads(line) for line in arguments.acked.open()] if arguments.acked else []
    try:
        found = breaches(arguments.data, acked, arguments.killed)
    except (OSError, DaemonRuns) as error:
        sys.exit(f"invariants: {error}")
    for sentence in found:
        print(sentence)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
