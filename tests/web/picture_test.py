"""What the page shows of the stock is exactly what stands: every pixel against a ray through the plan, from six sides at five moments."""

import base64
import json
import unittest

import rays
from page_kit import SAMPLES, PageTest

import sculpt

FLIPPED = {(0, False), (1, True), (2, False)}  # seen from there, the first of the other axes runs to the left
SCALE = 2


class Picture(PageTest):
    def check(self, mesh, robot, resolution):
        job = self.plan(mesh, robot, resolution)
        with sculpt.Client(self.daemon.address) as client:
            lines = [json.loads(line) for line in b"".join(client.read_artifact(job)).splitlines()]
            n, keep = rays.read_binvox(b"".join(client.read_artifact(job, "voxels")))
        order, after = rays.orders_of(lines, n)
        page = self.open(f"#job={job}")
        page.settled()
        classes = set()
        for share in (0, 0.02, 0.4, 0.8, 1):
            keyframe = int(share * len(after))
            removed = after[keyframe - 1] if keyframe else 0
            # Two steps, and a picture between them in which some sides are hidden: all that changed must be in the next ones.
            for place in (keyframe / 2, keyframe):
                page.app("app.view.draw_now()")
                page.app(f"(app.view.pictures.paused = true, app.time.go({place}))")
                page.settled()
            for axis in range(3):
                for from_above in (False, True):
                    with self.subTest(mesh=mesh.name, keyframe=keyframe, axis=axis, from_above=from_above):
                        seen = rays.see(order, keep, n, axis, from_above, removed)
                        classes |= {kind for kind, _ in seen.values()}
                        self.assertEqual(self.wrong_pixels(page, n, (axis, from_above), seen), [])
        return classes

    def wrong_pixels(self, page, n, side, seen):
        picture = page.app(f"""(({{size, pixels}}) => {{
            let text = '';
            for (let at = 0; at < pixels.length; at += 8192) text += String.fromCharCode(...pixels.subarray(at, at + 8192));
            return [size, btoa(text)]; }})((await import('/ui/view/class_picture.js')).class_picture(app.view, {side[0]}, {json.dumps(side[1])}, {SCALE}))""")
        size, pixels = picture[0], base64.b64decode(picture[1])
        self.assertEqual((size, len(pixels)), (n * SCALE, 4 * (n * SCALE) ** 2))
        wrong = []
        for y in range(size):
            for x in range(size):
                u, v = (size - 1 - x if side in FLIPPED else x) // SCALE, y // SCALE
                at = 4 * (y * size + x)
                shown = (pixels[at], pixels[at + 1]) if pixels[at] else None
                if shown != seen.get((u, v)):
                    wrong.append(((x, y), shown, seen.get((u, v))))
        return wrong[:5]

    def test_a_bust(self):
        self.assertEqual(self.check(SAMPLES / "bust.stl", "panda-turntable", 64), {1, 2})

    def test_a_vase_with_what_was_left(self):
        self.assertEqual(self.check(SAMPLES / "vase.stl", "panda-turntable", 16), {1, 2, 3})


if __name__ == "__main__":
    unittest.main()
