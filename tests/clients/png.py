"""PNG files of eight bits a colour without interlacing, as sculpt writes them."""

import struct
import zlib


def unpacked(path):
    """Width, height and the rows, each with its filter byte."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert (depth, kind) == (8, 2), (depth, kind)
    packed, at = b"", 8
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += 12 + length
    return width, height, zlib.decompress(packed)


def predicted(kind, left, above, corner):
    """What the filter of a row expects of a byte."""
    if kind < 4:
        return (0, left, above, (left + above) // 2)[kind]
    return min((left, above, corner), key=lambda value: abs(left + above - corner - value))


def read(path):
    """Width, height, and a function from (x, y) to (red, green, blue)."""
    width, height, rows = unpacked(path)
    stride, above, colours = 3 * width, bytearray(3 * width), []
    for y in range(height):
        kind, row = rows[y * (stride + 1)], bytearray(rows[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for at in range(stride):
            left, corner = (row[at - 3], above[at - 3]) if at >= 3 else (0, 0)
            row[at] = (row[at] + predicted(kind, left, above[at], corner)) & 255
        colours.append(row)
        above = row
    return width, height, lambda x, y: tuple(colours[y][3 * x:3 * x + 3])
