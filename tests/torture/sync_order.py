#!/usr/bin/env python3
"""Watches the system calls of the daemon: between the last write to its log of transactions and the reply to a submit there is a sync."""

import argparse
import os
import re
import shutil

import kit
from kit import sculpt

CALLS = "trace=pwrite64,write,fdatasync,fsync,sendmsg,sendto"

REPLY = re.compile(r'send(msg|to)\(.*\\"duplicate\\":false')


def traced_daemon(folder, trace):
    """The daemon is our child, strace its tracer from aside."""
    wrapper = folder / "sculptd"
    wrapper.write_text(f"#!/bin/sh\nexec strace -D -f -y -s 200 -e {CALLS} -o '{trace}' '{os.environ['SCULPTD']}' \"$@\"\n")
    wrapper.chmod(0o755)
    before, os.environ["SCULPTD"] = os.environ["SCULPTD"], str(wrapper)
    try:
        return kit.Daemon(folder / "data", "--workers", "1")
    finally:
        os.environ["SCULPTD"] = before


def unsynced_replies(lines):
    """(replies to submits, those of them before which something written was not synced, those before which nothing was written)."""
    replies, bad, idle, unsynced, written = 0, 0, 0, False, False
    pending = {}  # thread -> a sync that strace shows in two parts
    for line in lines:
        thread, _, call = line.partition(" ")
        call = call.strip()
        if re.match(r"pwrite64\(\d+<[^>]*-wal>", call):
            unsynced = written = True
        elif re.match(r"f(data)?sync\(\d+<[^>]*-wal> <unfinished", call):
            pending[thread] = True
        elif re.match(r"f(data)?sync\(\d+<[^>]*-wal>\)\s*= 0", call):
            unsynced = False
        elif re.match(r"<\.\.\. f(data)?sync resumed>\)\s*= 0", call):
            unsynced = unsynced and not pending.pop(thread, False)
        elif REPLY.match(call):
            replies, bad, idle = replies + 1, bad + unsynced, idle + (not written)
            written = False
    return replies, bad, idle


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--submits", type=int, default=30)
    arguments = parser.parse_args()
    if not shutil.which("strace"):
        kit.skip("there is no strace: apt-get install strace")
    mesh = kit.ball()
    with kit.scratch_folder() as folder:
        trace = folder / "trace"
        with traced_daemon(folder, trace) as daemon, sculpt.Client(daemon.address) as client:
            client.upload(mesh)
            busy = client.submit(kit.spec(mesh, "panda-turntable", 128))["job"]  # the only worker: the jobs behind it are only submitted
            client.call("events.subscribe", job=busy)
            while client.next_event().get("data", {}).get("to") != "running":
                pass
            for n in range(arguments.submits):
                client.submit(kit.spec(mesh), key=f"job {n}")
        lines = trace.read_text(errors="replace").splitlines()
    if not any("sendmsg" in line or "sendto" in line for line in lines):
        kit.skip("strace may not trace here")
    first = next(n for n, line in enumerate(lines) if REPLY.search(line))  # to the job in front: the worker writes too by then
    replies, bad, idle = unsynced_replies(lines[first + 1:])
    kit.expect(replies == arguments.submits, f"{replies} replies were seen to {arguments.submits} submits")
    kit.expect(bad == 0, f"{bad} of {replies} submits were answered before what was written was synced")
    kit.expect(idle == 0, f"{idle} of {replies} submits were answered though nothing was written")
    print(f"{replies} submits, each synced before its reply")


if __name__ == "__main__":
    main()
