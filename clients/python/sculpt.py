#!/usr/bin/env python3
"""sculpt.py: a client of sculptd in one file, standard library only (Python 3.9 or newer).

As a program it has the verbs, options and exit codes of `sculpt` for everything that needs a server:
    sculpt.py submit head.stl --resolution 16 --robot panda-turntable --wait
As a module it is a connection that is used one call at a time:
    with sculpt.Client("127.0.0.1:7878") as client:
        job = client.submit({"mesh": client.upload_file("head.stl"), "robot": "gantry", "resolution": 16})["job"]
        client.wait(job)
        print(client.call("job.report", job=job)["voxels"])
and a reader of .sct trajectories:
    header, *keyframes = sculpt.read_sct("head.sct")
The protocol is described in proto/PROTOCOL.md.
"""

import argparse
import collections
import hashlib
import itertools
import json
import math
import os
import pathlib
import re
import socket
import ssl
import struct
import sys
import time
import xml.etree.ElementTree
import zlib

VERSION = "sculpt.py/0.1.0"
FINE, FAILED, USAGE, UNREACHABLE, REFUSED = range(5)
CHUNK = 1 << 20
PAGE = 1000
CHUNKED = ("artifact.read", "job.cell", "job.samples")  # whose replies a chunk follows
FINAL = ("succeeded", "failed", "quarantined", "expired", "cancelled")


class Failure(Exception):
    """Ends a command with an exit code and one line `sculpt: CODE: sentence`."""

    def __init__(self, exit_code, code, sentence):
        super().__init__(sentence)
        self.exit_code, self.code = exit_code, code


class Lost(Failure):
    """The server does not answer, or the connection broke."""

    def __init__(self, sentence):
        super().__init__(UNREACHABLE, "unreachable", sentence)


class Client:
    """One connection to sculptd, not shared between threads. Raises Failure (UNREACHABLE or REFUSED; FAILED for a damaged artifact).

    `server` is HOST:PORT, tls:HOST:PORT or unix:PATH. Without `token` it is SCULPT_TOKEN, or stands in the file SCULPT_TOKEN_FILE;
    SCULPT_TLS_CA, SCULPT_TLS_CERT and SCULPT_TLS_KEY name the PEM files for TLS.

    When the connection breaks, or the server is about to stop, it is looked for until `patience_s` (SCULPT_PATIENCE_S, else a minute)
    is over; then what was asked is asked again, and subscriptions go on behind the last event: none is lost and none comes twice. What
    must not be asked twice (job.submit without a key, job.retry) is not.
    """

    def __init__(self, server="127.0.0.1:7878", name=VERSION, token=None, patience_s=None):
        self.server, self.name, self.token = server, name, read_token() if token is None else token
        self.patience_s = read_patience() if patience_s is None else patience_s
        self.next_id, self.events, self.followed = 1, collections.deque(), {}  # job that has not ended ("": all) -> its last event that has come
        self._open()

    def _open(self):
        try:
            self.socket = connect(self.server)
            self.socket.settimeout(None)
        except OSError as error:
            raise Lost(f"no server answers at {self.server} ({error}): start sculptd, or say --server HOST:PORT") from error
        self.stream = self.socket.makefile("rwb")
        self.hello = self._ask("hello", None, {"protocol": [1, 0], "client": self.name, **({"token": self.token} if self.token else {})})

    def _find_again(self, lost):
        """Ends with a new connection, on which all is followed that was, or raises what was lost with."""
        self.close()
        end, pause_s, epoch = time.monotonic() + self.patience_s, 0.1, self.hello["epoch"]
        if self.patience_s > 0:
            print(f"sculpt: the connection to {self.server} broke: looking for the server", file=sys.stderr, flush=True)
        while time.monotonic() + pause_s < end:
            time.sleep(pause_s)
            pause_s = min(2 * pause_s, 2)
            try:
                self._open()
                if self.hello["epoch"] != epoch:
                    raise Failure(REFUSED, "replay_gap", f"the store of the server at {self.server} was replaced: the jobs of before are not there")
                for job, last in self.followed.items():
                    self._ask("events.subscribe", None, {**({"job": job} if job else {}), "after": last})
                return
            except Failure as failure:
                if not may_pass(failure):
                    raise
        raise lost

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.close()

    def close(self):
        self.socket.close()

    def call(self, method, chunk=None, **params):
        """The result of a request; of artifact.read, job.cell and job.samples the pair (result, bytes). Events that come meanwhile are kept."""
        repeatable = method != "job.retry" and (method != "job.submit" or "key" in params)
        while True:
            try:
                result = self._ask(method, chunk, params)
                break
            except Failure as failure:
                if not repeatable or not may_pass(failure):
                    raise
                self._find_again(failure)
        if method == "events.subscribe":
            self.followed[params.get("job", "")] = params.get("after", 0)
        elif method == "events.unsubscribe":
            self.followed.pop(params.get("job", ""), None)
        return result

    def _ask(self, method, chunk, params):
        request_id, self.next_id = self.next_id, self.next_id + 1
        line = json.dumps({"jsonrpc": "2.0", "id": request_id, "method": method, "params": params})
        try:
            self.stream.write(line.encode() + b"\n" + (b"" if chunk is None else chunk + b"\n"))
            self.stream.flush()
        except OSError as error:
            raise self._broken() from error
        while True:
            message = self._read_line()
            if message.get("id") == request_id:
                break
            if message.get("method") == "event":
                self._keep(message["params"])
            elif message.get("id") is None and "error" in message:
                break
        if "error" in message:
            error = message["error"]
            code = error.get("data", {}).get("code", "refused")
            raise Failure(FAILED if code == "artifact_damaged" else REFUSED, code, error["message"])
        result = message["result"]
        return (result, self._read_chunk(result)) if method in CHUNKED else result

    def next_event(self):
        """The params of the next event of a subscription; waits for it."""
        while not self.events:
            try:
                message = self._read_line()
            except Lost as lost:
                self._find_again(lost)
                continue
            if message.get("method") == "event":
                self._keep(message["params"])
        return self.events.popleft()

    def _keep(self, event):
        if "number" in event:
            self.followed[""] = event["number"]
        elif "seq" in event:
            self.followed[event["job"]] = event["seq"]
            if event.get("data", {}).get("to") in FINAL:
                del self.followed[event["job"]]  # nothing more comes, and it may be gone by then
        self.events.append(event)

    def upload(self, content):
        """Sends the bytes unless the server has them; gives their hash."""
        digest = hashlib.sha256(content).hexdigest()
        state, again = self.call("blob.has", sha256=digest), True
        while not state["complete"]:
            offset = min(state["have"], len(content))
            part = content[offset:offset + CHUNK]
            try:
                state = self.call("blob.put", chunk=part, sha256=digest, size=len(content), offset=offset, bytes=len(part))
            except Failure as failure:
                if failure.code != "offset_mismatch" or not again:
                    raise
                state, again = {"have": 0, "complete": False}, False  # what it has is of somebody who says another size
        return digest

    def list(self, newest=False, after=None, before=None, limit=None):
        """The reply to job.list, of as many pages as it takes: jobs, more, last, and damaged if there are any."""
        bounds = {**({"after": after} if after else {}), **({"before": before} if before else {}), **({"order": "newest"} if newest else {})}
        found = {"jobs": [], "more": True}
        while found["more"] and (limit is None or len(found["jobs"]) < limit):
            page = self.call("job.list", limit=PAGE if limit is None else min(PAGE, limit - len(found["jobs"])), **bounds)
            found["jobs"] += page["jobs"]
            found.setdefault("last", page["last"])
            found["more"] = page["more"] and bool(page["jobs"])
            if "damaged" in page:
                found["damaged"] = found.get("damaged", []) + page["damaged"]
            if page["jobs"]:
                bounds["before" if newest else "after"] = page["jobs"][-1]["job"]
        return found

    def upload_file(self, path):
        """A mesh as a job's spec wants it."""
        return {"blob": self.upload(read_input(path, "mesh")), "name": os.path.basename(path)}

    def upload_cell(self, path):
        """A cell file with its URDF and meshes, as `robot` of a spec: the server needs nothing of this disk."""
        name, text, files = read_cell_files(path)
        bundle = {"name": name, "cell": text, "files": {ref: {"blob": self.upload(data)} for ref, data in sorted(files.items())}}
        return {"cell": {"blob": self.upload(json.dumps(bundle).encode())}}

    def check_cell(self, robot, resolution=64):
        """What the server finds out about a cell: the name of one of its own, or what upload_cell gave."""
        return self.call("cell.check", robot=robot, resolution=resolution)

    def submit(self, spec, **params):
        return self.call("job.submit", spec=spec, **params)

    def wait(self, job):
        """Returns the job as job.get gives it, once it has ended."""
        while self.call("job.wait", job=job, timeout_s=3600)["timed_out"]:
            pass
        return self.call("job.get", job=job)

    def read_artifact(self, job, artifact="trajectory", **form):
        """Yields the bytes of an artifact; of a trajectory that still grows until the job has ended.

        Raises Failure (FAILED, artifact_damaged) at the end if they do not have the hash that the server stored.
        """
        offset, digest = 0, hashlib.sha256()
        while True:
            result, chunk = self.call("artifact.read", job=job, artifact=artifact, offset=offset, bytes=CHUNK, **form)
            yield chunk
            offset += len(chunk)
            digest.update(chunk)
            if result["eof"]:
                return self._expect_hash(job, artifact, result, digest.hexdigest())
            if not chunk and self.call("job.wait", job=job, timeout_s=1)["state"] in FINAL and not result["final"]:
                result, _ = self.call("artifact.read", job=job, artifact=artifact, offset=offset, bytes=1, **form)
                if not result["final"]:
                    return

    def samples(self, job, rate_hz, from_s=0.0, **window):
        """Yields (t, positions, velocities) of a job's motion: seconds from its start, rad or m, and per second.

        `window`: motion={"feed_m_s": ...}, to_s, count, holds_s, as job.samples in PROTOCOL.md has them.
        """
        while True:
            result, chunk = self.call("job.samples", job=job, rate_hz=rate_hz, from_s=from_s, **window)
            joints, behind = len(result["joints"]), result["first"] + result["count"]
            for at, row in enumerate(struct.iter_unpack(f"<{2 * joints}d", chunk), result["first"]):
                yield at / rate_hz, row[:joints], row[joints:]
            if "count" in window:
                window["count"] -= result["count"]
            if result["eof"] or window.get("count") == 0 or behind / rate_hz > window.get("to_s", math.inf) + 1e-9 / rate_hz:
                return
            from_s = behind / rate_hz

    def _expect_hash(self, job, artifact, last, digest):
        wanted = last.get("sha256") or self._listed_hash(job, artifact, last["format"], digest)
        if wanted != digest:
            raise Failure(FAILED, "artifact_damaged", f"the {artifact} of job {job} came with the hash {digest}, but was stored with {wanted}: "
                          f"fetch it again, or plan it again with 'sculpt retry {job}'")

    def _listed_hash(self, job, artifact, form, digest):
        entry = next(entry for entry in self.call("artifact.list", job=job)["artifacts"] if entry["artifact"] == artifact)
        own = {"format": entry["formats"][0], "sha256": entry.get("sha256", digest)}
        return next((made["sha256"] for made in [own, *entry.get("made", [])] if made["format"] == form), digest)

    def _read_line(self):
        try:
            line = self.stream.readline()
        except OSError as error:
            raise self._broken() from error
        if not line.endswith(b"\n"):
            raise self._broken()
        return json.loads(line)

    def _read_chunk(self, result):
        try:
            chunk = self.stream.read(result["bytes"] + 1)
        except OSError as error:
            raise self._broken() from error
        if len(chunk) != result["bytes"] + 1:
            raise self._broken()
        if f"{zlib.crc32(chunk[:-1]):08x}" != result["crc32"]:
            raise Failure(UNREACHABLE, "chunk_damaged", "a chunk arrived with a wrong checksum: fetch again")
        return chunk[:-1]

    def _broken(self):
        return Lost(f"the connection to {self.server} broke; jobs go on when sculptd runs again: try again then")


# The way to the server

def may_pass(failure):
    return isinstance(failure, Lost) or failure.code == "stopping"


def read_patience():
    text = os.environ.get("SCULPT_PATIENCE_S") or "60"
    try:
        return max(0.0, float(text))
    except ValueError:
        raise Failure(USAGE, "usage", f"SCULPT_PATIENCE_S must be a number of seconds, not '{text}'") from None


def connect(server):
    """A connected socket; raises Failure (USAGE) for what is no address, and OSError."""
    if server.startswith("unix:"):
        plain = socket.socket(socket.AF_UNIX)
        plain.connect(server[len("unix:"):])
        return plain
    host, _, port = server[len("tls:"):].rpartition(":") if server.startswith("tls:") else server.rpartition(":")
    if not host or not port.isdecimal() or int(port) > 65535:
        raise Failure(USAGE, "usage", f"--server: '{server}' is no address: write HOST:PORT, tls:HOST:PORT or unix:PATH, "
                      "for example 127.0.0.1:7878")
    plain = socket.create_connection((host.strip("[]"), int(port)), timeout=10)
    if not server.startswith("tls:"):
        return plain
    context = ssl.create_default_context(cafile=os.environ.get("SCULPT_TLS_CA") or None)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    if os.environ.get("SCULPT_TLS_CERT"):
        context.load_cert_chain(os.environ["SCULPT_TLS_CERT"], os.environ.get("SCULPT_TLS_KEY") or None)
    return context.wrap_socket(plain, server_hostname=host.strip("[]"))


def read_token():
    path = os.environ.get("SCULPT_TOKEN_FILE")
    if os.environ.get("SCULPT_TOKEN") or not path:
        return os.environ.get("SCULPT_TOKEN", "")
    return read_input(path, "token").decode("utf-8", "replace").partition("\n")[0].strip()


# Files of this disk

def read_input(path, what):
    try:
        with open(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        raise Failure(USAGE, "file_missing", f"no {what} file {path}: check the path") from None
    except IsADirectoryError:
        raise Failure(USAGE, "file_unreadable", f"{path} is a folder: name the {what} file in it") from None
    except OSError as error:
        raise Failure(USAGE, "file_unreadable", f"cannot read the {what} file {path} ({error.strerror})") from None


def read_cell_files(path):
    """Name, text and files of a cell: what read_cell_files of core/cell/cell.hpp gives."""
    path = pathlib.Path(path)
    text = read_input(path, "cell").decode("utf-8", "replace")
    try:
        cell = json.loads(text)
        urdf_name, packages = cell["urdf"], cell.get("packages", {})
        urdf_path = path.parent / urdf_name
        urdf = urdf_path.read_bytes()
        files = {urdf_name: urdf}
        references = {mesh.get("filename") for mesh in xml.etree.ElementTree.fromstring(urdf).findall(".//collision//mesh")}
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise Failure(REFUSED, "cell_invalid", f"{path} is no cell file: {error!r}") from None
    except xml.etree.ElementTree.ParseError as error:
        raise Failure(REFUSED, "urdf_invalid", f"{urdf_path} is not valid XML: {error}") from None
    except OSError as error:
        raise Failure(REFUSED, "file_missing", f"cannot read the URDF {urdf_path} of cell {path}: {error.strerror}") from None
    for reference in sorted(filter(None, references)):
        files[reference] = find_mesh(reference, path.parent, urdf_path, packages)
    return path.stem, text, files


def find_mesh(reference, cell_folder, urdf_path, packages):
    if not reference.startswith("package://"):
        return read_input(urdf_path.parent / re.sub("^file://", "", reference), "mesh")
    package, _, rest = reference[len("package://"):].partition("/")
    folders = [cell_folder / packages[package]] if package in packages else []
    for above in urdf_path.absolute().parents:
        folders += ([above] if above.name == package else []) + [above / package]
    for root in filter(None, os.environ.get("ROS_PACKAGE_PATH", "").split(":")):
        folders += ([pathlib.Path(root)] if pathlib.Path(root).name == package else []) + [pathlib.Path(root) / package]
    for folder in folders:
        if (folder / rest).is_file():
            return (folder / rest).read_bytes()
    raise Failure(REFUSED, "file_missing", f"mesh {reference} was not found: add \"packages\": {{\"{package}\": \"folder\"}} "
                  "to the cell file, or put the package's folder into ROS_PACKAGE_PATH")


# Trajectories in the .sct form; docs/trajectory.md describes the bytes

def read_sct(path):
    """Yields the header and then each keyframe, as json.loads gives the lines of the .ndjson form.

    Raises Failure (REFUSED) as soon as something does not fit; all is well only once the last keyframe was followed by no Failure.
    """
    with open(path, "rb") as file:
        yield from SctReader(file)


class SctReader:
    """An .sct file from its start to its end, a segment at a time."""

    def __init__(self, file):
        self.file, self.hash, self.offset = file, hashlib.sha256(), 0

    def __iter__(self):
        header = self._read_preamble()
        yield header
        segments, keyframes, removed = [], 0, 0
        while True:
            offset, head = self.offset, self._take(1)
            if head != b"\1":
                break
            segments.append((offset, keyframes, removed))
            for keyframe in self._read_segment(head, header, removed):
                yield keyframe
                keyframes += 1
                if keyframe["type"] == "cut":
                    first, last = keyframe["voxels"]
                    removed += 1 + sum(abs(b - a) for a, b in zip(first, last))
        index = b"\2" + len(segments).to_bytes(4, "little")
        index += b"".join(number.to_bytes(8, "little") for number in (*itertools.chain(*segments), keyframes, removed, offset))
        if head + self._take(len(index) - 1) != index or self._take_number(4) != zlib.crc32(index):
            self._refuse("the index does not fit the segments")
        expected = self.hash.hexdigest().encode()
        if self.file.read() != expected:
            self._refuse("the hash does not match the bytes before it")

    def _refuse(self, what):
        raise Failure(REFUSED, "trajectory_invalid",
                      f"binary trajectory byte {self.offset}: {what}; fetch or plan the trajectory again") from None

    def _take(self, size):
        data = self.file.read(size)
        if len(data) != size:
            self._refuse("the file is cut short")
        self.hash.update(data)
        self.offset += size
        return data

    def _take_number(self, size):
        return int.from_bytes(self._take(size), "little")

    def _read_preamble(self):
        start = self._take(16)
        if not start.startswith(b"SCULPTRJ\2\0\0\0"):
            self._refuse("not an .sct file of version 2")
        size = int.from_bytes(start[12:], "little")
        if size > 1 << 20:
            self._refuse("the header is too long")
        line = self._take(size)
        if self._take_number(4) != zlib.crc32(start + line):
            self._refuse("the header's checksum is wrong")
        try:
            header = json.loads(line)
            if isinstance(header["joints"], list) and isinstance(header["resolution"], int):
                return header
        except (ValueError, KeyError, TypeError):
            pass
        self._refuse("the header is not that of a trajectory")

    def _read_segment(self, head, header, removed):
        head += self._take(16)
        count, first_removed, size = (int.from_bytes(head[a:b], "little") for a, b in ((1, 5), (5, 13), (13, 17)))
        joints = len(header["joints"])
        if not 1 <= count <= 4096 or size > count * (9 + 10 * joints) + 2 * joints or first_removed != removed:
            self._refuse("a segment's head is wrong")
        crc, body = self._take_number(4), self._take(size)
        if crc != zlib.crc32(head + body):
            self._refuse("the segment's checksum is wrong")
        numbers = varints(body)
        try:
            cuts = read_tokens(numbers, count, header["resolution"])
            columns = [read_column(numbers, count) for _ in range(joints)]
        except (StopIteration, ValueError) as error:
            self._refuse(str(error) or "the segment is too short for its keyframes")
        if next(numbers, None) is not None:
            self._refuse("there is more than the segment's keyframes need")
        for q, voxels in zip(zip(*columns), cuts):
            yield {"type": "cut", "q": list(q), "voxels": voxels} if voxels else {"type": "move", "q": list(q)}


# Timelines; docs/trajectory.md describes the bytes

LABELS = "air", "keep", "remove"


def read_timeline(data):
    """(header, runs, cuts) of the tokens of a timeline, which may still grow: runs are (label, number of voxels), i changing fastest,
    then j, then k; cuts are one entry a keyframe, [first, last] voxel or None where nothing is cut. Of a plan with milling tools an
    entry is the list of the [first, last] that a cut takes, maybe none, the number of the tool at a change, or None at a move."""
    head, _, body = data.partition(b"\n")
    header, numbers = json.loads(head), varints(body)
    runs, left = [], header["resolution"] ** 3
    while left > 0:
        length, label = divmod(next(numbers), len(LABELS))
        runs.append((LABELS[label], length + 1))
        left -= length + 1
    cuts, read = [], read_milled if "tools" in header else read_tokens
    while segment := read(numbers, 4096, header["resolution"], growing=True):
        cuts += segment
    return header, runs, cuts


def varints(body):
    value = shift = 0
    for byte in body:
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            if value >> 64:
                raise ValueError("a number has more than 64 bits")
            yield value
            value = shift = 0
    if shift:
        raise ValueError("a number does not end")


def signed(varint):
    return varint >> 1 ^ -(varint & 1)


def read_tokens(numbers, count, resolution, growing=False):
    """First and last voxel of each cut, None of each move. A growing list may have fewer."""
    cuts, last = [], LastCut(resolution)
    for _ in range(count):
        token = next(numbers, None) if growing else next(numbers)
        if token is None:
            break
        cuts.append(last.read(token, numbers) if token else None)
    return cuts


def read_milled(numbers, count, resolution, growing=False):
    """The same with milling tools: a list of runs of each cut, the tool of each change. The last cut may not be there as a whole: it is left out."""
    cuts, last = [], LastCut(resolution)
    try:
        for _ in range(count):
            token = next(numbers)
            if token == 1:
                cuts.append(next(numbers))
            else:
                cuts.append([last.read(next(numbers), numbers) for _ in range(token - 2)] if token else None)
    except StopIteration:
        if not growing:
            raise
    return cuts


class LastCut:
    """What the next run of a segment is told relative to."""

    def __init__(self, resolution):
        self.resolution, self.end, self.direction, self.length = resolution, [0, 0, 0], 0, 1

    def read(self, token, numbers):
        """[first, last] voxel of the run that a token begins."""
        start = self.direction
        if token > 1:
            rest, start = divmod(token - 2, 7)
            self.length, self.direction = rest // 6 + 1, rest % 6
        first = [a + signed(next(numbers)) for a in self.end] if start == 6 else step(self.end, start, 1)
        self.end = step(first, self.direction, self.length - 1)
        if not all(0 <= index < self.resolution for index in first + self.end):
            raise ValueError("a cut leaves the grid")
        return [first, self.end]


def step(voxel, direction, count):
    """The voxel `count` steps on in direction 0 to 5: -i +i -j +j -k +k."""
    on = voxel[:]
    on[direction // 2] += count if direction % 2 else -count
    return on


def read_column(numbers, count):
    """The values of one joint, in rad or m."""
    order, values = next(numbers), []
    while len(values) < count:
        values.append(signed(next(numbers)))
        if values[-1] == 0:
            zeros = next(numbers)
            if zeros > count - len(values):
                raise ValueError("a run of zeros is longer than the segment")
            values += [0] * zeros
    if order > 3:
        raise ValueError("a joint's order of differences is no number from 0 to 3")
    for _ in range(order):
        values = list(itertools.accumulate(values))
    if max(map(abs, values)) > 10**15:
        raise ValueError("a joint value is out of range")
    return [value / 10**7 for value in values]


# Commands: each gets the parsed options and gives the exit code

def run_submit(options):
    placed = [name for name in ("scale", "offset", "margin", "stock_box", "stock") if getattr(options, name) is not None]
    if options.continued and placed:
        raise Failure(USAGE, "usage", f"--continue excludes --{placed[0].replace('_', '-')}: the mesh stands as in job {options.continued}, in what that one left")
    read_input(options.mesh, "mesh")
    check_cell_files(options.robot)
    mill = mill_order_of(options) if options.tools else None
    with Client(options.server) as client:
        spec = {"mesh": client.upload_file(options.mesh), "resolution": options.resolution, "seed": options.seed,
                "robot": robot_of(client, options.robot)}
        if options.search:
            spec["search"] = options.search
        if mill:
            spec["mill"] = mill
        if options.allow_freed:
            spec["allow_freed"] = True
        if motion := motion_of(options):
            spec["motion"] = motion
        if options.continued:
            spec["continue"] = {"job": options.continued, "rotation_rad": rotation_rad(options)}
        else:
            spec.update(placement_of(client, options))
        named = {field: getattr(options, field) for field in ("key", "priority", "queue", "not_before", "start_by", "max_runtime_s")
                 if getattr(options, field) is not None}
        reply, exit_code = client.submit(spec, **named), FINE
        if not options.json:
            print(reply["job"], flush=True)
        if options.wait:
            end = follow(client, reply["job"], sys.stderr, True)
            reply["state"], exit_code = end["state"], end_exit_code(end)
        if options.json:
            print(json.dumps(reply))
        return exit_code


def is_cell_path(robot):
    return "/" in robot or robot.endswith(".json")


def check_cell_files(robot):
    """Before there is a connection: raises Failure where a cell of this disk cannot be read."""
    if is_cell_path(robot):
        read_cell_files(robot)


def robot_of(client, robot):
    """A name is the server's to resolve; a path is sent."""
    return client.upload_cell(robot) if is_cell_path(robot) else robot


def run_cell(options):
    check_cell_files(options.cell)
    with Client(options.server) as client:
        found = client.check_cell(robot_of(client, options.cell), options.resolution)
    if options.json:
        print(json.dumps(found))
    else:
        errors = sum(fault["weight"] == "error" for fault in found["faults"])
        print(f"cell {found['cell']}: " + ("ready to plan with" if found["plannable"] else
                                           f"cannot be planned with, {errors} error{'' if errors == 1 else 's'}"))
        for fault in found["faults"]:
            print(f"{fault['weight']}: {fault['sentence']}\n  cure: {fault['cure']}")
        if "better_home" in found:
            print(f'a home that is free:\n  "home": {json.dumps(found["better_home"])}')
    return FINE if found["plannable"] else FAILED


def rotation_rad(options):
    return [math.radians(degrees) for degrees in options.rotate or (0, 0, 0)]


def placement_of(client, options):
    """The fields of a spec that say where the mesh stands in which stock."""
    placement = {"rotation_rad": rotation_rad(options), "offset_m": options.offset or [0, 0, 0], "margin_m": options.margin or 0}
    if options.scale is not None:
        placement["scale_m"] = options.scale
    if options.stock_box:
        return {"placement": placement, "stock": {"box": {"min_m": options.stock_box[:3], "max_m": options.stock_box[3:]}}}
    return {"placement": placement, **({"stock": {"mesh": client.upload_file(options.stock)}} if options.stock else {})}


def motion_of(options):
    """The field of a spec that says how fast the plan is to be gone through; empty where nothing is said of it."""
    fields = {"feed_m_s": options.feed, "rapid_m_s": options.rapid, "keep_feed": options.keep_feed}
    return {field: value for field, value in fields.items() if value is not None}


def mill_order_of(options):
    """The field of a spec that names milling tools and brings the library that they are in."""
    if not options.tool_library:
        raise Failure(USAGE, "usage", "--tools names tools of a library: give its file with --tool-library")
    try:
        library = json.loads(read_input(options.tool_library, "tool library"))
    except ValueError as error:
        raise Failure(REFUSED, "tools_invalid", f"{options.tool_library} is no tool library: {error}") from None
    if not isinstance(library, dict):
        raise Failure(REFUSED, "tools_invalid", f'{options.tool_library} is no tool library: write {{"tools": [...]}}')
    lengths = {f"{name}_m": getattr(options, name) for name in ("tolerance", "scallop", "allowance") if getattr(options, name) is not None}
    return {"tools": options.tools, "library": library, **lengths}


def run_list(options):
    with Client(options.server) as client:
        found = client.list(options.newest, limit=options.limit)
    jobs = found["jobs"]
    for job in found.get("damaged", []):
        print(f"sculpt: warning: {job['job']} is left out: {job['message']}", file=sys.stderr)
    if options.json:
        print(json.dumps({"jobs": jobs}))
        return FINE
    print(f"{'JOB':26}  {'STATE':11}  {'MESH':24}  {'N':>5}  {'ROBOT':16}  SUBMITTED")
    for job in jobs:
        print(f"{job['job']:26}  {job['state']:11}  {job.get('mesh', '-'):24}  {job.get('resolution', '-'):>5}  "
              f"{job.get('robot', '-'):16}  {job.get('submitted_at', '-')}")
    return FINE


def run_status(options):
    with Client(options.server) as client:
        print_fields(client.call("job.get", job=options.job), options.json)
    return FINE


def order(verb):
    """Runs job.cancel, job.pause, job.resume or job.retry."""
    def run(options):
        with Client(options.server) as client:
            reply = client.call("job." + verb, job=options.job)
        print(json.dumps(reply) if options.json else reply["state"])
        return FINE
    return run


def run_pin(options):
    with Client(options.server) as client:
        reply = client.call("artifact.pin", job=options.job, pinned=not options.off)
    print(json.dumps(reply) if options.json else "pinned" if reply["pinned"] else "not pinned")
    return FINE


def run_queue(options):
    with Client(options.server) as client:
        reply = client.call("queue." + options.what)
    print(json.dumps(reply) if options.json else "paused" if reply["paused"] else "open")
    return FINE


def run_watch(options):
    try:
        with Client(options.server) as client:
            end = follow(client, options.job, sys.stderr if options.json else sys.stdout, not options.json)
    except KeyboardInterrupt:
        raise Failure(FAILED, "interrupted", f"job {options.job} goes on; see it again with: watch {options.job}") from None
    if options.json:
        print(json.dumps(end))
    return end_exit_code(end)


def run_wait(options):
    with Client(options.server) as client:
        end = client.wait(options.job)
    if options.json:
        print(json.dumps(end))
    return end_exit_code(end)


def run_report(options):
    with Client(options.server) as client:
        print_fields(client.call("job.report", job=options.job), options.json)
    return FINE


def program_of(options):
    """The field of artifact.read that says which program is wanted; nothing of another artifact."""
    if (options.artifact == "program") != bool(options.dialect):
        raise Failure(USAGE, "usage", "--artifact program and --dialect belong together: say both, or none")
    if not options.dialect:
        return {}
    names = ("dialect", "name", "part_keyframes", "part_bytes")
    fields = {name: getattr(options, name) for name in names if getattr(options, name) is not None}
    flags = {name: True for name in ("stock_files", "seams_in_stock") if getattr(options, name)}
    return {"program": {**fields, **flags, "motion": motion_of(options)}}


def run_fetch(options):
    form = {**({"format": options.format} if options.format else {}), **program_of(options)}
    grows = (options.artifact, options.format) in (("trajectory", None), ("trajectory", "ndjson"), ("timeline", None), ("timeline", "tokens"))
    with Client(options.server) as client:
        end = client.call("job.get", job=options.job) if grows else client.wait(options.job)
        if end["state"] in FINAL and not is_whole(end):
            return end_exit_code(end)
        chunks = client.read_artifact(options.job, options.artifact, **form)
        if options.output == "-":
            for chunk in chunks:
                sys.stdout.buffer.write(chunk)
                sys.stdout.buffer.flush()
            return end_exit_code(client.wait(options.job))
        part = options.output + ".part"
        try:
            with open(part, "wb") as file:
                for chunk in chunks:
                    file.write(chunk)
            end = client.wait(options.job)
            if is_whole(end):
                os.replace(part, options.output)
        except OSError as error:
            raise Failure(USAGE, "file_unwritable", f"cannot write {options.output}: {error.strerror}") from None
        finally:
            pathlib.Path(part).unlink(missing_ok=True)  # another fetch to the same file may have taken it away
        return end_exit_code(end)


def run_verify(options):
    with Client(options.server) as client:
        verdict = client.call("job.verify", job=options.job)
    if options.json:
        print(json.dumps(verdict))
    else:
        print(f"{options.job}: {'clean' if verdict['clean'] else 'NOT CLEAN'}, {verdict['voxels_checked']} voxels checked, "
              f"{verdict['collisions']} findings")
        for finding in verdict["findings"]:
            print(f"  line {finding['line']}: {finding['sentence']}")
        for pair in verdict.get("exempt_pairs", []):
            print(f"  may touch ({pair['why']}): {pair['links'][0]} and {pair['links'][1]}")
    return FINE if verdict["clean"] else FAILED


# What commands share

def doubt_lines(progress):
    """What is said before planning, a line each: of how much `progress` says that it is loose or ambiguous."""
    lines, loose, keep = [], progress.get("loose_keep", 0), progress.get("keep", 0)
    if loose:
        word = "warning" if loose >= 1000 or 50 * loose >= keep else "note"
        lines.append(f"{word}: {loose} of {keep} voxels of the target hang on nothing once all around them is gone")
    if progress.get("ambiguous"):
        place = ", ".join(f"{mm:.1f}" for mm in progress["ambiguous_at_mm"])
        lines.append(f"warning: of {progress['ambiguous']} voxels the mesh does not say for sure whether they are inside (around {place} mm in the stock's frame)")
    return lines


def follow(client, job, out, plain):
    """Shows a job live until it has ended: a bar on a terminal, else (if `plain`) lines; gives the job."""
    bar, shown, warned = out.isatty(), None, False
    client.call("events.subscribe", job=job)
    while True:
        event = client.next_event()
        data = event.get("data", {})
        if event["type"] == "state":
            if bar or plain:
                print(("\r\x1b[K" if bar else "") + data["to"], file=out, flush=True)
            if data["to"] in FINAL:
                end = client.call("job.get", job=job)
                if end["state"] in FINAL:
                    return end
                client.call("events.subscribe", job=job, after=event["seq"])  # quarantined, and retried since
        elif event["type"] == "progress":
            share = data["done"] / data["total"] if data["total"] else 0
            counts = f"{data['stage']:9} {data['done']}/{data['total']}"
            lines = doubt_lines(data)
            if lines and not warned:
                print("\n".join(lines), file=sys.stderr, flush=True)
                warned = True
            if bar:
                cells = int(30 * share)
                print(f"\r\x1b[K{counts} [{'#' * cells}{'.' * (30 - cells)}] {share:4.0%}", end="", file=out, flush=True)
            elif plain and shown != (data["stage"], int(10 * share)):
                print(counts, file=out, flush=True)
            shown = (data["stage"], int(10 * share))


def is_whole(end):
    """A trajectory that failed its replay may be looked at; of other jobs that did not succeed there is nothing whole."""
    return end["state"] == "succeeded" or end.get("error", {}).get("code") in ("verify_failed", "feed_not_kept")


def end_exit_code(end):
    if end["state"] == "succeeded":
        return FINE
    error = end.get("error", {"code": end["state"], "message": "it was " + end["state"]})
    print(f"sculpt: {error['code']}: job {end['job']} {end['state']}: {error['message']}", file=sys.stderr)
    return FAILED


def print_fields(values, as_json, indent=""):
    if as_json:
        print(json.dumps(values))
        return
    for name, value in values.items():
        if isinstance(value, dict):
            print(indent + name)
            print_fields(value, False, indent + "  ")
        elif isinstance(value, list):
            print(indent + name)
            for item in value:
                print(f"{indent}  " + (" ".join(f"{v}" for v in item.values()) if isinstance(item, dict) else f"{item}"))
        else:
            print(f"{indent}{name:<{22 - len(indent)}}{value}")


def numbers(count):
    def parse(text):
        values = [float(part) for part in text.split(",")]
        if len(values) != count:
            raise ValueError(text)
        return values
    parse.__name__ = f"list of {count} numbers"
    return parse


def positive(text):
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


def joined_lists(arguments):
    """argparse takes `--offset -1,0,0` for two options: such values are joined to their option by `=`."""
    joined = []
    for argument in arguments:
        lists = joined and joined[-1] in ("--rotate", "--offset", "--stock-box")
        joined[-1:] = [joined[-1] + "=" + argument] if lists else joined[-1:] + [argument]
    return joined


def parse_command_line(arguments):
    common = argparse.ArgumentParser(add_help=False)
    default = os.environ.get("SCULPT_SERVER") or "127.0.0.1:7878"
    common.add_argument("--server", metavar="ADDRESS", default=argparse.SUPPRESS,
                        help=f"HOST:PORT, tls:HOST:PORT or unix:PATH of sculptd (env SCULPT_SERVER; now {default})")
    common.add_argument("--version", action="version", version=VERSION)
    parser = argparse.ArgumentParser(prog="sculpt.py", parents=[common], description="Talks to sculptd, the plan server for robot carving.",
                                     epilog="Exit codes: 0 fine, 1 the job failed or the check found something, 2 usage, "
                                            "3 server unreachable, 4 refused.")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)

    def command(name, run, summary, job=True, as_json=True):
        sub = commands.add_parser(name, parents=[common], help=summary, description=summary)
        sub.set_defaults(run=run)
        if job:
            sub.add_argument("job", metavar="JOB", help="the id that submit printed")
        if as_json:
            sub.add_argument("--json", action="store_true", help="one JSON document on stdout")
        return sub

    add_submit_options(command("submit", run_submit, "send a mesh and queue a job; prints the job's id", job=False))
    listing = command("list", run_list, "the jobs of the server, in the order of submission", job=False)
    listing.add_argument("--newest", action="store_true", help="the newest first")
    listing.add_argument("--limit", type=positive, metavar="N", help="only so many")
    command("status", run_status, "what a job is and how far it has come")
    command("watch", run_watch, "show a job live until it ends; Ctrl-C leaves the job running")
    command("wait", run_wait, "return when a job has ended; exit 0 only if it succeeded")
    command("cancel", order("cancel"), "stop a job, waiting or running, for good")
    command("pause", order("pause"), "stop a job, waiting or running, until it is resumed")
    command("resume", order("resume"), "queue a paused job again")
    command("retry", order("retry"), "queue a quarantined job again, or one whose result was damaged on disk")
    pin = command("pin", run_pin, "keep a job and its results for ever")
    pin.add_argument("--off", action="store_true", help="keep it no longer than others")
    queue = command("queue", run_queue, "let no more jobs start, or let them start again", job=False)
    queue.add_argument("what", choices=["pause", "resume"])
    command("report", run_report, "the figures of a finished job")
    fetch = command("fetch", run_fetch, "get a result; waits for a job that still runs", as_json=False)
    fetch.add_argument("-o", "--output", metavar="FILE", required=True, help="where to write, or - for stdout")
    fetch.add_argument("--format", choices=["ndjson", "binary", "csv", "tokens", "gzip", "binvox", "zip"],
                       help="form of the trajectory, default ndjson, of the timeline, default tokens, or of the stock, default binvox; zip: "
                            "what stands after each milling tool")
    fetch.add_argument("--artifact", choices=["trajectory", "timeline", "voxels", "stock", "surface", "residue", "report", "program"],
                       default="trajectory")
    fetch.add_argument("--dialect", choices=["krl", "rapid", "urscript", "fanuc", "gcode", "ros2"],
                       help="of a program (.zip): the language of the controller")
    fetch.add_argument("--name", help="of a program: what it is called, default sculpt")
    for flag, metavar, summary in (("--feed", "M_S", "speed of the ball on cuts"), ("--rapid", "M_S", "speed of the ball on moves; 0.5"),
                                   ("--keep-feed", "SHARE", "refuse it unless every cut keeps this share of the feed")):
        fetch.add_argument(flag, type=float, metavar=metavar, help="of a program: " + summary)
    fetch.add_argument("--part-keyframes", type=positive, metavar="M", help="of a program: keyframes in a part at most")
    fetch.add_argument("--part-bytes", type=positive, metavar="B", help="of a program: bytes of a part at most")
    fetch.add_argument("--stock-files", action="store_true", help="of a program: with each part what stands when it begins (.binvox)")
    fetch.add_argument("--seams-in-stock", action="store_true", help="of a program: let parts begin and end in the material")
    command("verify", run_verify, "let the server replay a job's trajectory; exit 0 only if it is clean")
    cell = command("cell", run_cell, "let the server say what is wrong with a cell, and the cure; exit 0 only if it can be planned with", job=False)
    cell.add_argument("cell", metavar="CELL", help="name of a cell on the server, or a cell file here")
    cell.add_argument("--resolution", type=int, default=64, metavar="N", help="for a tool that follows the voxels, default 64")
    options = parser.parse_args(joined_lists(sys.argv[1:] if arguments is None else arguments))
    options.server = getattr(options, "server", default)
    return options


def add_submit_options(submit):
    submit.add_argument("mesh", metavar="MESH", help=".stl .obj .ply .gltf .glb or .binvox")
    submit.add_argument("--resolution", type=int, required=True, metavar="N", help="power of two, 8 to 1024")
    submit.add_argument("--robot", required=True, metavar="CELL", help="name of a cell on the server, or a cell file here")
    submit.add_argument("--search", metavar="NAME", help="the planner; default is the server's")
    submit.add_argument("--seed", type=int, default=0, metavar="K")
    submit.add_argument("--allow-freed", action="store_true", help="let pieces come loose while a translating robot carves")
    submit.add_argument("--tools", type=lambda text: text.split(","), metavar="NAME,...",
                        help="carve with these milling tools, in this order; search is then 'mill'")
    submit.add_argument("--tool-library", metavar="FILE", help="the file that they are in")
    submit.add_argument("--tolerance", type=float, metavar="METRES", help="what may stand above the surface where these tools come to it")
    submit.add_argument("--scallop", type=float, metavar="METRES", help="of that, between rows")
    submit.add_argument("--allowance", type=float, metavar="METRES", help="of that, left on purpose")
    submit.add_argument("--feed", type=float, metavar="M_S", help="tell in the report how long the plan takes at this speed on cuts")
    submit.add_argument("--rapid", type=float, metavar="M_S", help="the same on moves; 0.5")
    submit.add_argument("--keep-feed", type=float, metavar="SHARE", help="let the job fail unless every cut keeps this share of the feed")
    submit.add_argument("--priority", type=int, metavar="P", help="higher runs first, -100 to 100")
    submit.add_argument("--queue", metavar="NAME", help="let only daemons plan it that serve this queue")
    submit.add_argument("--not-before", metavar="TIME", help="hold it until then, UTC: 2026-01-31T12:00:00Z")
    submit.add_argument("--start-by", metavar="TIME", help="let it expire if it has not started by then")
    submit.add_argument("--max-runtime", dest="max_runtime_s", type=int, metavar="SECONDS", help="end a run that takes longer")
    submit.add_argument("--key", metavar="KEY", help="your own name for this job: submitting it twice makes one job")
    submit.add_argument("--wait", action="store_true", help="wait for the end, with progress on stderr")
    submit.add_argument("--scale", type=float, metavar="METRES", help="metres per unit of the mesh file")
    submit.add_argument("--rotate", type=numbers(3), metavar="R,P,Y", help="degrees about x, y, z")
    submit.add_argument("--offset", type=numbers(3), metavar="X,Y,Z", help="metres")
    submit.add_argument("--margin", type=float, metavar="METRES")
    stock = submit.add_mutually_exclusive_group()
    stock.add_argument("--stock-box", type=numbers(6), metavar="X0,Y0,Z0,X1,Y1,Z1", help="metres from the grid's corner")
    stock.add_argument("--stock", metavar="FILE", help="mesh or .binvox of the stock")
    submit.add_argument("--continue", dest="continued", metavar="JOB",
                        help="carve on in what this job left, with --rotate turning the block, by quarters")


def main(arguments=None):
    try:
        options = parse_command_line(arguments)
        return options.run(options)
    except Failure as failure:
        print(f"sculpt: {failure.code}: {failure}", file=sys.stderr)
        return failure.exit_code
    except KeyboardInterrupt:
        return FAILED
    except BrokenPipeError:
        sys.stderr.close()
        return FAILED


if __name__ == "__main__":
    sys.exit(main())
