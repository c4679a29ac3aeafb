"""A job that takes what another one left as its stock: --continue."""

import json
import unittest

import shapes
from harness import SCULPT, SCULPT_PY, SOURCE, DaemonTest

N = 16
BELL = SOURCE / "config/samples/bell.stl"
COMMON = ("--robot", "panda-turntable", "--resolution", N)


def read_binvox(content):
    """The voxels (i, j, k) that are set."""
    head, data = content.split(b"\ndata\n", 1)
    n = int(head.split(b"\ndim ")[1].split()[0])
    values = b"".join(bytes([value]) * length for value, length in zip(data[::2], data[1::2]))
    return {(at // n // n, at % n, at // n % n) for at, value in enumerate(values) if value}


def turned_over(voxels):
    """By half a turn about x."""
    return {(i, N - 1 - j, N - 1 - k) for i, j, k in voxels}


def set_down(voxels):
    low = min(k for _, _, k in voxels)
    return {(i, j, k - low) for i, j, k in voxels}


def cut_voxels(trajectory):
    """Every voxel that the lines remove."""
    for line in map(json.loads, trajectory.splitlines()):
        if line["type"] == "cut":
            first, last = line["voxels"]
            steps = max(abs(a - b) for a, b in zip(first, last))
            yield from (tuple(a + (b - a) * step // max(steps, 1) for a, b in zip(first, last)) for step in range(steps + 1))


class Continue(DaemonTest):
    client = SCULPT

    def submit(self, *options):
        return self.fine("submit", *options, "--wait").strip()

    def fetch(self, job, artifact):
        self.fine("fetch", job, "--artifact", artifact, "-o", artifact)
        return (self.scratch / artifact).read_bytes()

    def voxels(self, job, artifact):
        return read_binvox(self.fetch(job, artifact))

    def report(self, job):
        return json.loads(self.fine("report", job, "--json"))

    def test_two_clampings_remove_all_that_should_go(self):
        first = self.submit(BELL, *COMMON)
        hidden = self.report(first)["voxels"]["residue"]
        self.assertGreater(hidden, 100, "the hollow of the bell is open from below only")
        second = self.submit(BELL, *COMMON, "--continue", first, "--rotate", "180,0,0")
        for job in (first, second):
            self.assertIn("clean", self.fine("verify", job))
        self.assertEqual(json.loads(self.fine("status", second, "--json"))["continues"], first)

        target, left = self.voxels(first, "voxels"), self.voxels(first, "stock")
        removed = set(cut_voxels(self.fetch(first, "trajectory").decode()))
        block = {(i, j, k) for i in range(N) for j in range(N) for k in range(N)}
        self.assertEqual(block - removed, left)
        self.assertEqual(len(left - target), hidden)
        down = min(k for _, _, k in turned_over(left))
        removed_then = list(cut_voxels(self.fetch(second, "trajectory").decode()))
        self.assertEqual(len(removed_then), hidden)
        back = turned_over({(i, j, k + down) for i, j, k in removed_then})
        self.assertEqual(removed | back, block - target, "what the two remove together is all but the target")
        self.assertEqual(removed & back, set())
        self.assertEqual(self.voxels(second, "stock"), set_down(turned_over(target)))

    def test_a_third_goes_on_with_the_second(self):
        first = self.submit(BELL, *COMMON)
        second = self.submit(BELL, *COMMON, "--continue", first, "--rotate", "180,0,0")
        third = self.submit(BELL, *COMMON, "--continue", second, "--rotate", "180,0,0")
        self.assertEqual(self.voxels(third, "voxels"), self.voxels(first, "voxels"))
        self.assertEqual(self.report(third)["voxels"]["remove"], 0)

    def test_the_same_bytes_as_from_files(self):
        first = self.submit(BELL, *COMMON, "--margin", 0.02)
        second = self.submit(BELL, *COMMON, "--continue", first, "--rotate", "0,90,0")
        self.fine("plan", BELL, *COMMON, "--margin", 0.02, "--turn-over", "0,90,0", "-o", "here.sct")
        files = json.loads(self.fine("plan", "here.sct.target.binvox", "--stock", "here.sct.stock.binvox", *COMMON, "--json", "-o", "there.sct"))
        self.assertEqual(self.report(second)["plan_sha256"], files["plan_sha256"])

    def test_what_cannot_be_continued_is_refused(self):
        mesh = shapes.write_stl(self.scratch / "mesh.stl", shapes.steps())
        gantry = ("--robot", "gantry", "--resolution", 8)
        first = self.submit(mesh, *gantry)
        later = self.fine("submit", mesh, *gantry, "--not-before", "2100-01-01T00:00:00Z").strip()
        self.refused(4, "not_found", "submit", mesh, *gantry, "--continue", "0" * 26)
        self.refused(4, "wrong_state", "submit", mesh, *gantry, "--continue", later)
        self.refused(4, "resolution_invalid", "submit", mesh, "--robot", "gantry", "--resolution", 16, "--continue", first)
        self.refused(4, "placement_invalid", "submit", mesh, *gantry, "--continue", first, "--rotate", "0,45,0")
        whole = shapes.write_stl(self.scratch / "whole.stl", shapes.box((0, 0, 0), (1, 1, 1)))
        self.refused(4, "target_outside_stock", "submit", whole, *gantry, "--continue", first)
        for name in ("cell.json", "gantry.urdf"):
            folder = "cells/gantry.json" if name == "cell.json" else "robots/gantry.urdf"
            text = (SOURCE / "config" / folder).read_text()
            (self.scratch / name).write_text(text.replace("../robots/", "").replace('"size_m": 0.2', '"size_m": 0.1'))
        self.refused(4, "cell_invalid", "submit", mesh, "--robot", "./cell.json", "--resolution", 8, "--continue", first)
        for beside in (("--scale", 1), ("--offset", "0,0,0"), ("--margin", 0), ("--stock-box", "0,0,0,1,1,1"), ("--stock", mesh)):
            self.refused(2, "usage", "submit", mesh, *gantry, "--continue", first, *beside)


class ContinueFromPython(Continue):
    client = SCULPT_PY

    test_the_same_bytes_as_from_files = None  # sculpt.py does not plan


if __name__ == "__main__":
    unittest.main()
