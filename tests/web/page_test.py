"""The page as a person uses it, in a real browser, against the real daemon. Skipped where there is no Chromium."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import rays
import shapes
from browser import find_chromium
from harness import PATIENCE_S, environment
from page_kit import SAMPLES, PageTest

import sculpt


class Finished(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.job = cls.plan(SAMPLES / "bust.stl")
        with sculpt.Client(cls.daemon.address) as client:
            cls.report = client.call("job.report", job=cls.job)

    def test_the_end_is_shown_and_every_place_can_be_gone_to_at_once(self):
        page = self.open()
        page.settled()
        self.assertIn("bust.stl", page.text("#jobs"))
        keyframes, removed = self.report["path"]["keyframes"], self.report["voxels"]["removed"]
        self.assertEqual(page.app("[app.time.keyframes, app.time.at, app.time.cut]"), [keyframes, keyframes, removed])
        self.assertGreater(page.app("app.view.shell.faces"), 1000)
        for share in (0.5, 0, 0.93, 1):
            page.app(f"app.time.go({share} * app.time.keyframes)")
            page.settled()
            self.assertEqual(page.app("app.stage.shown"), page.app("app.time.cut"))
        self.assertLess(page.bytes, 600_000)
        for name in ("timeline", "residue", "cell/"):
            self.assertEqual(sum(name in url and "/v1/" in url and url.partition("?")[0].endswith(name) for url in page.requests), 1, name)
        self.assert_well_behaved(page)

    def test_its_modules_come_in_three_files(self):
        page = self.open()
        page.settled()
        modules = [url.partition("/ui/")[2] for url in page.requests if url.endswith(".js")]
        self.assertEqual(sorted(modules), ["app.js", "stock/worker.js", "vendor/libraries.js"])

    def test_more_voxels_than_are_drawn_go_as_blocks_with_their_last_voxel(self):
        with sculpt.Client(self.daemon.address) as client:
            lines = [json.loads(line) for line in b"".join(client.read_artifact(self.job)).splitlines()]
        n, m = 32, 16
        order, _ = rays.orders_of(lines, n)
        blocks, left = [0] * m ** 3, [0] * m ** 3
        for at, ordinal in enumerate(order):
            i, j, k = at % n, at // n % n, at // (n * n)
            block = i // 2 + m * (j // 2 + m * (k // 2))
            blocks[block] = max(blocks[block], ordinal)
            left[block] += ordinal == rays.NEVER
        blocks = [0xffffff00 + left[block] if left[block] else ordinal for block, ordinal in enumerate(blocks)]
        page = self.open()
        page.settled()
        self.assertEqual(page.run(f"""import('/ui/plan/timeline.js').then(async ({{Timeline}}) => {{
            const timeline = new Timeline({m}), bytes = new Uint8Array(await (await fetch('/v1/artifacts/{self.job}/timeline')).arrayBuffer());
            for (let at = 0; at < bytes.length; at += 997) timeline.add(bytes.slice(at, at + 997), () => {{}});
            return [...timeline.order]; }})"""), blocks)

    def test_the_robot_stands_where_the_trajectory_says(self):
        page = self.open()
        page.settled()
        with sculpt.Client(self.daemon.address) as client:
            lines = [json.loads(line) for line in b"".join(client.read_artifact(self.job)).splitlines()]
        for keyframe in (1, 700, len(lines) - 2):
            page.app(f"app.time.go({keyframe})")
            page.settled()
            shown = page.app("app.stage.joints.names.map(name => app.stage.robot.urdf.joints[name].angle)")
            for joint, value, wanted in zip(lines[0]["joints"], shown, lines[keyframe]["q"]):
                self.assertAlmostEqual(value, wanted, 7, (keyframe, joint))
        # The ball's centre is where the last voxel of the cut is, in the frame of the grid: two ways through the kinematics.
        keyframe = next(at for at, line in enumerate(lines) if line["type"] == "cut" and at > 500)
        page.app(f"app.time.go({keyframe})")
        page.settled()
        ball = page.app("""(app.view.scene.updateMatrixWorld(true), app.stage.robot.tool.children[0].getWorldPosition(app.view.camera.position.clone())
                           .applyMatrix4(app.view.grid_frame.matrixWorld.clone().invert()).toArray())""")
        for place, voxel in zip(ball, lines[keyframe]["voxels"][1]):
            self.assertAlmostEqual(place, voxel + 0.5, delta=0.03)

    def test_keys_and_the_address_lead_to_the_same_place(self):
        page = self.open()
        page.settled()
        page.key("Home")
        page.until("app.time.at === 0")
        page.key("ArrowRight")
        first = page.app("app.time.at")
        self.assertGreater(first, 0)
        page.key("ArrowRight", shift=True)
        page.key("c")
        page.settled()
        page.app("app.view.look_from('top')")
        at, place, look = page.app("[app.time.at, app.view.place, app.layers.look]")
        self.assertEqual(look, "time")
        self.assertAlmostEqual(at, first + 0.01 * self.report["path"]["keyframes"])
        page.until("new URLSearchParams(location.hash.slice(1)).get('view') === app.view.place")
        other = self.open(page.run("location.hash"))
        other.settled()
        shown = other.app("[app.time.at, app.view.place, app.layers.look]")
        self.assertAlmostEqual(shown[0], at, delta=0.01)
        self.assertEqual(shown[1:], [place, look])

    def test_a_click_on_the_stock_says_when_the_voxel_goes(self):
        page = self.open()
        page.settled()
        page.app("(app.time.go(0), app.view.look_from('top'))")
        page.settled()
        box = page.run("(({left, top, width, height}) => [left + width / 2, top + height / 2, height / 5])(document.querySelector('#canvas').getBoundingClientRect())")
        page.app("app.set_layers({robot: 'none'})")
        for kind in ("mousePressed", "mouseReleased"):
            page.call("Input.dispatchMouseEvent", type=kind, x=box[0] + box[2], y=box[1] + box[2], button="left", clickCount=1)
        page.until("!document.querySelector('#picked').hidden")
        self.assertRegex(page.text("#picked"), r"Voxel (2\d, \d|2\d, \d\d|\d, 2\d), 31\s+It goes as number \d+, in keyframe")
        page.click("#picked button")
        page.settled()
        self.assertGreater(page.app("app.time.at"), 0)

    def test_the_report_says_what_the_server_says(self):
        page = self.open()
        page.settled()
        page.until("document.querySelector('#panel-report').textContent.includes('Replay')")
        text = page.text("#panel-report").replace("\u202f", "")
        for figure in (self.report["voxels"]["removed"], self.report["path"]["rows"], self.report["path"]["keyframes"]):
            self.assertIn(str(figure), text)
        self.assertIn("clean", text)
        page.click("#tab-plots")
        page.until("document.querySelectorAll('#panel-plots .uplot').length === 3")
        self.assert_well_behaved(page)

    def test_lost_graphics_have_a_sentence_and_come_back(self):
        page = self.open()
        page.settled()
        page.app("(app.lose = app.view.renderer.getContext().getExtension('WEBGL_lose_context')).loseContext()")
        page.until("document.querySelector('#banner').innerText.includes('lost its graphics')")
        page.app("app.lose.restoreContext()")
        page.until("document.querySelector('#banner').hidden")
        page.app("app.time.go(0)")
        page.settled()
        self.assertGreater(page.app("(await import('/ui/view/class_picture.js')).class_picture(app.view, 2, true, 1).pixels.filter(value => value === 255).length"), 1000)


class Residue(PageTest):
    def test_a_reason_is_pointed_out_and_flown_to(self):
        hollow = shapes.box((0, 0, 0), (8, 8, 8)) + [facet[::-1] for facet in shapes.box((2, 2, 2), (6, 6, 6))]
        self.plan(shapes.write_stl(self.scratch / "hollow.stl", hollow), "gantry", 16)
        page = self.open()
        page.settled()
        page.until("document.querySelectorAll('#panel-residue .reason').length > 0")
        before = page.app("app.view.place")
        page.click("#tab-residue")
        page.click("#panel-residue .reason")
        page.settled()
        self.assertIn("enclosed", page.text("#panel-residue"))
        self.assertNotEqual(page.app("app.view.place"), before)
        self.assertGreater(page.app("app.stage.chosen.length"), 0)
        self.assert_well_behaved(page)


class Live(PageTest):
    def test_a_plan_is_followed_while_it_is_made(self):
        job = self.plan(SAMPLES / "bust.stl", resolution=32, search="octree", wait=False)
        page = self.open()
        page.until("app.time.keyframes > 0 && app.time.live", "the first keyframes of a plan that is made")
        seen = page.app("app.time.keyframes")
        page.until(f"app.time.keyframes > {seen}")
        page.until("app.view.shell.faces > 0", "faces of what stands")
        page.until("app.stage.final")
        page.settled()
        with sculpt.Client(self.daemon.address) as client:
            report = client.call("job.report", job=job)
        self.assertEqual(page.app("[app.time.keyframes, app.time.cut]"), [report["path"]["keyframes"], report["voxels"]["removed"]])
        self.assert_well_behaved(page)


    def test_the_robot_moves_with_the_plan_that_is_made(self):
        job = self.plan(SAMPLES / "bust.stl", resolution=64, search="octree", wait=False)
        page = self.open(f"#job={job}")
        page.until("app.time.live && app.stage.robot && Math.abs(app.stage.robot.urdf.joints.joint1.angle) > 0.001")
        with sculpt.Client(self.daemon.address) as client:
            client.call("job.cancel", job=job)
        page.until("document.querySelector('#stage-note').innerText.includes('cancelled')")
        self.assert_well_behaved(page)


class Queue(PageTest):
    settings = {"workers": 1}

    def states(self, page):
        return page.run("[...document.querySelectorAll('#jobs .state')].map(element => element.innerText)")

    def test_a_mesh_becomes_a_job_and_buttons_do_what_they_say(self):
        page = self.open()
        page.until("!document.querySelector('#new-job').hidden")
        page.click("#new-job")
        page.until("document.querySelector('#submit').open")
        page.choose_file("#submit-file", SAMPLES / "vase.stl")
        page.run("document.querySelector('#submit-resolution').value = '16'")
        page.run("document.querySelector('#submit-robot').value = 'gantry'")
        page.run("document.querySelector('#submit form').requestSubmit()")
        page.until("app.stage.final", "the new job is finished and shown")
        self.assertEqual(self.states(page), ["succeeded"])
        self.assertIn("vase.stl", page.text("#job-head"))

        running = self.plan(SAMPLES / "bust.stl", resolution=64, search="octree", wait=False)
        waiting = self.plan(SAMPLES / "dish.stl", wait=False)
        page.until("document.querySelectorAll('#jobs li').length === 3")
        page.until(f"app.queue.jobs.get('{running}')?.state === 'running' && app.queue.jobs.get('{waiting}')?.state === 'queued'")
        self.assertEqual(page.run("[...document.querySelectorAll('#jobs .name')].map(e => e.innerText)"), ["dish.stl", "bust.stl", "vase.stl"])

        def press(job, button, state):
            page.click(f"#jobs [data-job='{job}']")
            page.until(f"app.chosen === '{job}' && [...document.querySelectorAll('#job-head button')].some(b => b.innerText === '{button}')")
            page.run(f"[...document.querySelectorAll('#job-head button')].find(b => b.innerText === '{button}').click()")
            page.until(f"app.queue.jobs.get('{job}').state === '{state}'", f"{button} makes it {state}")
        press(waiting, "Pause", "paused")
        press(waiting, "Resume", "queued")
        press(waiting, "Cancel", "cancelled")
        press(running, "Cancel", "cancelled")
        page.until("document.querySelector('#stage-note').innerText.includes('cancelled')")
        self.assert_well_behaved(page)

    def test_a_mesh_that_is_none_is_refused_in_the_servers_words(self):
        (self.scratch / "bad.stl").write_text("solid nothing\nendsolid\n")
        page = self.open()
        page.until("!document.querySelector('#new-job').hidden")
        page.click("#new-job")
        page.until("document.querySelector('#submit').open")
        page.choose_file("#submit-file", self.scratch / "bad.stl")
        page.run("document.querySelector('#submit form').requestSubmit()")
        page.until("document.querySelector('#submit .error').innerText !== ''")
        self.assertIn("the file is no readable .stl mesh", page.text("#submit .error"))

    def test_a_lost_connection_has_a_sentence_and_is_made_again(self):
        page = self.open()
        page.until("document.querySelector('#server').className === 'open'")
        address = self.daemon.address
        self.daemon.stop()
        page.until("document.querySelector('#banner').innerText.includes('lost')")
        type(self).start_daemon(address)
        page.until("document.querySelector('#server').className === 'open' && document.querySelector('#banner').hidden")


class Tokens(PageTest):
    @classmethod
    def setUpClass(cls):
        find_chromium()
        folder = tempfile.TemporaryDirectory(prefix="sculpt-test-")
        cls.addClassCleanup(folder.cleanup)
        tokens = pathlib.Path(folder.name) / "tokens.json"
        cls.settings = {"tokens": str(tokens)}
        cls.secret = {}
        for name, scope in (("looker", "read"), ("giver", "submit")):
            made = subprocess.run([os.environ["SCULPTD"], "--tokens", str(tokens), "token", "add", name, "--scope", scope], env=environment(),
                                  capture_output=True, text=True, timeout=PATIENCE_S, check=True)
            cls.secret[name] = made.stdout.strip()
        super().setUpClass()

    def test_the_shell_is_open_and_the_data_is_not(self):
        page = self.open()
        page.until("document.querySelector('#token').open")
        self.assertIn("must know who you are", page.text("#token"))
        self.assertEqual(page.run("fetch('/schema.json').then(reply => reply.status)"), 401)

    def test_a_token_of_the_address_is_taken_once_and_shows_what_it_may(self):
        for name, hidden in (("looker", True), ("giver", False)):
            page = self.open(f"#token={self.secret[name]}")
            page.until("document.querySelector('#server').className === 'open'")
            self.assertNotIn("token", page.run("location.href"))
            self.assertEqual(page.run("document.querySelector('#new-job').hidden"), hidden, name)
            self.assertTrue(page.run("document.querySelector('#pause-queue').hidden"), name)
            self.assertIn(name, page.text("#server"))
            self.assertNotIn(self.secret[name], " ".join(page.requests))


if __name__ == "__main__":
    unittest.main()
