"""sculpt cell: what is wrong with a cell, its picture, and a cell from a maker's URDF."""

import json
import os
import pathlib
import stat
import subprocess
import unittest

import png
import shapes
from harness import SCULPT, SCULPT_PY, ClientTest, DaemonTest, environment, shared_data

ARM = """<robot name="maker">
  <link name="base"><collision><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.1" length="0.2"/></geometry></collision></link>
  <link name="l1"/>
  <joint name="j1" type="revolute"><parent link="base"/><child link="l1"/><origin xyz="0 0 0.21"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <link name="l2"><collision><origin xyz="0 0.12 0.2"/><geometry><mesh filename="parts/upper.stl"/></geometry></collision></link>
  <joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-1.9" upper="1.9" velocity="1" effort="1"/></joint>
  <link name="l3"><collision><origin xyz="0.15 0 0"/><geometry><box size="0.4 0.1 0.1"/></geometry></collision></link>
  <joint name="j3" type="revolute"><parent link="l2"/><child link="l3"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
    <limit lower="-2.4" upper="2.4" velocity="1" effort="1"/></joint>
  <link name="l4"/>
  <joint name="j4" type="revolute"><parent link="l3"/><child link="l4"/><origin xyz="0.4 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-3.1" upper="3.1" velocity="1" effort="1"/></joint>
  <link name="l5"><collision><geometry><sphere radius="0.03"/></geometry></collision></link>
  <joint name="j5" type="revolute"><parent link="l4"/><child link="l5"/><origin xyz="0.1 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-2.1" upper="2.1" velocity="1" effort="1"/></joint>
  <link name="tool0"/>
  <joint name="j6" type="revolute"><parent link="l5"/><child link="tool0"/><origin xyz="0.05 0 0" rpy="0 1.5707963267948966 0"/>
    <axis xyz="0 0 1"/><limit lower="-6" upper="6" velocity="1" effort="1"/></joint>
</robot>
"""


def copy_of_the_shipped_cell(folder, **changes):
    """The panda with its turntable, in a file of its own."""
    config = pathlib.Path(os.environ["SCULPT_SOURCE"]) / "config"
    cell = json.loads((config / "cells/panda-turntable.json").read_text())
    cell["urdf"] = str(config / "robots/panda-turntable.urdf")
    cell.update(changes)
    path = folder / "cell.json"
    path.write_text(json.dumps(cell))
    return path


class Cell(ClientTest):
    def test_shipped_cells_are_ready(self):
        for name in ("panda-turntable", "gantry"):
            found = json.loads(self.fine("cell", name, "--json"))
            self.assertTrue(found["plannable"], name)
            self.assertEqual((found["cell"], found["faults"], found["reached"]), (name, [], 1))
        text = self.fine("cell", "panda-turntable")
        for word in ("ready to plan with", "8 joints", "carries the stock", "home: free", "straight down", "ignore_pairs"):
            self.assertIn(word, text)

    def test_fields_of_an_earlier_run_are_told(self):
        env = {**environment(), "SCULPT_CACHE": str(self.scratch / "cache")}
        for kept in (False, True):
            said = subprocess.run([*SCULPT, "cell", "panda-turntable"], env=env, capture_output=True, text=True, check=True).stdout
            self.assertEqual("kept from an earlier run" in said, kept, said)

    def test_a_home_that_plan_refuses_is_found_with_one_that_it_takes(self):
        cell = copy_of_the_shipped_cell(self.scratch, home={"joint2": 1.2})
        self.refused(4, "cell_invalid", "plan", shapes.write_stl(self.scratch / "m.stl", shapes.steps()), "--resolution", 8, "--robot", cell, "-o", "p.ndjson")
        done = self.run_client("cell", cell, "--json", "--picture", "home.png")
        self.assertEqual(done.returncode, 1, done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual(found["faults"][0]["code"], "home_blocked")
        self.assertFalse(found["home"]["free"])
        self.assertEqual(png.unpacked(self.scratch / "home.png")[:2], (1920, 640))
        cell = copy_of_the_shipped_cell(self.scratch, home=found["better_home"])
        self.assertIn("ready to plan with", self.fine("cell", cell))

    def test_what_cannot_be_read_is_a_fault_too(self):
        cell = copy_of_the_shipped_cell(self.scratch, stock={"link": "nowhere", "size_m": 0.2, "origin_m": [0, 0, 0]})
        done = self.run_client("cell", cell)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, "cannot be planned with, 1 error\n(?s:.*)no link 'nowhere'")
        self.refused(4, "cell_unknown", "cell", "nosuch")
        self.refused(2, "usage", "cell")


class New(ClientTest):
    def write_arm(self, urdf=ARM):
        (self.scratch / "maker/parts").mkdir(parents=True)
        shapes.write_stl(self.scratch / "maker/parts/upper.stl", shapes.box((-0.04, -0.03, -0.2), (0.04, 0.03, 0.2)))
        path = self.scratch / "maker/arm.urdf"
        path.write_text(urdf)
        return path

    def test_three_commands_from_a_makers_urdf_to_a_verified_plan(self):
        (self.scratch / "mine").mkdir()
        said = self.fine("cell", "new", self.write_arm(), "-o", "mine/cell.json")
        self.assertIn("ready to plan with", said)
        self.assertIn("the tool sits on 'tool0'", said)
        mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())
        report = json.loads(self.fine("plan", mesh, "--resolution", 8, "--robot", "mine/cell.json", "-o", "p.ndjson", "--json"))
        self.assertGreater(report["voxels"]["removed"], 0.9 * report["voxels"]["remove"])
        self.assertIn("clean", self.fine("verify", "p.ndjson", "--mesh", mesh, "--robot", "mine/cell.json"))

    def test_files_are_written_over_only_when_told(self):
        arm = self.write_arm()
        self.fine("cell", "new", arm, "-o", "cell.json", "--stock-at", "0.5,0,0.1")
        self.refused(2, "file_exists", "cell", "new", arm, "-o", "cell.json")
        self.fine("cell", "new", arm, "-o", "cell.json", "--force", "--stock-at", "0.5,0,0.1")
        self.refused(2, "usage", "cell", "new", arm, "-o", "cell.txt")

    def test_the_makers_own_file_is_never_written_over(self):
        arm = self.write_arm()
        before = arm.read_bytes()
        self.refused(2, "usage", "cell", "new", arm, "-o", arm.with_suffix(".json"), "--force")
        self.assertEqual(arm.read_bytes(), before)

    def test_the_same_robot_gives_the_same_cell(self):
        arm = self.write_arm()
        self.fine("cell", "new", arm, "-o", "a.json")
        self.fine("cell", "new", arm, "-o", "b.json")
        self.assertEqual((self.scratch / "a.urdf").read_bytes(), (self.scratch / "b.urdf").read_bytes())
        self.assertEqual((self.scratch / "a.json").read_text().replace("a.urdf", "b.urdf"), (self.scratch / "b.json").read_text())

    def with_xacro(self, script):
        """Runs with a program `xacro` of our own, or without one where there is no script."""
        folder = self.scratch / "bin"
        folder.mkdir(exist_ok=True)
        if script:
            (folder / "xacro").write_text(script)
            (folder / "xacro").chmod(stat.S_IRWXU)
        source = self.scratch / "maker/arm.urdf.xacro"
        source.write_text('<robot xmlns:xacro="http://ros.org/wiki/xacro"/>')
        before = os.environ["PATH"]
        os.environ["PATH"] = f"{folder}:/bin:/usr/bin" if script else str(folder)
        try:
            return self.run_client("cell", "new", source, "-o", "x.json", "--stock-at", "0.5,0,0.1", "--force", "--package", f"arm={self.scratch}/maker")
        finally:
            os.environ["PATH"] = before

    def test_a_xacro_source_is_written_out_by_xacro(self):
        self.write_arm()
        done = self.with_xacro('#!/bin/sh\ncase "$ROS_PACKAGE_PATH" in *maker*) cat "$(dirname "$1")/arm.urdf";; *) echo lost >&2; exit 1;; esac\n')
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        # As ROS 2 looks for the package that the source lies in.
        done = self.with_xacro('#!/bin/sh\np=${AMENT_PREFIX_PATH%%:*}\ntest -f $p/share/ament_index/resource_index/packages/maker && cat $p/share/maker/arm.urdf\n')
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.with_xacro("#!/bin/sh\necho no such macro >&2\nexit 2\n")
        self.assertEqual((done.returncode, "xacro_failed" in done.stderr, "no such macro" in done.stderr), (2, True, True), done.stderr)

    def test_without_xacro_the_cure_is_named(self):
        self.write_arm()
        done = self.with_xacro(None)
        self.assertEqual(done.returncode, 2)
        self.assertIn("xacro_missing", done.stderr)
        self.assertIn("install it", done.stderr)

    def test_the_makers_robots_that_are_at_hand(self):
        """KR 16 and Panda from their plain URDFs, all links as meshes."""
        ros = shared_data(self, "ros")
        for urdf, options in (("kuka_kr16_support/urdf/kr16_2.urdf", []),
                              ("moveit_resources_panda_description/urdf/panda.urdf", ["--without", "panda_hand", "--stock-at", "0.43,0,0.3"])):
            with self.subTest(urdf=urdf):
                said = self.fine("cell", "new", ros / urdf, "-o", "cell.json", "--force", *options)
                self.assertIn("ready to plan with", said)
                found = json.loads(self.fine("cell", "cell.json", "--json"))
                self.assertTrue(found["plannable"])
                self.assertGreater(found["reached"], 0.99)


class RemoteCell(DaemonTest):
    """The same from a server."""

    def found(self, *options):
        done = self.run_client("cell", *options)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        found = json.loads(done.stdout)
        del found["seconds"]
        return done.returncode, found

    def test_a_server_finds_what_is_found_here(self):
        broken = copy_of_the_shipped_cell(self.scratch, home={"joint2": 1.2})
        for cell in ("gantry", "panda-turntable", broken):
            here = self.found(cell, "--resolution", 16, "--json")
            self.assertEqual(self.found(cell, "--resolution", 16, "--json", "--server", self.server), here)
            self.client = SCULPT_PY
            self.assertEqual(self.found(cell, "--resolution", 16, "--json"), here)
            self.client = SCULPT
        self.assertEqual(here[0], 1)
        table = self.run_client("cell", broken, "--server", self.server).stdout
        self.assertIn("cannot be planned with, 1 error", table)
        self.assertIn("home: not free", table)
        self.client = SCULPT_PY
        self.assertIn("error: at home ", self.run_client("cell", broken).stdout)

    def test_the_environment_alone_asks_no_server(self):
        self.fine("cell", "gantry", "--resolution", 8, server="127.0.0.1:1")
        self.refused(3, "unreachable", "cell", "gantry", "--server", "127.0.0.1:1")
        self.refused(3, "unreachable", "--server", "127.0.0.1:1", "cell", "gantry")

    def test_what_cannot_be_asked_is_refused(self):
        self.refused(2, "usage", "cell", "gantry", "--server", self.server, "--picture", "home.png")
        self.refused(4, "cell_unknown", "cell", "nosuch", "--server", self.server)
        self.client = SCULPT_PY
        self.refused(4, "cell_unknown", "cell", "nosuch")
        self.refused(2, "file_missing", "cell", "./nosuch.json")


if __name__ == "__main__":
    unittest.main()
