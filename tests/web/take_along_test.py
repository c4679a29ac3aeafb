"""What the page gives to be taken along: bodies that are what stands, pictures and films. Read here by readers of our own."""

import collections
import json
import struct
import time
import unittest
import zlib

import rays
from harness import PATIENCE_S
from page_kit import SAMPLES, PageTest

import sculpt

SIDES = [(axis, way) for axis in range(3) for way in (-1, 1)]
KINDS = "cut", "raw", "residue"


def read_glb(data):
    """(document, binary) of a glTF 2.0 binary that keeps to the rules that are checked here."""
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    json_bytes, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON" and json_bytes % 4 == 0
    document, at = json.loads(data[20:20 + json_bytes]), 20 + json_bytes
    binary_bytes, kind = struct.unpack_from("<I4s", data, at)
    assert kind == b"BIN\0" and binary_bytes % 4 == 0 and at + 8 + binary_bytes == len(data) == length
    assert document["buffers"] == [{"byteLength": binary_bytes}]
    for view in document["bufferViews"]:
        assert view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= binary_bytes
    return document, data[at + 8:]


def values(document, binary, accessor):
    """Its numbers, a tuple each."""
    accessor = document["accessors"][accessor]
    view = document["bufferViews"][accessor["bufferView"]]
    form = {5120: "b", 5123: "H", 5125: "I"}[accessor["componentType"]] * {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
    stride = view.get("byteStride", struct.calcsize(f"<{form}"))
    start = view["byteOffset"] + accessor.get("byteOffset", 0)
    assert start + stride * (accessor["count"] - 1) + struct.calcsize(f"<{form}") <= view["byteOffset"] + view["byteLength"]
    return [struct.unpack_from(f"<{form}", binary, start + at * stride) for at in range(accessor["count"])]


def cells_of(corners, side):
    """The faces (cell, side) that a rectangle of whole cells covers."""
    axis, way = SIDES[side]
    low, high = [min(c) for c in zip(*corners)], [max(c) for c in zip(*corners)]
    assert low[axis] == high[axis]
    low[axis] -= way > 0
    high[axis] = low[axis] + 1
    return [((i, j, k), side) for i in range(low[0], high[0]) for j in range(low[1], high[1]) for k in range(low[2], high[2])]


def turns_to(corners, side):
    """Is the rectangle counter-clockwise seen from outside?"""
    (a, b, c), (axis, way) = corners[:3], SIDES[side]
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(b, c)]
    return (u[(axis + 1) % 3] * v[(axis + 2) % 3] - u[(axis + 2) % 3] * v[(axis + 1) % 3]) * way > 0


class TakeAlong(PageTest):
    N = 32

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.job = cls.plan(SAMPLES / "vase.stl", resolution=cls.N)
        with sculpt.Client(cls.daemon.address) as client:
            lines = [json.loads(line) for line in b"".join(client.read_artifact(cls.job)).splitlines()]
            cls.keep = rays.read_binvox(b"".join(client.read_artifact(cls.job, "voxels")))[1]
        cls.header = lines[0]
        cls.order, cls.after = rays.orders_of(lines, cls.N)

    def open_at(self, share):
        page = self.open(f"#job={self.job}&at={share}")
        page.settled()
        page.call("Page.setDownloadBehavior", behavior="allow", downloadPath=str(self.scratch))
        page.click("#tab-export")
        return page

    def saved(self, page, action, name):
        """The bytes of the file that an action of the page gives."""
        path = self.scratch / name
        path.unlink(missing_ok=True)
        action()
        end = time.monotonic() + PATIENCE_S
        while not path.exists() or not path.stat().st_size or list(self.scratch.glob("*.crdownload")):
            assert time.monotonic() < end, f"no {name}: {page.text('#export-note')}"
            time.sleep(0.02)
        return path.read_bytes()

    def body(self, page, what, form):
        return self.saved(page, lambda: page.click(f"[data-export='{what}-{form}']"), f"vase-{what}.{form}")

    def faces(self, stands, removed=None):
        """{kind: {(cell, side)}} of all open faces, found voxel by voxel."""
        n, found = self.N, {kind: set() for kind in KINDS}
        for at in filter(stands, range(n ** 3)):
            cell = at % n, at // n % n, at // (n * n)
            for side, (axis, way) in enumerate(SIDES):
                there = cell[axis] + way
                beyond = at + way * n ** axis if 0 <= there < n else None
                if beyond is not None and stands(beyond):
                    continue
                left = removed is not None and self.order[at] == rays.NEVER and not self.keep[at]
                kind = "residue" if left else "raw" if beyond is None and removed is not None else "cut"
                found[kind].add((cell, side))
        return {kind: faces for kind, faces in found.items() if faces}

    def assert_covers(self, rectangles, wanted):
        """rectangles: (kind, corners, side); each open face is in just one of them, and nothing else is."""
        seen = collections.Counter()
        for kind, corners, side in rectangles:
            self.assertTrue(turns_to(corners, side))
            seen.update((kind, *face) for face in cells_of(corners, side))
        self.assertEqual(seen, collections.Counter((kind, *face) for kind, faces in wanted.items() for face in faces))

    def rectangles_of_glb(self, data):
        document, binary = read_glb(data)
        for part in document["meshes"][0]["primitives"]:
            corners, normals = (values(document, binary, part["attributes"][name]) for name in ("POSITION", "NORMAL"))
            indices = [index for index, in values(document, binary, part["indices"])]
            kind = document["materials"][part["material"]]["name"]
            for at in range(0, len(corners), 4):
                self.assertEqual(indices[at // 4 * 6:at // 4 * 6 + 6], [at, at + 1, at + 2, at, at + 2, at + 3])
                axis = next(axis for axis in range(3) if normals[at][axis])
                self.assertEqual(len(set(normals[at:at + 4])), 1)
                yield kind, corners[at:at + 4], 2 * axis + (normals[at][axis] > 0)
            bounds = document["accessors"][part["attributes"]["POSITION"]]
            self.assertEqual((bounds["min"], bounds["max"]), ([min(c) for c in zip(*corners)], [max(c) for c in zip(*corners)]))

    def test_a_glb_has_each_open_face_once_and_stands_in_metres(self):
        for share in (0.4, 1):
            page = self.open_at(share)
            keyframe = round(share * len(self.after))
            removed = page.app("app.time.cut")
            self.assertAlmostEqual(removed, self.after[keyframe - 1], delta=self.N)
            data = self.body(page, "stock", "glb")
            self.assert_covers(self.rectangles_of_glb(data), self.faces(lambda at: self.order[at] > removed, removed))
        self.assertIn("saved, in metres", page.text("#export-note"))
        node = read_glb(data)[0]["nodes"][0]
        for value in node["scale"]:
            self.assertAlmostEqual(value, self.header["voxel_m"])
        data = self.body(page, "sculpture", "glb")
        self.assert_covers(self.rectangles_of_glb(data), self.faces(lambda at: self.keep[at]))
        self.assert_well_behaved(page)

    def test_a_usdz_is_an_archive_as_phones_want_it_of_the_same_faces(self):
        page = self.open_at(0.4)
        removed = page.app("app.time.cut")
        data = self.body(page, "stock", "usdz")
        signature, _, _, method, _, _, crc, packed, size, name_bytes, extra_bytes = struct.unpack_from("<IHHHHHIIIHH", data)
        start = 30 + name_bytes + extra_bytes
        self.assertEqual((signature, method, packed, start % 64), (0x04034b50, 0, size, 0))
        text = data[start:start + size]
        self.assertEqual(crc, zlib.crc32(text))
        self.assertTrue(text.startswith(b"#usda 1.0\n"))
        self.assertIn(b"metersPerUnit = 1\n    upAxis = \"Y\"", text)
        self.assert_covers(self.rectangles_of_usd(text.decode()), self.faces(lambda at: self.order[at] > removed, removed))

    def rectangles_of_usd(self, text):
        h, n = self.header["voxel_m"], self.N
        for part in text.split('def Mesh "')[1:]:
            kind = part.partition('"')[0]

            def listed(name, part=part):
                inside = next(line for line in part.splitlines() if f" {name} = [" in line).partition("[] " + name + " = [")[2].rpartition("]")[0]
                return json.loads("[" + inside.replace("(", "[").replace(")", "]") + "]")
            points, indices, normals = listed("points"), listed("faceVertexIndices"), listed("normals")
            self.assertEqual(listed("faceVertexCounts"), [4] * len(normals))
            self.assertEqual(len(set(map(tuple, points))), len(points), "shared corners are written once")
            for face, (x, y, z) in enumerate(normals):
                normal = x, -z, y  # in the stock's frame
                axis = next(axis for axis in range(3) if normal[axis])
                corners = [(round(p[0] / h + n / 2), round(n / 2 - p[2] / h), round(p[1] / h)) for p in (points[at] for at in indices[4 * face:4 * face + 4])]
                yield kind, corners, 2 * axis + (normal[axis] > 0)

    def test_a_film_and_a_picture_of_what_is_seen(self):
        page = self.open_at(0)
        page.run("document.querySelector('#speed').append(Object.assign(document.createElement('option'), {value: '8', selected: true}))")
        page.app("(app.time.go(0.5 * app.time.keyframes), app.time.mark('a'), app.time.go(0.9 * app.time.keyframes), app.time.mark('b'))")
        shown = page.app("(app.shown = [], app.time.addEventListener('moved', ({detail}) => app.shown.push(detail / app.time.keyframes)), 0)")
        film = self.saved(page, lambda: page.click("#film"), "vase.webm")
        self.assertEqual(film[:4], b"\x1a\x45\xdf\xa3")
        self.assertGreater(len(film), 5000)
        shown = page.app("app.shown")
        self.assertAlmostEqual(shown[0], 0.5)
        self.assertAlmostEqual(shown[-1], 0.9)
        self.assertEqual(shown, sorted(shown))
        self.assertEqual(page.text("#film"), "Film it")
        picture = self.saved(page, lambda: page.key("p"), "vase.png")
        self.assertTrue(picture.startswith(b"\x89PNG"))
        self.assert_well_behaved(page)

    def test_where_nothing_is_shown_it_says_so(self):
        page = self.open("#job=01M7XRMDB8NWM1BF9DPP1KFA0R")
        page.until("document.querySelector('#stage-note').innerText.includes('01M7')")
        page.click("#tab-export")
        page.click("[data-export='stock-glb']")
        page.until("document.querySelector('#export-note').innerText.includes('no plan to export')")


if __name__ == "__main__":
    unittest.main()
