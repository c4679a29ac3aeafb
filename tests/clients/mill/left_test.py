"""What a milled plan leaves: the surface, the stock after each tool, and both as pictures; each told by another way too."""

import io
import json
import struct
import unittest
import zipfile

import shapes
from harness import DaemonTest
from mill import milled

import sculpt


class Left(DaemonTest):
    def setUp(self):
        super().setUp()
        self.cell = milled.write_cell(self.scratch)
        self.mesh = shapes.write_stl(self.scratch / "ball.stl", shapes.ball(24))

    def submit(self, *options):
        return self.fine("submit", self.mesh, "--resolution", 16, "--robot", self.cell, "--tolerance", 0.0005, *options, "--wait").split()[0]

    def fetch(self, job, *options):
        self.fine("fetch", job, *options, "-o", self.scratch / "fetched")
        return (self.scratch / "fetched").read_bytes()

    def test_surface_stocks_and_timeline_tell_the_same(self):
        job = self.submit("--tools", "D20,D12")
        report = json.loads(self.fine("report", job, "--json"))
        header, runs, cuts = sculpt.read_timeline(self.fetch(job, "--artifact", "timeline"))
        self.assertEqual(len(cuts), report["path"]["keyframes"])
        self.assertEqual([cut for cut in cuts if isinstance(cut, int)], [1], "one change of tools")
        self.assertEqual(sum(length for label, length in runs if label != "air"), 16 ** 3)
        gone = [self.index(voxel) for cut in cuts if isinstance(cut, list) for run in cut for voxel in self.voxels(run)]
        self.assertEqual(len(gone), report["voxels"]["removed"])
        self.assertEqual(len(set(gone)), len(gone), "each voxel once")

        with zipfile.ZipFile(io.BytesIO(self.fetch(job, "--artifact", "stock", "--format", "zip"))) as stocks:
            self.assertEqual(stocks.namelist(), ["1-D20.binvox", "2-D12.binvox"])
            first, last = (stocks.read(name) for name in stocks.namelist())
        self.assertEqual(last, self.fetch(job, "--artifact", "stock"))
        change = cuts.index(1)
        by_first = sum(1 for cut in cuts[:change] if cut for run in cut for _ in self.voxels(run))
        self.assertEqual(self.standing(first), 16 ** 3 - by_first)
        self.assertEqual(self.standing(last), 16 ** 3 - len(gone))

        vertices, faces = self.read_ply(self.fetch(job, "--artifact", "surface"))
        self.assertGreater(len(vertices), 3000)
        self.assertEqual({index for face in faces for index in face}, set(range(len(vertices))))
        self.assertTrue(all(excess >= 0 for *_, excess in vertices))
        bottom = min(z for _, _, z, _ in vertices) + 0.0001
        is_base = [z < bottom and excess < 0.001 for _, _, z, excess in vertices]
        beside_base = {index for face in faces if not all(is_base[corner] for corner in face) for index in face}
        within = sum(vertices[index][3] <= 0.0005 for index in beside_base) / len(beside_base)
        surface = report["surface"]
        self.assertAlmostEqual(within, surface["within_tolerance"] / surface["points"], delta=0.03)

        (self.scratch / "plan.ndjson").write_bytes(self.fetch(job))
        for subject, *options in ((job,), (job, "--robot", self.cell), ("plan.ndjson",)):
            self.assertIn(f"{len(gone)} voxels removed", self.fine("render", subject, "-o", "a.png", *options))

    def test_a_plan_made_here_has_the_same_surface(self):
        job = self.submit("--tools", "D20")
        self.fine("plan", self.mesh, "--resolution", 16, "--robot", self.cell, "--tolerance", 0.0005, "--tools", "D20", "-o", self.scratch / "here.csv",
                  "--surface", self.scratch / "here.ply")
        self.assertEqual((self.scratch / "here.ply").read_bytes(), self.fetch(job, "--artifact", "surface"))
        self.refused(2, "usage", "plan", self.mesh, "--resolution", 16, "--robot", "gantry", "-o", "b.sct", "--surface", "b.ply")

    def test_without_tools_there_is_none(self):
        job = self.fine("submit", self.mesh, "--resolution", 16, "--robot", "gantry", "--wait").split()[0]
        self.refused(4, "wrong_state", "fetch", job, "--artifact", "surface", "-o", self.scratch / "none.ply")
        self.refused(4, "wrong_state", "fetch", job, "--artifact", "stock", "--format", "zip", "-o", self.scratch / "none.zip")

    @staticmethod
    def index(voxel):
        return voxel[0] + 16 * (voxel[1] + 16 * voxel[2])

    @staticmethod
    def voxels(run):
        (x, y, z), (end, *_) = run
        return [(at, y, z) for at in range(x, end + 1)]

    @staticmethod
    def standing(binvox):
        data = binvox.partition(b"data\n")[2]
        return sum(length for value, length in zip(data[::2], data[1::2]) if value)

    @staticmethod
    def read_ply(data):
        head, _, body = data.partition(b"end_header\n")
        counts = {words[1]: int(words[2]) for words in (line.split() for line in head.decode().splitlines()) if words[:1] == ["element"]}
        vertex, face = struct.Struct("<4f3B"), struct.Struct("<B3i")
        assert len(body) == counts["vertex"] * vertex.size + counts["face"] * face.size
        end = counts["vertex"] * vertex.size
        return [row[:4] for row in vertex.iter_unpack(body[:end])], [row[1:] for row in face.iter_unpack(body[end:])]


if __name__ == "__main__":
    unittest.main()
