"""The stock in one's own room, with a headset and a room that are emulated (vendor/): placed, scrubbed, left."""

import pathlib
import unittest

from page_kit import SAMPLES, PageTest

VENDOR = pathlib.Path(__file__).parent / "vendor"
# Chromium has a navigator.xr of its own on loopback, which must go.
WEAR = """
globalThis.headset = new IWER.XRDevice(IWER.metaQuest3);
headset.installRuntime({forceInstall: true});
headset.stereoEnabled = false;
headset.installSEM(IWER_SEM.SyntheticEnvironmentModule);
headset.sem.loadEnvironment(ROOM);
headset.position.set(0, 1.6, 0);
"""
DOWN = "headset.quaternion.set(-0.38, 0, 0, 0.925)"  # 45 degrees


class InTheRoom(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.job = cls.plan(SAMPLES / "bust.stl")

    def wear(self, room=True):
        page = self.browser.open("about:blank")
        self.addCleanup(page.close)
        scripts = [(VENDOR / name).read_text() for name in ("iwer.min.js", "iwer-sem.min.js")]
        wear = WEAR.replace("ROOM", (VENDOR / "room.json").read_text()) if room else "\n".join(line for line in WEAR.splitlines() if "sem" not in line.lower())
        page.call("Page.addScriptToEvaluateOnNewDocument", source="\n".join([*scripts, wear]))
        page.go(f"http://{self.daemon.address}/#job={self.job}")
        page.settled()
        page.click("#tab-export")
        page.until("document.querySelector('#room-scale')")
        return page

    def enter(self, page, button):
        page.run(f"[...document.querySelectorAll('#panel-export button')].find(one => one.innerText === '{button}').click()")
        page.until("app.take_along.room.session && document.body.classList.contains('in-room')", page.text("#export-note"))

    def tap(self, page):
        """Held until a frame has seen it, however seldom frames come."""
        page.app("(globalThis.pressed = false, app.take_along.room.session.addEventListener('selectstart', () => { globalThis.pressed = true; }, {once: true}))")
        page.run("headset.controllers.right.updateButtonValue('trigger', 1)")
        page.until("globalThis.pressed", "a frame sees the trigger")
        page.run("headset.controllers.right.updateButtonValue('trigger', 0)")
        page.until("app.take_along.room.placed")

    def foot(self, page):
        """The middle of the grid's lowest side, in the room (m, y up), and an edge of a cell."""
        return page.app("""((frame, vector, edge) => {
            app.view.scene.updateMatrixWorld(true);
            const place = (x, y, z) => vector.clone().set(x, y, z).applyMatrix4(frame.matrixWorld);
            return [place(edge / 2, edge / 2, 0).toArray(), place(0, 0, 1).sub(place(0, 0, 0)).toArray()];
        })(app.view.grid_frame, app.view.camera.position, app.view.edge)""")

    def test_session_hit_place_scrub_end(self):
        page = self.wear()
        page.run(DOWN)
        before = page.app("app.view.place")
        self.enter(page, "Stock")
        page.until("app.take_along.room.reticle.visible", "the line of sight meets the room")
        self.assertIn("tap", page.text("#room-note"))
        reticle = page.app("app.take_along.room.reticle.matrix.elements.slice(12, 15)")
        self.tap(page)
        foot, up = self.foot(page)
        for value, wanted in zip(foot, reticle):
            self.assertAlmostEqual(value, wanted, delta=0.02)
        voxel_m = page.app("app.stage.head.header.voxel_m")
        for value, wanted in zip(up, (0, voxel_m, 0)):
            self.assertAlmostEqual(value, wanted, delta=1e-6)
        self.assertFalse(page.app("app.take_along.room.reticle.visible"))
        for share in (0.3, 0.8):
            page.app(f"app.time.go({share} * app.time.keyframes)")
            page.until("app.stage.shown === app.time.cut")
        page.run("headset.controllers.right.updateAxes('thumbstick', 1, 0)")
        page.until("app.time.at > 0.81 * app.time.keyframes", "the stick moves the time")
        page.run("headset.controllers.right.updateAxes('thumbstick', 0, 0)")
        page.click("#turn-left")
        self.assertAlmostEqual(self.foot(page)[0][1], foot[1], delta=1e-6)
        page.click("#leave-room")
        page.until("!app.take_along.room.session && !document.body.classList.contains('in-room')")
        self.assertEqual(page.app("[app.view.place, app.view.renderer.xr.isPresenting, app.view.robot.root.parent === app.view.scene]"), [before, False, True])
        page.settled()
        self.assertEqual(page.faults, [])

    def test_a_cell_of_a_fifth_goes_ahead_where_nothing_tells_what_is_there(self):
        page = self.wear(room=False)
        page.run("(select => { select.value = '0.2'; })(document.querySelector('#room-scale'))")
        self.enter(page, "Whole cell")
        self.assertIsNone(page.app("app.take_along.room.hits ?? null"))
        self.tap(page)
        base = page.app("(app.view.scene.updateMatrixWorld(true), app.view.robot.root.getWorldPosition(app.view.camera.position.clone()).toArray())")
        for value, wanted in zip(base, (0, 0, -1.5)):
            self.assertAlmostEqual(value, wanted, delta=0.1)
        self.assertAlmostEqual(self.foot(page)[1][1], 0.2 * page.app("app.stage.head.header.voxel_m"), delta=1e-6)
        self.assertTrue(page.app("app.view.robot.tool.visible"))
        page.click("#place-again")
        page.until("!app.take_along.room.placed")
        page.app("app.take_along.room.leave()")
        page.until("!document.body.classList.contains('in-room')")

    def test_a_browser_without_a_room_has_a_sentence(self):
        page = self.open(f"#job={self.job}")
        page.settled()
        page.click("#tab-export")
        page.until("document.querySelector('#panel-export').innerText.includes('no WebXR')")


if __name__ == "__main__":
    unittest.main()
