"""What is seen of a plan along an axis, found from its .ndjson and .binvox alone: the reference for the pictures of the page."""

NEVER = 1 << 60


def read_binvox(data):
    """(resolution, keep): one byte a voxel, at i + n (j + n k)."""
    head, _, body = data.partition(b"\ndata\n")
    n = int(head.split(b"dim ")[1].split()[0])
    values = b"".join(bytes([body[at]]) * body[at + 1] for at in range(0, len(body), 2))
    keep = bytearray(n ** 3)
    for at, value in enumerate(values):  # x slowest, then z, then y fastest
        x, z, y = at // (n * n), at // n % n, at % n
        keep[x + n * (y + n * z)] = value
    return n, keep


def orders_of(lines, n):
    """Per voxel of the full grid how many voxels are gone once it is; NEVER: it stays. And how many each keyframe has cut by its end."""
    order, removed, after = [NEVER] * n ** 3, 0, []
    for line in lines:
        if line["type"] == "cut":
            first, last = line["voxels"]
            length = 1 + max(abs(a - b) for a, b in zip(first, last))
            step = [(b > a) - (b < a) for a, b in zip(first, last)]
            for m in range(length):
                i, j, k = (a + m * s for a, s in zip(first, step))
                removed += 1
                order[i + n * (j + n * k)] = removed
        if line["type"] in ("cut", "move"):
            after.append(removed)
    return order, after


def see(order, keep, n, axis, from_above, removed):
    """{(u, v): (class + 1, place along the axis)} of what each ray meets first; u and v are the other axes in order, nothing where it goes through."""
    strides = [1, n, n * n]
    u_stride, v_stride = (strides[other] for other in range(3) if other != axis)
    places = range(n - 1, -1, -1) if from_above else range(n)
    seen = {}
    for v in range(n):
        for u in range(n):
            base = u * u_stride + v * v_stride
            for place in places:
                at = base + place * strides[axis]
                if order[at] > removed:
                    seen[u, v] = (2 if keep[at] else 3 if order[at] == NEVER else 1), place
                    break
    return seen
