"""sculpt render: what stands at a moment, as a picture; sculpt link: a result by its URL alone."""

import json
import re
import subprocess
import unittest
import urllib.error
import urllib.request

import png
from harness import PATIENCE_S, SCULPT, SOURCE, DaemonTest, environment

BUST = SOURCE / "config/samples/bust.stl"
PIXELS, RESOLUTION, MARGIN = 416, 16, 1.04


def columns(lines):
    """(i, j) that are cut from above to the floor, found from the lines of a trajectory alone."""
    gone = set()
    for line in lines:
        if line["type"] == "cut":
            first, last = line["voxels"]
            length = 1 + max(abs(a - b) for a, b in zip(first, last))
            step = [(b > a) - (b < a) for a, b in zip(first, last)]
            gone |= {tuple(a + m * s for a, s in zip(first, step)) for m in range(length)}
    return {(i, j) for i in range(RESOLUTION) for j in range(RESOLUTION) if all((i, j, k) in gone for k in range(RESOLUTION))}


class Render(DaemonTest):
    def plan(self, name, *options):
        self.fine("plan", BUST, "--resolution", RESOLUTION, "--robot", "panda-turntable", "-o", name, *options)
        return name

    def test_the_forms_of_a_plan_give_the_same_picture(self):
        self.plan("a.ndjson")
        self.plan("a.sct")
        job = self.fine("submit", BUST, "--resolution", RESOLUTION, "--robot", "panda-turntable", "--wait").split()[0]
        self.fine("fetch", job, "--artifact", "timeline", "-o", "a.timeline")
        for options in ([], ["--at", 0.4, "--from", "left", "--pixels", 200], ["--at", 0]):
            seen = set()
            for subject in ("a.ndjson", "a.sct", "a.timeline", job):
                said = self.fine("render", subject, "-o", "a.png", *options)
                self.assertRegex(said, r"^a\.png: \d+ voxels removed, 0 left over\n$")
                seen.add((self.scratch / "a.png").read_bytes())
            self.assertEqual(len(seen), 1, options)
        for options in ([], ["--at", 0.4]):
            seen = set()
            for subject in ("a.ndjson", job):
                self.fine("render", subject, "-o", "a.png", "--robot", "panda-turntable", *options)
                seen.add((self.scratch / "a.png").read_bytes())
            self.assertEqual(len(seen), 1, options)

    def test_from_above_one_sees_through_where_all_is_cut(self):
        self.plan("a.ndjson")
        self.fine("render", "a.ndjson", "-o", "a.png", "--from", "top", "--pixels", PIXELS)
        width, height, pixel = png.read(self.scratch / "a.png")
        self.assertEqual((width, height), (PIXELS, PIXELS))
        open_columns = columns([json.loads(line) for line in (self.scratch / "a.ndjson").read_text().splitlines()])
        self.assertTrue(0 < len(open_columns) < RESOLUTION ** 2)
        scale, middle = PIXELS / MARGIN / RESOLUTION, PIXELS / 2
        seen = {(i, j) for i in range(RESOLUTION) for j in range(RESOLUTION)
                if pixel(int(middle + scale * (i + 0.5 - RESOLUTION / 2)), int(middle - scale * (j + 0.5 - RESOLUTION / 2))) == pixel(0, 0)}
        self.assertEqual(seen, open_columns)

    def test_a_plan_that_is_still_made_is_drawn_as_far_as_it_has_come(self):
        job = self.fine("submit", BUST, "--resolution", 64, "--robot", "panda-turntable", "--search", "octree").split()[0]
        while int(re.search(r": (\d+) voxels", self.drawn(job))[1]) == 0:
            pass
        self.fine("cancel", job)

    def drawn(self, job):
        """What it says of the picture; that of a job without a plan has none yet."""
        done = self.run_client("render", job, "-o", "live.png")
        return done.stdout if done.returncode == 0 else ": 0 voxels"

    def test_what_cannot_be_drawn_is_refused(self):
        self.plan("a.ndjson")
        self.refused(2, "usage", "render", "a.ndjson", "-o", "a.jpg")
        self.refused(2, "usage", "render", "a.ndjson", "-o", "a.png", "--at", "1.5")
        self.refused(2, "usage", "render", "a.ndjson", "-o", "a.png", "--from", "below")
        self.refused(2, "file_missing", "render", "none.ndjson", "-o", "a.png")
        self.refused(4, "trajectory_invalid", "render", BUST, "-o", "a.png")
        self.assertIn("'panda-turntable'", self.refused(4, "cell_invalid", "render", "a.ndjson", "-o", "a.png", "--robot", "gantry"))
        job = self.fine("submit", BUST, "--resolution", RESOLUTION, "--robot", "gantry", "--wait").split()[0]
        self.fine("fetch", job, "--artifact", "timeline", "-o", "a.timeline")
        self.refused(2, "usage", "render", "a.timeline", "-o", "a.png", "--robot", "gantry")
        self.refused(4, "not_found", "render", "01M7XRMDB8NWM1BF9DPP1KFA0R", "-o", "a.png")


class Link(DaemonTest):
    def test_who_has_it_reads_the_result_without_a_token(self):
        job = self.fine("submit", BUST, "--resolution", RESOLUTION, "--robot", "gantry", "--wait").split()[0]
        self.fine("fetch", job, "--artifact", "voxels", "-o", "a.binvox")
        link = json.loads(self.fine("link", job, "--artifact", "voxels", "--json"))
        self.assertEqual((link["job"], link["artifact"]), (job, "voxels"))
        done = self.run_client("link", job, "--artifact", "voxels")
        self.assertIn("good until 20", done.stderr)
        for url in (link["url"], done.stdout.strip()):
            with urllib.request.urlopen(url, timeout=PATIENCE_S) as reply:
                self.assertEqual(reply.read(), (self.scratch / "a.binvox").read_bytes())
        with self.assertRaises(urllib.error.HTTPError):
            urllib.request.urlopen(link["url"].replace("links/", "links/x"), timeout=PATIENCE_S)

    def test_a_socket_of_this_machine_has_no_url(self):
        done = subprocess.run([*SCULPT, "link", "x", "--server", "unix:/tmp/none"], capture_output=True, text=True, timeout=PATIENCE_S, env=environment())
        self.assertEqual(done.returncode, 2)
        self.assertIn("--server HOST:PORT", done.stderr)


if __name__ == "__main__":
    unittest.main()
