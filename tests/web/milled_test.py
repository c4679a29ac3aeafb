"""The page of a plan with milling tools."""

import contextlib
import json
import sqlite3
import struct
import subprocess
import unittest

import shapes
from harness import SCULPT, SOURCE, environment
from mill import milled
from page_kit import SAMPLES, PageTest

import sculpt


class Milled(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cell, mesh = milled.write_cell(cls.scratch), shapes.write_stl(cls.scratch / "ball.stl", shapes.ball(24))
        cls.job = subprocess.run([*SCULPT, "submit", mesh, "--resolution", "16", "--robot", cell, "--tolerance", "0.0005", "--tools", "D20,D12", "--feed", "0.05",
                                  "--wait"],
                                 env=environment(cls.daemon.address), check=True, capture_output=True, text=True).stdout.split()[0]
        with sculpt.Client(cls.daemon.address) as client:
            cls.report = client.call("job.report", job=cls.job)
            cls.lines = [json.loads(line) for line in b"".join(client.read_artifact(cls.job)).splitlines()]
            cls.timeline = sculpt.read_timeline(b"".join(client.read_artifact(cls.job, "timeline")))

    def test_the_stock_goes_cut_by_cut(self):
        page = self.open()
        page.settled()
        _, _, cuts = self.timeline
        removed = self.report["voxels"]["removed"]
        self.assertEqual(page.app("[app.time.keyframes, app.time.cut]"), [len(cuts), removed])
        for share in (0.3, 0.55, 0, 1):
            keyframe = int(share * len(cuts))
            gone = sum(last[0] - first[0] + 1 for cut in cuts[:keyframe] if isinstance(cut, list) for first, last in cut)
            page.app(f"app.time.go({keyframe})")
            page.settled()
            self.assertEqual(page.app("[app.time.cut, app.stage.shown]"), [gone, gone])
            tools = [cut for cut in cuts[:keyframe] if isinstance(cut, int)]
            self.assertEqual(page.app("app.stage.robot.held.name"), ["D20", "D12"][tools[-1] if tools else 0])
            posture = self.lines[keyframe]["q"] if keyframe else self.lines[0]["home"]
            for shown, wanted in zip(page.app("app.stage.joints.names.map(name => app.stage.robot.urdf.joints[name].angle)"), posture, strict=True):
                self.assertAlmostEqual(shown, wanted, 6, keyframe)
        page.app("app.view.look_from('cell')")
        self.assertTrue(all(abs(float(value)) < 20 for value in page.app("app.view.place").split(",")))
        kinds = page.app(f"[...app.time.kinds.slice(0, {len(cuts)})]")
        self.assertEqual([kind & 7 == 7 for kind in kinds], [isinstance(cut, list) for cut in cuts])
        self.assert_well_behaved(page)

    def test_the_report_has_tools_and_surface(self):
        page = self.open()
        page.settled()
        page.until("document.querySelector('#panel-report').textContent.includes('Replay')")
        text = page.text("#panel-report").replace("\u202f", "")
        for tool in self.report["tools"]:
            self.assertRegex(text, rf"{tool['name']}\s+{tool['removed_m3'] * 1e6:.1f} cm.\s+{tool['cut_m']:.1f} m cut")
        for points in (self.report["surface"]["points"], self.report["surface"]["reachable"]["points"]):
            self.assertIn(f"{points} points", text)
        self.assertRegex(text, rf"limited by the feed\s")
        for joint, seconds in self.report["time"]["by"]["jerk"].items():
            self.assertEqual(f"jerk of {joint}" in text, seconds > 0, joint)
        for cure in self.report["cures"]:
            self.assertIn(cure["cure"], text)
        self.assert_well_behaved(page)

    def test_the_surface_at_the_end_is_shown_in_its_colours(self):
        page = self.open()
        page.settled()
        self.assertIn("what stands above what was ordered", page.text("#panel-layers") or page.run("document.querySelector('#panel-layers').textContent"))
        page.app("app.set_layers({machined: true})")
        page.until("app.view.machined !== null")
        with sculpt.Client(self.daemon.address) as client:
            ply = b"".join(client.read_artifact(self.job, "surface"))
        vertices = int(ply.split(b"element vertex ")[1].split()[0])
        shown = page.app("""(({position, color}) => [position.count, app.view.stock.visible, [...position.array.slice(0, 3)], [...color.array.slice(0, 3)]])
                            (app.view.machined.geometry.attributes)""")
        begin = ply.index(b"end_header\n") + len(b"end_header\n")
        x, y, z, _, *colour = struct.unpack_from("<4f3B", ply, begin)
        self.assertEqual(shown, [vertices, False, [x, y, z], colour])
        low, high = page.app("""(app.view.machined.geometry.computeBoundingBox(), (({min, max}) => [min.toArray(), max.toArray()])(app.view.machined.geometry.boundingBox))""")
        for axis, origin in enumerate((-0.025, -0.025, 0.3)):  # of the block
            self.assertGreater(low[axis], origin - 0.001)
            self.assertLess(high[axis], origin + 0.051)
        page.app("app.set_layers({machined: false})")
        page.until("app.view.machined === null && app.view.stock.visible")
        self.assert_well_behaved(page)

    def test_tools_are_chosen_in_the_form(self):
        with sculpt.Client(self.daemon.address) as client:
            client.call("queue.pause")
            self.addCleanup(lambda: sculpt.Client(self.daemon.address).call("queue.resume"))
            page = self.open()
            page.until("!document.querySelector('#new-job').hidden")
            page.click("#new-job")
            page.until("document.querySelector('#submit').open")
            page.choose_file("#submit-file", SAMPLES / "vase.stl")
            page.run("document.querySelector('#submit-robot').value = 'studio'")
            self.assertEqual(page.run("document.querySelectorAll('#submit [name=tools]').length"), 0)
            page.run("(library => { library.value = 'carving'; library.dispatchEvent(new Event('change')); })(document.querySelector('#submit-library'))")
            self.assertEqual(page.run("[...document.querySelectorAll('#submit [name=tools]:checked')].map(box => box.value)"), ["D20", "D12", "D6", "D3"])
            page.run("document.querySelectorAll('#submit [name=tools]').forEach(box => { box.checked = ['D20', 'D6'].includes(box.value); })")
            page.run("document.querySelector('#submit-tolerance').value = '0.25'")
            page.run("document.querySelector('#submit form').requestSubmit()")
            page.until("!document.querySelector('#submit').open")
            job = client.call("job.list", order="newest", limit=1)["jobs"][0]
            self.assertEqual((job["mesh"], job["robot"], job["search"]), ("vase.stl", "studio", "mill"))
            client.call("job.cancel", job=job["job"])
        with contextlib.closing(sqlite3.connect(self.scratch / "data/sculptd.db")) as store:
            [(spec,)] = store.execute("SELECT spec FROM job WHERE id = ?", [job["job"]])
        mill = json.loads(spec)["mill"]
        self.assertEqual((mill["tools"], mill["tolerance_m"]), (["D20", "D6"], 0.00025))
        self.assertEqual(mill["library"], json.loads((SOURCE / "config/tools/carving.json").read_text()))
        self.assert_well_behaved(page)

    def test_it_reads_the_timeline_in_pieces(self):
        page = self.open()
        page.settled()
        whole, pieces = (page.run(f"""import('/ui/plan/timeline.js').then(async ({{Timeline}}) => {{
            const timeline = new Timeline(), bytes = new Uint8Array(await (await fetch('/v1/artifacts/{self.job}/timeline')).arrayBuffer());
            for (let at = 0; at < bytes.length; at += {piece}) timeline.add(bytes.slice(at, at + {piece}), () => {{}});
            return [timeline.keyframes, [...timeline.order], [...timeline.removed.values.slice(0, timeline.keyframes)]]; }})""") for piece in (1 << 30, 97))
        self.assertEqual(pieces, whole)


if __name__ == "__main__":
    unittest.main()
