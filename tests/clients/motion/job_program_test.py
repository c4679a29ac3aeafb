"""Programs of a job from the daemon, by both clients and over HTTP; and what a client needs of a job's cell."""

import io
import json
import pathlib
import unittest
import urllib.error
import urllib.request
import zipfile

import shapes
from harness import SCULPT, SCULPT_PY, SOURCE, DaemonTest

import sculpt


class JobProgram(DaemonTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = pathlib.Path(cls.daemon.data.parent)
        mesh = shapes.write_stl(cls.folder / "ball.stl", shapes.ball(24))
        # A cell of one's own, under a name that nobody else has.
        cell = json.loads((SOURCE / "config/cells/six-axis-turntable.json").read_text())
        cell["urdf"] = str(SOURCE / "config/robots" / pathlib.Path(cell["urdf"]).name)
        cls.cell = cls.folder / "workshop.json"
        cls.cell.write_text(json.dumps(cell))
        with sculpt.Client(cls.server) as client:
            reference = {"mesh": client.upload_file(mesh), "resolution": 8}
            cls.job = client.submit({**reference, "robot": client.upload_cell(cls.cell)})["job"]
            cls.gantry = client.submit({**reference, "robot": "gantry"})["job"]
            for job in (cls.job, cls.gantry):
                assert client.wait(job)["state"] == "succeeded"

    def fetch(self, *options, job=None):
        self.fine("fetch", job or self.job, "--artifact", "program", *options, "-o", "program.zip")
        return (self.scratch / "program.zip").read_bytes()

    def test_it_is_what_sculpt_program_writes_whoever_asks(self):
        options = ("--dialect", "krl", "--feed", 0.05, "--part-keyframes", 100)
        self.client = SCULPT
        self.fine("program", self.job, *options, "-o", "bust")
        written = {f"bust/{path.name}": path.read_bytes() for path in (self.scratch / "bust").iterdir()}
        self.assertGreater(len(written), 4)
        packed = set()
        for self.client in (SCULPT, SCULPT_PY):
            packed.add(self.fetch(*options, "--name", "bust"))
        query = "dialect=krl&feed_m_s=0.05&part_keyframes=100&name=bust"
        with urllib.request.urlopen(f"http://{self.server}/v1/artifacts/{self.job}/program?{query}") as reply:
            packed.add(reply.read())
        self.assertEqual(len(packed), 1)
        with zipfile.ZipFile(io.BytesIO(packed.pop())) as archive:
            self.assertIsNone(archive.testzip())
            self.assertEqual({name: archive.read(name) for name in archive.namelist()}, written)
            self.assertEqual({entry.date_time for entry in archive.infolist()}, {(1980, 1, 1, 0, 0, 0)})
            self.assertEqual(archive.namelist()[-2:], ["bust/bust.src", "bust/bust.dat"])

    def test_parts_of_so_many_bytes(self):
        whole = self.fetch("--dialect", "rapid", "--feed", 0.05)
        parted = self.fetch("--dialect", "rapid", "--feed", 0.05, "--part-bytes", 12000)
        with zipfile.ZipFile(io.BytesIO(whole)) as archive:
            self.assertGreater(max(entry.file_size for entry in archive.infolist()), 12000)
        with zipfile.ZipFile(io.BytesIO(parted)) as archive:
            self.assertLessEqual(max(entry.file_size for entry in archive.infolist()), 12000)
        self.assertIn("--part-bytes", self.refused(4, "part_invalid", "fetch", self.job, "--artifact", "program", "--dialect", "rapid",
                                                   "--feed", 0.05, "--part-bytes", 500, "-o", "x.zip"))

    def test_a_broken_download_goes_on(self):
        url = f"http://{self.server}/v1/artifacts/{self.gantry}/program?dialect=gcode&feed_m_s=0.05"
        with urllib.request.urlopen(url) as reply:
            whole, tag = reply.read(), reply.headers["ETag"]
            self.assertEqual(reply.headers["Content-Type"], "application/zip")
        with urllib.request.urlopen(urllib.request.Request(url, headers={"Range": "bytes=100-", "If-Range": tag})) as reply:
            self.assertEqual((reply.status, reply.read()), (206, whole[100:]))

    def test_what_cannot_be_written_is_refused_with_the_cure(self):
        program = ("--artifact", "program", "-o", "x.zip")
        for self.client in (SCULPT, SCULPT_PY):
            self.refused(2, "usage", "fetch", self.gantry, *program)
            self.refused(2, "usage", "fetch", self.gantry, "--dialect", "krl", "-o", "x.zip")
            self.assertIn("name robot axes A1 to A6", self.refused(4, "axes_unfit", "fetch", self.gantry, *program, "--dialect", "krl", "--feed", 0.05))
            self.assertIn("thin tool", self.refused(4, "feed_invalid", "fetch", self.gantry, *program, "--dialect", "gcode"))
            self.assertIn("lower-case", self.refused(4, "name_invalid", "fetch", self.gantry, *program, "--dialect", "gcode", "--feed", 0.05, "--name", "No"))
            self.assertIn("--seams-in-stock", self.refused(
                4, "part_invalid", "fetch", self.gantry, *program, "--dialect", "gcode", "--feed", 0.05, "--part-keyframes", 1))
        for query, status, word in (("dialect=apt", 422, "dialect_unknown"), ("feed_m_s=1", 400, "params_invalid"), ("dialect=krl&feed_m_s=1", 422, "axes_unfit")):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(f"http://{self.server}/v1/artifacts/{self.gantry}/program?{query}")
            self.assertEqual((refused.exception.code, json.load(refused.exception)["data"]["code"]), (status, word))

    def test_a_link_needs_no_token(self):
        link = json.loads(self.fine("link", self.gantry, "--artifact", "program", "--dialect", "gcode", "--feed", 0.05, "--name", "bust", "--json"))
        self.assertTrue(link["path"].endswith("/bust.zip"), link)
        with urllib.request.urlopen(f"http://{self.server}{link['path']}") as reply:
            self.assertEqual(reply.read(), self.fetch("--dialect", "gcode", "--feed", 0.05, "--name", "bust", job=self.gantry))

    def test_a_cell_that_was_sent_along_comes_back(self):
        told = json.loads(self.fine("time", self.job, "--feed", 0.05, "--json"))
        self.assertEqual(told, json.loads(self.fine("time", self.job, "--feed", 0.05, "--json", "--robot", str(self.cell))))
        self.fine("sample", self.job, "--rate", 10, "--feed", 0.05, "-o", "samples.csv")
        self.assertIn("a1", (self.scratch / "samples.csv").read_text().splitlines()[0])
        with sculpt.Client(self.server) as client:
            first, chunk = client.call("job.cell", job=self.job, offset=0, bytes=1 << 20)
            self.assertEqual(json.loads(json.loads(chunk)["cell"]), json.loads(self.cell.read_text()))
            for file in json.loads(chunk)["files"].values():
                piece, content = client.call("job.cell", job=self.job, file=file["blob"], offset=10, bytes=20)
                self.assertEqual((piece["file"], piece["bytes"], len(content)), (file["blob"], 20, 20))
            self.assertTrue(first["eof"])


if __name__ == "__main__":
    unittest.main()
