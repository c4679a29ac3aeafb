#!/usr/bin/env python3
"""Random requests, good and bad, on several connections, against a model of what each must be answered with.

Now and then the process of a job is killed, or the daemon is stopped or killed and started again. The model is one file
on purpose: it is read as a whole beside PROTOCOL.md.
"""

import argparse
import collections
import contextlib
import datetime
import hashlib
import json
import os
import pathlib
import random
import signal
import time
import zlib

import kit
from kit import sculpt

FINAL = ("succeeded", "failed", "quarantined", "expired", "cancelled")
# What becomes of a job by itself. Every job here can be planned, so none fails.
AUTO = {"held": {"queued", "expired"}, "queued": {"running", "expired"}, "running": {"succeeded"}, "pausing": {"paused", "succeeded"},
        "backoff": {"queued"}, "cancelling": {"cancelled"}}
CRASHED = {"running": {"backoff", "quarantined"}, "pausing": {"paused", "quarantined"}}  # its process was killed
INTERRUPTED = {"running": {"queued"}, "pausing": {"paused"}}  # the daemon ended
# What a command makes of a job; all else is `wrong_state`.
COMMANDS = {"job.cancel": {"held": "cancelled", "queued": "cancelled", "backoff": "cancelled", "paused": "cancelled", "running": "cancelling",
                           "pausing": "cancelling", "cancelling": "cancelling", "cancelled": "cancelled"},
            "job.pause": {"held": "paused", "queued": "paused", "backoff": "paused", "paused": "paused", "running": "pausing", "pausing": "pausing"},
            "job.resume": {"paused": "queued", "held": "held", "queued": "queued", "backoff": "backoff", "running": "running"},
            "job.retry": {"quarantined": "queued"}}
FAR_S = 86400


def utc(seconds):
    return datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).isoformat(timespec="milliseconds").replace("+00:00", "Z")


class Connection:
    """Sends a line, takes its reply; events that come between are checked."""

    def __init__(self, address):
        self.client = sculpt.Client(address)
        self.stream, self.seen = self.client.stream, {}  # job -> seq of its last event here

    def exchange(self, line, chunk=None):
        """The reply to one line, and the chunk behind it if it has one."""
        self.stream.write(line + b"\n" + (b"" if chunk is None else chunk + b"\n"))
        self.stream.flush()
        while True:
            message = json.loads(self.stream.readline())
            if message.get("method") != "event":
                break
            self.take_event(message["params"])
        result = message.get("result", {})
        bulk = self.stream.read(result["bytes"] + 1)[:-1] if "crc32" in result else None
        return message, bulk

    def take_event(self, event):
        """Durable events of a subscription come without gaps."""
        if "seq" in event:
            before = self.seen.get(event["job"])
            kit.expect(before is None or event["seq"] == before + 1, f"{event} came after {before}")
            self.seen[event["job"]] = event["seq"]


class Model:
    """What the server must know, and the random client that asks for it."""

    def __init__(self, data, seed, mesh):
        self.data, self.random, self.mesh, self.daemon = data, random.Random(seed), mesh, None
        self.jobs, self.states, self.keys = [], {}, {}  # ids in order; id -> last state seen; key -> (spec, id)
        self.times = {}  # id -> (not_before, start_by), seconds since 1970
        self.queue_paused, self.still = False, set()  # jobs that were seen since the queue is paused: none of them starts
        self.kills, self.struck = 0, set()  # processes of jobs that were killed; jobs that one of them may have belonged to
        self.blobs, self.next_id = {}, 1000  # blob -> bytes that the server has
        self.contents = {hashlib.sha256(content).hexdigest(): content for content in (bytes([n]) * (7 * n + 1) for n in range(40))}
        self.answers = collections.Counter()
        steps = {self.submit: 4, self.submit_again: 4, self.submit_badly: 4, self.get: 20, self.list: 8, self.command: 12, self.wait: 6,
                 self.subscribe: 4, self.unsubscribe: 4, self.read: 12, self.artifacts: 4, self.report: 4, self.put: 12, self.garbage: 12,
                 self.reconnect: 1, self.ping: 6, self.info: 2, self.pause_queue: 0.5, self.resume_queue: 2, self.kill_process: 1, self.restart: 0.1}
        self.steps, self.weights = list(steps), list(steps.values())
        self.start()

    def start(self):
        isolate = self.random.choice(["true", "false"])
        self.daemon = kit.Daemon(self.data, "--workers", "2", "--isolate", isolate, "--retry-backoff-s", "0.2")
        self.connections = [Connection(self.daemon.address) for _ in range(4)]
        self.connections[0].client.upload(self.mesh)

    def close(self):
        """Nothing is left running, however it went."""
        self.daemon.stop()

    def step(self):
        self.random.choices(self.steps, self.weights)[0](self.random.choice(self.connections))

    # --- what is known

    def next_states(self, job, state, more):
        not_before, start_by = self.times[job]
        states = AUTO.get(state, set()) | more.get(state, set()) | (CRASHED.get(state, set()) if job in self.struck else set())
        cannot = {"queued"} if state == "held" and not_before > time.time() else set()
        cannot |= {"expired"} if not start_by or start_by > time.time() else set()
        cannot |= {"running"} if job in self.still else set()
        return states - cannot

    def possible(self, job, more={}):  # noqa: B006
        """The states that the job may be in by now."""
        found, fresh = set(), {self.states[job]} if job in self.states else set()
        while fresh:
            found |= fresh
            fresh = {then for state in fresh for then in self.next_states(job, state, more)} - found
        return found

    def saw(self, job, state, more={}):  # noqa: B006
        kit.expect(state in self.possible(job, more), f"job {job} was {self.states[job]} and is {state}, not one of {self.possible(job, more)}")
        self.know(job, state)

    def know(self, job, state):
        self.states[job] = state
        if self.queue_paused:
            self.still.add(job)

    def some_job(self):
        return self.random.choice(self.jobs) if self.jobs and self.random.random() < 0.9 else "01ARZ3NDEKTSV4RRFFQ69G5FAV"

    def new_spec(self):
        seed = self.random.randrange(3)
        return kit.spec(self.mesh, seed=seed) if self.random.random() < 0.9 else kit.spec(self.mesh, "panda-turntable", 16, seed=seed)

    def new_times(self):
        """(not_before, start_by), 0 for none: mostly none, else past, near or far."""
        now = round(time.time(), 3)
        not_before, start_by = (now + self.random.choice([-1, 0.1, 1, FAR_S]) if self.random.random() < 0.2 else 0 for _ in range(2))
        return (not_before, start_by) if start_by > not_before else (not_before, 0)

    def call(self, connection, method, chunk=None, **params):
        """(word, result, bulk, both lines for people): the word of the error, or "fine"."""
        self.next_id += 1
        line = json.dumps({"id": self.next_id, "method": method, "params": params}).encode()
        message, bulk = connection.exchange(line, chunk)
        kit.expect(message["id"] == self.next_id, f"{line} was answered by {message}")
        word = message["error"]["data"]["code"] if "error" in message else "fine"
        self.answers[word] += 1
        return word, message.get("result"), bulk, f"{line}: {message}"

    def expect(self, answer, *words):
        kit.expect(answer[0] in words, f"one of {words} was expected, not {answer[3]}")
        return answer[1]

    # --- steps

    def ping(self, connection):
        kit.expect(self.expect(self.call(connection, "ping"), "fine") == {}, "ping")

    def info(self, connection):
        info = self.expect(self.call(connection, "server.info"), "fine")
        kit.expect(sum(info["jobs"].values()) == len(self.jobs), f"{info} does not count {len(self.jobs)} jobs")
        kit.expect(info["queue_paused"] == self.queue_paused, f"{info}")

    def submit(self, connection):
        key = f"key {len(self.keys)}"
        spec, (not_before, start_by), before = self.new_spec(), self.new_times(), time.time()
        times = {name: utc(at) for name, at in (("not_before", not_before), ("start_by", start_by)) if at}
        result = self.expect(self.call(connection, "job.submit", key=key, spec=spec, priority=self.random.randint(-100, 100), **times), "fine")
        kit.expect(not result["duplicate"] and result["job"] not in self.states and result["job"] > max(self.jobs, default=""), f"{result}")
        kit.expect(self.fits(result["state"], not_before, before), f"{result} with {times}")
        self.jobs.append(result["job"])
        self.times[result["job"]], self.keys[key] = (not_before, start_by), (spec, result["job"])
        self.know(result["job"], result["state"])

    @staticmethod
    def fits(state, not_before, before):
        """Whether a job that could wait for its time since `before` and until now waits as it should."""
        return state == "held" and not_before > before - 0.001 or state == "queued" and not_before <= time.time()

    def submit_again(self, connection):
        if not self.keys:
            return
        key = self.random.choice(list(self.keys))
        spec, (first, job) = self.new_spec(), self.keys[key]
        result = self.expect(self.call(connection, "job.submit", key=key, spec=spec), "fine" if spec == first else "key_conflict")
        if result:
            kit.expect(result["duplicate"] and result["job"] == job, f"{result} for the key of {job}")
            self.saw(job, result["state"])

    def submit_badly(self, connection):
        spec = self.new_spec()
        change, word = self.random.choice([({"resolution": 9}, "resolution_invalid"), ({"resolution": "8"}, "params_invalid"),
                                           ({"robot": "nobody"}, "cell_unknown"), ({"search": "guess"}, "search_unknown"),
                                           ({"sped": 1}, "params_invalid"), ({"seed": -1}, "params_invalid"), ({"threads": 0}, "params_invalid"),
                                           ({"mesh": {"blob": "0" * 64, "name": "x.stl"}}, "blob_missing")])
        self.expect(self.call(connection, "job.submit", spec={**spec, **change}), word)
        times = self.random.choice([{"not_before": "tomorrow"}, {"start_by": 5}, {"max_runtime_s": 0}, {"not_before": utc(9), "start_by": utc(9)}])
        self.expect(self.call(connection, "job.submit", spec=spec, **times), "params_invalid")

    def get(self, connection):
        job = self.some_job()
        result = self.expect(self.call(connection, "job.get", job=job), "fine" if job in self.states else "not_found")
        if result:
            self.saw(job, result["state"])
            state = result["state"]
            kit.expect(self.keys[result["key"]][1] == job, f"{result}")
            kit.expect(("until" in result) == (state in ("held", "backoff")) and ("position" in result) == (state == "queued"), f"{result}")
            kit.expect(("finished_at" in result) == (state in FINAL), f"{result}")
            code = {"expired": "expired", "quarantined": "planner_crashed", "backoff": "planner_crashed"}.get(state)
            kit.expect(not code or result["error"]["code"] == code, f"{result}")

    def list(self, connection):
        limit, newest = self.random.randint(1, 50), self.random.random() < 0.5
        after, before = (self.random.choice([*self.jobs[-60:], None]) for _ in range(2))
        bounds = {**({"after": after} if after else {}), **({"before": before} if before else {}), **({"order": "newest"} if newest else {})}
        result = self.expect(self.call(connection, "job.list", limit=limit, **bounds), "fine")
        within = [job for job in self.jobs if (not after or job > after) and (not before or job < before)][::-1 if newest else 1]
        kit.expect([job["job"] for job in result["jobs"]] == within[:limit] and result["more"] == (len(within) > limit), f"{result}")
        for job in result["jobs"]:
            self.saw(job["job"], job["state"])

    def command(self, connection):
        job, (method, becomes) = self.some_job(), self.random.choice(list(COMMANDS.items()))
        self.obey(connection, job, method, becomes)

    def obey(self, connection, job, method, becomes):
        before = time.time()
        answer = self.call(connection, method, job=job)
        states = self.possible(job)  # now, so that what happened until the reply is in it
        result = self.expect(answer, *({"fine" if state in becomes else "wrong_state" for state in states} or {"not_found"}))
        if result is None:
            return
        state, wanted = result["state"], {becomes[state] for state in states if state in becomes}
        if method == "job.resume" and "paused" in states and state not in wanted - {"queued"}:
            kit.expect(self.fits(state, self.times[job][0], before), f"{answer[3]}: {self.times[job]}")
        else:
            kit.expect(state in wanted, f"{answer[3]}: one of {wanted} was expected")
        self.know(job, state)

    def pause_queue(self, connection):
        kit.expect(self.expect(self.call(connection, "queue.pause"), "fine") == {"paused": True}, "queue.pause")
        self.queue_paused = True

    def resume_queue(self, connection):
        kit.expect(self.expect(self.call(connection, "queue.resume"), "fine") == {"paused": False}, "queue.resume")
        self.queue_paused = False
        self.still.clear()

    def will_end(self, job):
        """For certain, and soon."""
        held = self.states.get(job) == "held" and self.times[job][0] > time.time() + 2
        return not self.queue_paused and not held and not self.possible(job) & {"paused", "pausing"}

    def wait(self, connection):
        job = self.some_job()
        timeout_s = self.random.choice([0, 0, 0.01, 3600 if self.will_end(job) else 0])
        result = self.expect(self.call(connection, "job.wait", job=job, timeout_s=timeout_s), "fine" if job in self.states else "not_found")
        if result:
            self.saw(job, result["state"])
            kit.expect(result["timed_out"] == (result["state"] not in FINAL), f"{result}")
            kit.expect(timeout_s < 3600 or not result["timed_out"], f"{result} after {timeout_s} s")

    def subscribe(self, connection):
        job, after = self.some_job(), self.random.randint(0, 4)
        words = ["not_found"] if job not in self.states else ["fine"] if after <= 1 else ["fine", "replay_gap"]  # behind its last event
        result = self.expect(self.call(connection, "events.subscribe", job=job, after=after), *words)
        connection.seen.pop(job, None)  # what comes now belongs to the new subscription
        if result:
            kit.expect(result["last"] >= 1, f"{result}")

    def unsubscribe(self, connection):
        job = self.some_job()
        self.expect(self.call(connection, "events.unsubscribe", job=job), "fine" if job in self.states else "not_found")

    def artifacts(self, connection):
        job = self.some_job()
        result = self.expect(self.call(connection, "artifact.list", job=job), "fine" if job in self.states else "not_found")
        if result and self.states[job] in FINAL:
            # a robot program, or a surface, is made when it is asked for: in the list it has no bytes and is never final
            kit.expect(all(artifact["final"] == (self.states[job] == "succeeded") for artifact in result["artifacts"] if artifact["artifact"] not in ("program", "surface")), f"{result}")

    def report(self, connection):
        job = self.some_job()
        state = self.states.get(job)
        words = {None: ["not_found"], "succeeded": ["fine"], "cancelled": ["wrong_state"], "expired": ["wrong_state"]}.get(state, ["fine", "wrong_state"])
        result = self.expect(self.call(connection, "job.report", job=job), *words)
        kit.expect(not result or result["state"] == "succeeded", f"{result}")

    def read(self, connection):
        job, offset, size = self.some_job(), self.random.randrange(3000), self.random.randint(1, 5000)
        artifact, form = self.random.choice([("trajectory", {}), ("trajectory", {"format": "csv"}), ("voxels", {}), ("report", {}), ("statue", {})])
        word, result, bulk, _ = self.call(connection, "artifact.read", job=job, artifact=artifact, offset=offset, bytes=size, **form)
        kit.expect(word in ("fine", "params_invalid", "wrong_state", "not_found"), word)
        kit.expect((word != "fine") if artifact == "statue" or job not in self.states else True, f"{word} for {job} {artifact}")
        if word == "fine":
            kit.expect(len(bulk) == result["bytes"] == min(size, max(0, result["size"] - offset)), f"{result}")
            kit.expect(f"{zlib.crc32(bulk):08x}" == result["crc32"], f"{result}")
        elif self.states.get(job) == "succeeded":
            kit.expect(word == "params_invalid", f"{word} for {job} {artifact} at {offset}")

    def put(self, connection):
        blob, content = self.random.choice(list(self.contents.items()))
        have = self.blobs.get(blob, 0)
        offset = max(0, have + self.random.choice([-1, 0, 0, 0, 1]))
        part = content[offset:offset + self.random.randint(1, len(content))]
        if offset > len(content) or not part:
            return
        complete = have == len(content)
        word = "fine" if complete or offset <= have else "offset_mismatch"
        result = self.expect(self.call(connection, "blob.put", chunk=part, sha256=blob, size=len(content), offset=offset, bytes=len(part)), word)
        if result:
            self.blobs[blob] = max(have, offset + len(part))
            told = self.expect(self.call(connection, "blob.has", sha256=blob), "fine")
            kit.expect(told == result and told["have"] == self.blobs[blob] and told["complete"] == (told["have"] == len(content)), f"{result} {told}")

    def garbage(self, connection):
        line, word = self.random.choice([(b'{"id":1', "parse_error"), (b'{"id":1,"id":2,"method":"ping"}', "parse_error"), (b"[]", "bad_request"),
                                         (b'{"id":1,"method":"job.fly"}', "unknown_method"), (b'{"method":"ping"}', "bad_request"),
                                         (b'{"id":1,"method":"ping","params":{"x":1}}', "params_invalid"), (b"[" * 65, "parse_error"),
                                         (b'{"id":1,"method":"job.get","params":{}}', "params_invalid"),
                                         (b'{"id":1,"method":"job.list","params":{"limit":0}}', "params_invalid"),
                                         (b'{"id":1,"method":"ping","extra":0}', "bad_request"), (b"5", "bad_request"), (b'{"id":1e999}', "parse_error")])
        message, _ = connection.exchange(line)
        kit.expect(message["error"]["data"]["code"] == word, f"{line} should be {word}: {message}")
        self.answers[word] += 1

    def reconnect(self, connection):
        connection.client.close()
        self.connections[self.connections.index(connection)] = Connection(self.daemon.address)

    def kill_process(self, _connection):
        """As the system does when memory is short."""
        processes = [int(child) for task in pathlib.Path(f"/proc/{self.daemon.process.pid}/task").iterdir()
                     for child in (task / "children").read_text().split()]
        if not processes:
            return
        self.struck |= {job for job in self.jobs if self.possible(job) & {"running", "pausing"}}
        self.kills += 1
        with contextlib.suppress(ProcessLookupError):  # it has ended meanwhile
            os.kill(self.random.choice(processes), signal.SIGKILL)

    def restart(self, _connection):
        killed = self.random.random() < 0.5
        if killed:
            self.daemon.kill()
        else:
            kit.expect(self.daemon.stop() == 0, "the daemon did not stop in order")
        for connection in self.connections:
            connection.client.close()
        kit.expect_clean(self.data, [{"job": job, "state": state} for job, state in self.states.items()], killed)
        self.start()
        for job in kit.all_jobs(self.connections[0].client):
            self.saw(job["job"], job["state"], INTERRUPTED)

    # --- the end

    def finish(self):
        """All jobs end, and the durable events of each tell its whole story."""
        self.resume_queue(self.connections[0])
        with sculpt.Client(self.daemon.address) as client:
            for job in self.jobs:
                self.end(client, job)
            crashes = sum(self.check_story(client, job) for job in self.jobs)
        kit.expect(crashes <= self.kills, f"{crashes} crashes of {self.kills} processes that were killed")
        kit.expect(self.daemon.stop() == 0, "the daemon did not stop in order")
        kit.expect_clean(self.data, [{"job": job, "state": state} for job, state in self.states.items()])

    def end(self, client, job):
        if self.states[job] == "held" and self.times[job][0] > time.time() + 2:
            self.obey(self.connections[0], job, "job.cancel", COMMANDS["job.cancel"])
        while "pausing" in self.possible(job):
            self.saw(job, client.call("job.wait", job=job, timeout_s=0.1)["state"])
        if self.states[job] == "paused":
            self.obey(self.connections[0], job, "job.resume", COMMANDS["job.resume"])
            return self.end(client, job)
        self.saw(job, client.wait(job)["state"])

    def check_story(self, client, job):
        """Gives how often it crashed."""
        last, state, crashes = client.call("events.subscribe", job=job)["last"], None, 0
        for seq in range(1, last + 1):
            event = client.next_event()
            kit.expect(event["job"] == job and event["seq"] == seq and event["data"].get("from") == state, f"{event} after {seq - 1} {state}")
            state = event["data"]["to"]
            crashes += event["data"]["reason"] == "crashed"
        kit.expect(client.next_event()["type"] == "live" and state == self.states[job], f"job {job} ended as {state}, not {self.states[job]}")
        return crashes


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    print(f"seed {arguments.seed}")
    with kit.scratch_folder() as folder:
        model = Model(folder / "data", arguments.seed, kit.ball())
        with contextlib.closing(model):
            for step in range(arguments.steps):
                try:
                    model.step()
                except (AssertionError, sculpt.Failure, OSError, ValueError) as error:
                    raise AssertionError(f"seed {arguments.seed}, step {step}: {error}") from error
            model.finish()
    print(f"{arguments.steps} steps, {len(model.jobs)} jobs that ended as {dict(collections.Counter(model.states.values()))}, "
          f"{model.kills} processes killed; answers: {dict(model.answers.most_common())}")


if __name__ == "__main__":
    main()
