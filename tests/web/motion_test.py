"""Playing between two marks, the way of the tool around now, and how fast its joints would have to be."""

import json
import unittest
import xml.etree.ElementTree

from harness import SOURCE
from page_kit import SAMPLES, PageTest

import sculpt


class Motion(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.job = cls.plan(SAMPLES / "bust.stl", resolution=16)
        with sculpt.Client(cls.daemon.address) as client:
            cls.header, *cls.lines = [json.loads(line) for line in b"".join(client.read_artifact(cls.job)).splitlines()]
        cls.lines.pop()  # the end

    def open(self, fragment="", **options):
        page = super().open(fragment, **options)
        page.settled()
        return page

    def test_a_loop_stays_between_its_marks(self):
        page = self.open()
        page.run("document.querySelector('#speed').append(Object.assign(document.createElement('option'), {value: '1', selected: true}))")
        page.app("(app.time.go(1000), app.time.mark('a'), app.time.go(1400), app.time.mark('b'))")
        self.assertTrue(page.run("document.querySelector('#loop').checked"))
        page.app("(app.seen = [], app.time.addEventListener('moved', ({detail}) => app.seen.push(detail)), app.time.go(0))")
        page.key(" ")
        page.until("app.seen.filter((at, place, all) => place > 1 && at < all[place - 1]).length >= 2", "it begins anew twice")
        page.key(" ")
        seen = page.app("app.seen")[1:]
        self.assertTrue(all(1000 <= at <= 1400 for at in seen), seen)
        page.key("End")
        page.key("b")
        self.assertEqual(page.app("app.time.marks"), {"a": 1000, "b": page.app("app.time.keyframes")})
        page.key("Home")
        page.key("b")
        self.assertEqual(page.app("app.time.marks"), {"a": None, "b": 0}, "an end before the beginning takes that away")
        page.key("b")
        self.assertEqual(page.app("app.time.marks"), {"a": None, "b": None})
        self.assert_well_behaved(page)

    def test_the_way_goes_through_the_voxels_that_are_cut(self):
        page = self.open()
        page.key("w")
        page.app("app.time.go(1500)")
        page.settled()
        page.until("app.stage.path.lines.geometry.getAttribute('position').count > 0")
        begin = page.app("app.stage.path.from")
        self.assertTrue(0 < 1500 - begin < 300)
        places = page.app("[...app.stage.path.lines.geometry.getAttribute('position').array]")
        colours = page.app("[...app.stage.path.lines.geometry.getAttribute('color').array]")
        h, origin = self.header["voxel_m"], self.header["origin_m"]
        ways = len(places) // 6
        self.assertGreater(ways, 300)
        for way in range(ways):
            line = self.lines[begin + way]
            cuts = line["type"] == "cut"
            self.assertEqual(colours[6 * way] > colours[6 * way + 2], cuts, "orange where it cuts")
            if cuts:
                for place, voxel, corner in zip(places[6 * way + 3:6 * way + 6], line["voxels"][1], origin):
                    self.assertAlmostEqual(place, corner + h * (voxel + 0.5), delta=0.03 * h)
        self.assertTrue(page.app("app.stage.path.lines.visible"))
        page.key("w")
        self.assertFalse(page.app("app.stage.path.lines.visible"))
        self.assert_well_behaved(page)

    def test_speeds_are_those_of_the_slowest_joint_at_its_limit(self):
        page = self.open()
        limits = {joint.get("name"): float(joint.find("limit").get("velocity"))
                  for joint in xml.etree.ElementTree.parse(SOURCE / "config/robots/panda-turntable.urdf").getroot().iter("joint") if joint.find("limit") is not None}
        found = page.app("""app.stage.joints.around(100).then(({columns}) => import('/ui/plan/speeds.js').then(({speed_shares}) =>
            speed_shares(columns, app.stage.joints.names.map(name => app.stage.robot.limits(name).velocity), 100)))""")
        needed = [[abs(b - a) / limits[joint] for joint, a, b in zip(self.header["joints"], before["q"], after["q"])]
                  for before, after in zip(self.lines[:4096], self.lines[1:4096])]
        seconds = sum(map(max, needed))
        self.assertAlmostEqual(found["seconds"], seconds, delta=1e-6 * seconds)
        slowest = [sum(max(each) for each in needed if max(each) == each[joint] and each.index(max(each)) == joint) / seconds for joint in range(len(limits))]
        for seen, wanted in zip(found["slowest"], slowest):
            self.assertAlmostEqual(seen, wanted, delta=1e-6)
        self.assertLessEqual(max(max(shares) for shares in found["shares"]), 100.000001)
        page.click("#tab-plots")
        page.until("document.querySelector('#panel-plots').innerText.includes('What limits them')")


if __name__ == "__main__":
    unittest.main()
