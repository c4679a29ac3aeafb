#!/usr/bin/env python3
"""driver.py: streams a job's motion to a robot at a fixed rate, and can pause on the path; standard library only.

An example to begin a driver of your own with (KUKA RSI, ABB EGM, Fanuc Stream Motion, Franka FCI, EtherCAT): put the
controller's own interface in the place of SimulatedRobot. Tried alone:
    driver.py JOB --feed 0.05 [--rate 250] [--cell config/cells/panda-turntable.json]
where Enter pauses, Enter again goes on, and Ctrl-C is a power cut. docs/cell-controller.md explains it.
"""

import argparse
import collections
import json
import math
import os
import pathlib
import select
import struct
import sys
import time

import sculpt

SAME_PLACE = 1e-3  # rad or m: what a robot's own position may be off


class DriverError(Exception):
    """What must not be driven; the sentence says why, and the cure."""


class SimulatedRobot:
    """A controller that takes a position of every joint each cycle, and refuses what its limits forbid.

    `limits`: for each joint (velocity, acceleration, jerk); without them it watches nothing.
    """

    def __init__(self, position, rate_hz, limits=()):
        self.rate_hz, self.limits, self.cycles = rate_hz, limits, 0
        self.place(position)

    def place(self, position):
        """It stands there, as if somebody had moved it by hand."""
        self.before = collections.deque([tuple(position)] * 4, maxlen=4)

    @property
    def position(self):
        return self.before[-1]

    def stands(self):
        return len(set(self.before)) == 1

    def take(self, position):
        """One cycle. Raises DriverError where differences of positions are over the limits."""
        self.before.append(tuple(position))
        self.cycles += 1
        for joint, (velocity, acceleration, jerk) in enumerate(self.limits):
            a, b, c, d = (place[joint] for place in self.before)
            for what, value, limit in (("velocity", (d - c) * self.rate_hz, velocity),
                                       ("acceleration", (d - 2 * c + b) * self.rate_hz**2, acceleration),
                                       ("jerk", (d - 3 * c + 3 * b - a) * self.rate_hz**3, jerk)):
                if abs(value) > 1.001 * limit:
                    raise DriverError(f"in cycle {self.cycles} the {what} of joint {joint} is {value:.5g}, over its limit of {limit:.5g}")


class Driver:
    """Goes through a job's motion sample by sample: one `step` a cycle. Not shared between threads.

    `client`: a sculpt.Client. `motion`: {"feed_m_s": ...}, as job.samples has it. It asks for `ahead_s` of samples at a time.
    A pause begins `notice_s` after it was asked for: in that time the samples of the hold must have come.
    """

    def __init__(self, client, job, motion, rate_hz=250.0, ahead_s=2.0, notice_s=0.02):
        self.client, self.job, self.motion, self.rate_hz = client, job, motion, rate_hz
        self.ahead, self.notice = max(2, math.ceil(ahead_s * rate_hz)), max(1, math.ceil(notice_s * rate_hz))
        self._forget()

    def _forget(self):
        self.ready = collections.deque()  # samples that have come, the next one first
        self.next = 0  # its number
        self.last = None  # the number of the last one of the motion
        self.holds, self.rest, self.paused = [], None, False  # rest: the number of the first sample that stands

    def start(self, robot):
        """From the beginning: also after a power cut, since material only shrinks, and what was cut is air then.

        Raises DriverError unless the robot stands where the motion begins: nobody knows a way there that is free.
        """
        self._forget()
        self._fetch()
        off, joint = max((abs(is_at - begin), joint) for joint, (is_at, begin) in enumerate(zip(robot.position, self.ready[0])))
        if off > SAME_PLACE or not robot.stands():
            raise DriverError(f"joint {joint} of the robot is {off:.4g} off where job {self.job} begins, or it moves: "
                              "retract the tool and bring the robot home first")

    def pause(self):
        """It comes to rest on its path, and stays there; `resting` says when it has."""
        if self.paused or self.finished:
            return
        self.paused = True
        if self.rest is not None and self.next <= self.rest:
            return  # it was resumed before it came to rest
        while len(self.ready) > self.notice:
            self.ready.pop()  # another motion now
        while len(self.ready) < self.notice and not self._has_all():
            self._fetch()
        if self._has_all():
            return  # it ends before it could rest
        self.holds.append((self.next + len(self.ready)) / self.rate_hz)
        self.rest = math.ceil(self._fetch()[-1] * self.rate_hz - 1e-9)

    def resume(self):
        """Goes on from the rest; where it is not come to yet, it rests for a moment only."""
        self.paused = False

    @property
    def resting(self):
        return self.paused and self.rest is not None and self.next > self.rest

    @property
    def finished(self):
        return self.last is not None and self.next > self.last

    def step(self, robot):
        """One cycle: the next sample, or the same again while it rests. False once the motion is over."""
        if self.finished:
            return False
        if self.resting:
            robot.take(robot.position)
            return True
        if not self.ready:
            self._fetch()
        robot.take(self.ready.popleft())
        self.next += 1
        return True

    def _has_all(self):
        return self.last is not None and self.next + len(self.ready) > self.last

    def _fetch(self):
        """The samples behind those that are ready; gives when the holds rest."""
        first = self.next + len(self.ready)
        result, chunk = self.client.call("job.samples", job=self.job, motion=self.motion, rate_hz=self.rate_hz, holds_s=self.holds,
                                         from_s=first / self.rate_hz, count=self.ahead)
        if result["first"] != first:
            raise DriverError(f"sample {first} was asked for and {result['first']} came: take a rate that samples can be counted at")
        joints = len(result["joints"])
        self.ready.extend(row[:joints] for row in struct.iter_unpack(f"<{2 * joints}d", chunk))
        self.last = result["samples"] - 1
        return result["rests_s"]


def limits_of(cell_path, joints):
    """(velocity, acceleration, jerk) of each joint; what the cell leaves to the URDF is not looked at."""
    limits = json.loads(pathlib.Path(cell_path).read_text()).get("limits", {})
    return [tuple(limits.get(joint, {}).get(what, math.inf) for what in ("velocity", "acceleration", "jerk")) for joint in joints]


def is_key_pressed():
    return bool(select.select([sys.stdin], [], [], 0)[0]) and bool(sys.stdin.readline())


def drive(driver, cell=None, wait=True):
    """To the end. Enter pauses, and goes on."""
    begin, chunk = driver.client.call("job.samples", job=driver.job, motion=driver.motion, rate_hz=driver.rate_hz, count=1)
    home = struct.unpack(f"<{2 * len(begin['joints'])}d", chunk)[:len(begin["joints"])]
    robot = SimulatedRobot(home, driver.rate_hz, limits_of(cell, begin["joints"]) if cell else ())
    driver.start(robot)
    due = time.monotonic()
    while driver.step(robot):
        if not wait:
            continue
        if is_key_pressed():
            (driver.resume if driver.paused else driver.pause)()
        due += 1 / driver.rate_hz
        time.sleep(max(0.0, due - time.monotonic()))
    print(f"{robot.cycles} cycles, {driver.last / driver.rate_hz:.3f} s of motion")


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Streams a job's motion to a simulated robot; Enter pauses, Enter again goes on.")
    parser.add_argument("job", metavar="JOB")
    parser.add_argument("--server", default=os.environ.get("SCULPT_SERVER", "127.0.0.1:7878"), metavar="HOST:PORT")
    parser.add_argument("--feed", type=float, metavar="M_S", help="speed of the ball on cuts; milling tools have their own")
    parser.add_argument("--rate", type=float, default=250.0, metavar="HZ")
    parser.add_argument("--cell", metavar="FILE", help="a cell file whose limits the robot is to watch")
    parser.add_argument("--no-wait", action="store_true", help="as fast as samples come")
    options = parser.parse_args(arguments)
    try:
        with sculpt.Client(options.server) as client:
            motion = {} if options.feed is None else {"feed_m_s": options.feed}
            drive(Driver(client, options.job, motion, options.rate), options.cell, not options.no_wait)
        return 0
    except (sculpt.Failure, DriverError) as failure:
        print(f"driver: {failure}", file=sys.stderr)
    except KeyboardInterrupt:
        print("driver: cut off: bring the robot home, then start again", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
