"""Small meshes as STL files: good ones that plan quickly, and each kind of bad one."""

import math
import struct


def box(low, high):
    """The twelve triangles of an axis-aligned box, outward."""
    (a, b, c), (d, e, f) = low, high
    v = [(x, y, z) for z in (c, f) for y in (b, e) for x in (a, d)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [t for p, q, r, s in quads for t in ((v[p], v[q], v[r]), (v[p], v[r], v[s]))]


def steps():
    """Two boxes, one on the other: a solid with a side that is not flat."""
    return box((0, 0, 0), (4, 4, 2)) + box((1, 1, 2), (3, 3, 4))


def open_bowl():
    """A box without three of its sides: no parity can make a solid of it."""
    return box((0, 0, 0), (4, 4, 4))[:6]


def with_vertex(value):
    """A box with one coordinate replaced by `value`, e.g. NaN."""
    triangles = [list(t) for t in box((0, 0, 0), (4, 4, 4))]
    triangles[0][0] = (value, 0.0, 0.0)
    return triangles


def ball(rings=12):
    """A sphere of radius 1, triangles by latitude and longitude."""
    def point(i, j):
        polar, turn = math.pi * i / rings, math.pi * j / rings
        return (math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn), math.cos(polar))
    triangles = []
    for i in range(rings):
        for j in range(2 * rings):
            a, b, c, d = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
            triangles += ([(a, b, c)] if i < rings - 1 else []) + ([(a, c, d)] if i > 0 else [])
    return triangles


def write_stl(path, triangles):
    """Binary STL; normals are left to the reader."""
    with open(path, "wb") as out:
        out.write(b"sculpt test".ljust(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *[c for vertex in triangle for c in vertex], 0))
    return path
