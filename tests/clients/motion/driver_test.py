"""driver.py: a part is run at 250 Hz from job.samples, paused, resumed, cut off and started again."""

import json
import math
import random
import unittest

import shapes
from harness import SOURCE, DaemonTest

import driver
import sculpt

RATE_HZ = 250
MOTION = {"feed_m_s": 0.2}
# Franka's, and what config/cells/panda-turntable.json says of the table; velocities are those of the URDF.
VELOCITIES = {"table": 1, **{f"joint{n}": 2.175 if n < 5 else 2.61 for n in range(1, 8)}}


class Driver(DaemonTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.link = sculpt.Client(cls.server)
        cls.addClassCleanup(cls.link.close)
        cls.job = cls.submit("panda-turntable")
        result, _ = cls.link.call("job.samples", job=cls.job, motion=MOTION, rate_hz=RATE_HZ, count=1)
        cls.samples = list(cls.link.samples(cls.job, RATE_HZ, motion=MOTION))
        own = driver.limits_of(SOURCE / "config/cells/panda-turntable.json", result["joints"])
        cls.limits = [(min(VELOCITIES[joint], limits[0]), *limits[1:]) for joint, limits in zip(result["joints"], own)]
        lines = b"".join(cls.link.read_artifact(cls.job)).splitlines()
        cls.home, cls.end = json.loads(lines[0])["home"], json.loads(lines[-2])["q"]

    @classmethod
    def submit(cls, robot):
        mesh = cls.link.upload_file(shapes.write_stl(cls.daemon.data.parent / "ball.stl", shapes.ball(24)))
        job = cls.link.submit({"mesh": mesh, "robot": robot, "resolution": 8})["job"]
        assert cls.link.wait(job)["state"] == "succeeded"
        return job

    def make(self, **options):
        return driver.Driver(self.link, self.job, MOTION, RATE_HZ, **options), driver.SimulatedRobot(self.home, RATE_HZ, self.limits)

    def at_end(self, robot):
        for position, end in zip(robot.position, self.end):
            self.assertAlmostEqual(position, end, places=9)

    def test_a_part_is_run_from_home_to_its_end(self):
        drive, robot = self.make()
        drive.start(robot)
        while drive.step(robot):
            pass
        self.assertEqual(robot.cycles, len(self.samples))
        self.at_end(robot)

    def test_it_is_paused_anywhere_rests_on_its_path_and_goes_on(self):
        dice = random.Random(11)
        drive, robot = self.make(ahead_s=0.3)
        drive.start(robot)
        pauses = sorted(dice.sample(range(len(self.samples)), 12))
        while drive.step(robot):
            if not pauses or drive.next < pauses[0]:
                continue
            pauses.pop(0)
            drive.pause()
            self.assertTrue(drive.paused)
            stopping = 0
            while not drive.resting and drive.step(robot):
                stopping += 1
            self.assertLess(stopping, RATE_HZ)
            stood = robot.cycles
            for _ in range(50):
                drive.step(robot)
            if not drive.finished:
                self.assertEqual(robot.cycles, stood + 50)
                self.assertTrue(robot.stands())
            drive.pause()  # told twice
            drive.resume()
        self.assertEqual(len(drive.holds), 12)
        self.at_end(robot)

    def test_resumed_before_it_rests_and_paused_again(self):
        drive, robot = self.make()
        drive.start(robot)
        for _ in range(400):
            drive.step(robot)
        drive.pause()
        drive.step(robot)
        drive.resume()
        drive.step(robot)
        drive.pause()
        self.assertEqual(len(drive.holds), 1)
        while not drive.resting:
            drive.step(robot)
        drive.resume()
        while drive.step(robot):
            pass
        self.at_end(robot)

    def test_cut_off_it_starts_again_from_home_only(self):
        drive, robot = self.make()
        drive.start(robot)
        for _ in range(len(self.samples) // 2):
            drive.step(robot)
        robot.place(robot.position)  # the brakes fell in
        drive, _ = self.make()  # nothing of before is known
        with self.assertRaisesRegex(driver.DriverError, "home first"):
            drive.start(robot)
        robot.place(self.home)
        drive.start(robot)
        while drive.step(robot):
            pass
        self.at_end(robot)

    def test_a_pause_at_the_end_lets_it_end(self):
        drive, robot = self.make()
        drive.start(robot)
        for _ in range(len(self.samples) - 3):
            drive.step(robot)
        drive.pause()
        while drive.step(robot):
            pass
        drive.pause()
        self.at_end(robot)

    def test_the_simulated_robot_finds_what_is_over_its_limits(self):
        robot = driver.SimulatedRobot([0.0], 100, [(1, 10, math.inf)])
        with self.assertRaisesRegex(driver.DriverError, "velocity"):
            robot.take([0.02])
        robot.place([0.0])
        with self.assertRaisesRegex(driver.DriverError, "acceleration"):
            robot.take([0.005])

    def test_windows_are_those_of_one_go_and_of_the_command_line(self):
        window = list(self.link.samples(self.job, RATE_HZ, from_s=1, to_s=2, motion=MOTION))
        self.assertEqual(window, self.samples[RATE_HZ:2 * RATE_HZ + 1])
        self.assertEqual(list(self.link.samples(self.job, RATE_HZ, from_s=1, count=7, motion=MOTION)), window[:7])
        self.fine("sample", self.job, "--rate", RATE_HZ, "--feed", 0.2, "--from", 1, "--to", 2, "-o", "samples.csv")
        rows = (self.scratch / "samples.csv").read_text().splitlines()[1:]
        self.assertEqual(len(rows), len(window))
        for row, (t, positions, velocities) in zip(rows, window):
            for text, value in zip(row.split(","), (t, *positions, *velocities)):
                self.assertAlmostEqual(float(text), value, places=6)

    def test_what_has_no_samples(self):
        with self.assertRaises(sculpt.Failure) as refused:
            self.link.call("job.samples", job=self.job, rate_hz=RATE_HZ)
        self.assertEqual(refused.exception.code, "feed_invalid")
        with self.assertRaises(sculpt.Failure) as refused:
            self.link.call("job.samples", job=self.job, rate_hz=RATE_HZ, motion={**MOTION, "keep_feed": 1})
        self.assertEqual(refused.exception.code, "feed_not_kept")
        mesh = self.link.upload_file(shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24)))
        held = self.link.submit({"mesh": mesh, "robot": "gantry", "resolution": 8}, not_before="2100-01-01T00:00:00Z")["job"]
        with self.assertRaises(sculpt.Failure) as refused:
            self.link.call("job.samples", job=held, rate_hz=RATE_HZ, motion=MOTION)
        self.assertEqual(refused.exception.code, "wrong_state")


if __name__ == "__main__":
    unittest.main()
