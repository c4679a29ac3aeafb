#!/usr/bin/env python3
"""Random requests, good and bad, on several connections, against a model of what each must be answered with."""

import argparse
import collections
import hashlib
import json
import random
import zlib

import kit
from kit import sculpt

FINAL = ("succeeded", "failed", "cancelled")
NEXT = {"queued": {"queued", "running", "cancelled", "succeeded", "failed", "cancelling"},
        "running": {"running", "succeeded", "failed", "cancelling", "cancelled"}, "cancelling": {"cancelling", "cancelled"}}


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

    def __init__(self, address, seed, mesh):
        self.address, self.random, self.mesh = address, random.Random(seed), mesh
        self.connections = [Connection(address) for _ in range(4)]
        self.jobs, self.states, self.keys = [], {}, {}  # ids in order; id -> last state seen; key -> (spec, id)
        self.blobs, self.next_id = {}, 1000  # blob -> bytes that the server has
        self.contents = {hashlib.sha256(content).hexdigest(): content for content in (bytes([n]) * (7 * n + 1) for n in range(40))}
        self.answers = collections.Counter()
        steps = {self.submit: 4, self.submit_again: 4, self.submit_badly: 4, self.get: 20, self.list: 8, self.cancel: 4, self.wait: 6,
                 self.subscribe: 4, self.unsubscribe: 4, self.read: 12, self.artifacts: 4, self.report: 4, self.put: 12, self.garbage: 12,
                 self.reconnect: 1, self.ping: 6, self.info: 2}
        self.steps, self.weights = list(steps), list(steps.values())

    def step(self):
        self.random.choices(self.steps, self.weights)[0](self.random.choice(self.connections))

    # --- what is known

    def saw(self, job, state):
        before = self.states.get(job)
        kit.expect(before is None or before == state or state in NEXT.get(before, ()), f"job {job} went from {before} to {state}")
        self.states[job] = state

    def some_job(self):
        return self.random.choice(self.jobs) if self.jobs and self.random.random() < 0.9 else "01ARZ3NDEKTSV4RRFFQ69G5FAV"

    def new_spec(self):
        return kit.spec(self.mesh, seed=self.random.randrange(3))

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
        jobs = self.expect(self.call(connection, "server.info"), "fine")["jobs"]
        kit.expect(sum(jobs.values()) == len(self.jobs), f"{jobs} are not {len(self.jobs)} jobs")

    def submit(self, connection):
        key = f"key {len(self.keys)}"
        spec = self.new_spec()
        result = self.expect(self.call(connection, "job.submit", key=key, spec=spec, priority=self.random.randint(-100, 100)), "fine")
        kit.expect(not result["duplicate"] and result["job"] not in self.states and result["job"] > max(self.jobs, default=""), f"{result}")
        self.jobs.append(result["job"])
        self.keys[key] = (spec, result["job"])
        self.saw(result["job"], result["state"])

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

    def get(self, connection):
        job = self.some_job()
        result = self.expect(self.call(connection, "job.get", job=job), "fine" if job in self.states else "not_found")
        if result:
            self.saw(job, result["state"])
            kit.expect(self.keys[result["key"]][1] == job, f"{result}")

    def list(self, connection):
        limit, after = self.random.randint(1, 50), self.random.choice([*self.jobs[-60:], None])
        result = self.expect(self.call(connection, "job.list", limit=limit, **({"after": after} if after else {})), "fine")
        behind = [job for job in self.jobs if not after or job > after]
        kit.expect([job["job"] for job in result["jobs"]] == behind[:limit] and result["more"] == (len(behind) > limit), f"{result}")
        for job in result["jobs"]:
            self.saw(job["job"], job["state"])

    def cancel(self, connection):
        job = self.some_job()
        state = self.states.get(job)
        words = {None: ["not_found"], "succeeded": ["wrong_state"], "failed": ["wrong_state"], "cancelled": ["fine"], "cancelling": ["fine"]}
        result = self.expect(self.call(connection, "job.cancel", job=job), *words.get(state, ["fine", "wrong_state"]))
        if result:
            kit.expect(result["state"] in ("cancelling", "cancelled"), f"{result}")
            self.saw(job, result["state"])

    def wait(self, connection):
        job = self.some_job()
        timeout_s = self.random.choice([0, 0, 0.01, 3600])
        result = self.expect(self.call(connection, "job.wait", job=job, timeout_s=timeout_s), "fine" if job in self.states else "not_found")
        if result:
            self.saw(job, result["state"])
            kit.expect(result["timed_out"] == (result["state"] not in FINAL), f"{result}")
            kit.expect(timeout_s < 3600 or not result["timed_out"], f"{result} after {timeout_s} s")

    def subscribe(self, connection):
        job, after = self.some_job(), self.random.randint(0, 4)
        words = ["not_found"] if job not in self.states else ["fine"] if after <= 1 else ["fine", "params_invalid"]  # behind its last event
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
            kit.expect(all(artifact["final"] == (self.states[job] == "succeeded") for artifact in result["artifacts"]), f"{result}")

    def report(self, connection):
        job = self.some_job()
        state = self.states.get(job)
        words = {None: ["not_found"], "succeeded": ["fine"], "cancelled": ["wrong_state"]}.get(state, ["fine", "wrong_state"])
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
        self.connections[self.connections.index(connection)] = Connection(self.address)

    # --- the end

    def finish(self):
        """All jobs end, and the durable events of each tell its whole story."""
        with sculpt.Client(self.address) as client:
            for job in self.jobs:
                self.saw(job, client.wait(job)["state"])
                self.check_story(client, job)

    def check_story(self, client, job):
        last, state = client.call("events.subscribe", job=job)["last"], None
        for seq in range(1, last + 1):
            event = client.next_event()
            kit.expect(event["job"] == job and event["seq"] == seq and event["data"].get("from") == state, f"{event} after {seq - 1} {state}")
            state = event["data"]["to"]
        kit.expect(client.next_event()["type"] == "live" and state == self.states[job], f"job {job} ended as {state}, not {self.states[job]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    print(f"seed {arguments.seed}")
    mesh = kit.ball()
    with kit.scratch_folder() as folder:
        with kit.Daemon(folder / "data", "--workers", "2") as daemon:
            with sculpt.Client(daemon.address) as client:
                client.upload(mesh)
            model = Model(daemon.address, arguments.seed, mesh)
            for step in range(arguments.steps):
                try:
                    model.step()
                except (AssertionError, sculpt.Failure, OSError, ValueError) as error:
                    raise AssertionError(f"seed {arguments.seed}, step {step}: {error}") from error
            model.finish()
            kit.expect(daemon.stop() == 0, "the daemon did not stop in order")
        kit.expect_clean(folder / "data", [{"job": job, "state": state} for job, state in model.states.items()])
    print(f"{arguments.steps} steps, {len(model.jobs)} jobs; answers: {dict(model.answers.most_common())}")


if __name__ == "__main__":
    main()
