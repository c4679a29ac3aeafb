"""The .sct form of a trajectory: what `sculpt plan` writes, read by the Python client."""

import hashlib
import json
import random
import sys
import unittest
import zlib

import shapes
from harness import SOURCE, ClientTest

sys.path.insert(0, str(SOURCE / "clients/python"))
import sculpt  # noqa: E402


class Sct(ClientTest):
    def plan(self, robot, resolution):
        mesh = shapes.write_stl(self.scratch / "steps.stl", shapes.steps())
        for name in ("plan.ndjson", "plan.sct"):
            self.fine("plan", mesh, "--resolution", resolution, "--robot", robot, "-o", name)
        return self.scratch / "plan.ndjson", self.scratch / "plan.sct"

    def refusal(self, content):
        (self.scratch / "bad.sct").write_bytes(content)
        with self.assertRaises(sculpt.Failure) as caught:
            list(sculpt.read_sct(self.scratch / "bad.sct"))
        self.assertEqual((caught.exception.exit_code, caught.exception.code), (4, "trajectory_invalid"))
        return str(caught.exception)

    def test_the_client_reads_what_the_text_says(self):
        for robot, resolution in (("panda-turntable", 8), ("gantry", 32)):
            with self.subTest(robot=robot):
                ndjson, sct = self.plan(robot, resolution)
                lines = [json.loads(line) for line in ndjson.read_text().splitlines()]
                self.assertEqual(list(sculpt.read_sct(sct)), lines[:-1])

    def test_it_takes_a_fraction_of_the_text(self):
        ndjson, sct = self.plan("panda-turntable", 16)
        self.assertLess(sct.stat().st_size, ndjson.stat().st_size / 4)

    def test_several_segments_are_read_one_after_the_other(self):
        ndjson, sct = self.plan("panda-turntable", 32)
        keyframes = len(ndjson.read_text().splitlines()) - 2
        self.assertGreater(keyframes, 4096)
        self.assertEqual(sum(1 for _ in sculpt.read_sct(sct)), keyframes + 1)

    def test_changed_and_truncated_files_are_refused(self):
        _, sct = self.plan("panda-turntable", 8)
        whole = sct.read_bytes()
        source = random.Random(1)
        for at in source.sample(range(len(whole)), 300):
            with self.subTest(byte=at):
                self.refusal(whole[:at])
                self.refusal(whole[:at] + bytes([whole[at] ^ source.randrange(1, 256)]) + whole[at + 1:])
        self.refusal(whole + b"x")
        self.refusal(b"")

    def test_headers_that_make_no_sense_are_refused(self):
        for header in (b"", b"{", b"[]", b"{}", b'{"joints":["a"]}', b'{"joints":1,"resolution":8}', b"\xff"):
            with self.subTest(header=header):
                preamble = b"SCULPTRJ\2\0\0\0" + len(header).to_bytes(4, "little") + header
                self.assertIn("header", self.refusal(preamble + zlib.crc32(preamble).to_bytes(4, "little")))

    def test_lies_with_fitting_checksums_are_refused(self):
        header = json.dumps({"joints": ["a"], "resolution": 8}).encode()
        preamble = b"SCULPTRJ\2\0\0\0" + len(header).to_bytes(4, "little") + header
        preamble += zlib.crc32(preamble).to_bytes(4, "little")
        for body, why in ((b"\0\0\0\x01", "zeros"), (b"\0\4\2", "order"), (b"\2\0\2", "grid"), (b"\0\0\2\2", "more"),
                          (b"\0\0", "too short"), (b"\0\0\x80", "does not end"), (b"\0\0" + b"\xff" * 9 + b"\2", "64 bits"),
                          (b"\0\1" + b"\xff" * 9 + b"\1", "out of range"), (b"\0\0\0" + b"\xff" * 8 + b"\1", "zeros")):
            with self.subTest(why=why):
                head = b"\1" + (1).to_bytes(4, "little") + bytes(8) + len(body).to_bytes(4, "little")
                file = preamble + head + zlib.crc32(head + body).to_bytes(4, "little") + body
                self.assertIn(why, self.refusal(file + hashlib.sha256(file).hexdigest().encode()))


if __name__ == "__main__":
    unittest.main()
