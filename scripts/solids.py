"""Triangles of simple solids, and STL files: shared by make-samples and make-scenarios. Standard library only.

A solid is a list of vertices and a list of triangles of three vertex numbers each, counterclockwise from outside.
"""

import math
import struct


def revolution(profile, segments):
    """Profile of (radius, z) from axis to axis, outside first; radius 0 only at its ends."""
    vertices, rings, triangles = [], [], []
    for radius, z in profile:
        count = 1 if radius == 0 else segments
        rings.append([len(vertices) + (s % count) for s in range(segments + 1)])
        vertices += [(radius * math.cos(2 * math.pi * s / segments), radius * math.sin(2 * math.pi * s / segments), z) for s in range(count)]
    for lower, upper in zip(rings, rings[1:]):
        for s in range(segments):
            a, b, c, d = lower[s], lower[s + 1], upper[s + 1], upper[s]
            if a != b:
                triangles.append((a, b, c))
            if c != d:
                triangles.append((a, c, d))
    return vertices, triangles


def write_stl(path, title, vertices, triangles):
    with open(path, "wb") as file:
        file.write(title.encode().ljust(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *[c for v in triangle for c in vertices[v]], 0))
    print(f"{path}: {len(triangles)} triangles")
