"""Writes the Utah teapot as a triangle mesh with the normals of its surface.

    python3 scenes/make_teapot.py [OUT.ply [STEPS]]

The shape is M. Newell's (1975): 32 bicubic Bezier patches. Most of them are quarters of surfaces of
revolution, whose four rows of control points are a profile (radius, height) turned by the points
(1, 0), (1, k), (k, 1), (0, 1) with k = 0.56; handle and spout are tubes whose halves mirror each
other in y = 0. That is how the published control points are written down here; the
knob's 0.448 is 0.45 in the list, and a sign in the spout's lip that is wrong in a common copy of the
list (y = +0.15) follows the mirror.

Every patch is cut into STEPS x STEPS (16) quadrilaterals of two triangles; the normal is the cross
product of the patch's derivatives, outwards, and the axis where the derivatives vanish on it. The
base lies in z = 0, up is +z, the spout points to +x, the body's largest radius is 2. Needs nothing
but Python. The same arguments give the same bytes; the default wrote scenes/geometry/teapot.ply.
"""

import math
import os
import struct
import sys

K = 0.56
QUARTER = ((1.0, 0.0), (1.0, K), (K, 1.0), (0.0, 1.0))

# (radius, height), from the lid's top along the outside to the middle of the base.
PROFILES = {
    "rim": ((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),
    "upper body": ((1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)),
    "lower body": ((2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)),
    "base": ((1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)),
    "knob": ((0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)),
    "lid": ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)),
}

# Rings along a tube: (x, z) of the cross-section's two ends in the plane y = 0, and its half width.
TUBES = {
    "upper handle": (
        ((-1.6, 2.025), (-1.5, 2.25), 0.3),
        ((-2.3, 2.025), (-2.5, 2.25), 0.3),
        ((-2.7, 2.025), (-3.0, 2.25), 0.3),
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
    ),
    "lower handle": (
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
        ((-2.7, 1.575), (-3.0, 1.35), 0.3),
        ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
        ((-2.0, 0.9), (-1.9, 0.6), 0.3),
    ),
    "lower spout": (
        ((1.7, 1.425), (1.7, 0.6), 0.66),
        ((2.6, 1.425), (3.1, 0.825), 0.66),
        ((2.3, 2.1), (2.4, 2.025), 0.25),
        ((2.7, 2.4), (3.3, 2.4), 0.25),
    ),
    "upper spout": (
        ((2.7, 2.4), (3.3, 2.4), 0.25),
        ((2.8, 2.475), (3.525, 2.49375), 0.25),
        ((2.9, 2.475), (3.45, 2.5125), 0.15),
        ((2.8, 2.4), (3.2, 2.4), 0.15),
    ),
}


def patches():
    """(control points [4][4], whether it belongs to a tube) of all 32."""
    for profile in PROFILES.values():
        for turn in range(4):
            # A quarter turn is (x, y) -> (-y, x).
            arc = QUARTER
            for _ in range(turn):
                arc = tuple((-y, x) for x, y in arc)
            yield [[(r * x, r * y, z) for x, y in arc] for r, z in profile], False
    for rings in TUBES.values():
        for side in (-1.0, 1.0):
            yield [
                [
                    (a[0], 0.0, a[1]),
                    (a[0], side * width, a[1]),
                    (b[0], side * width, b[1]),
                    (b[0], 0.0, b[1]),
                ]
                for a, b, width in rings
            ], True


def bernstein(t):
    s = 1.0 - t
    return (s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t)


def bernstein_slope(t):
    s = 1.0 - t
    return (-3 * s * s, 3 * s * s - 6 * t * s, 6 * t * s - 3 * t * t, 3 * t * t)


def weighted(patch, along, across):
    return tuple(
        sum(along[i] * across[j] * patch[i][j][c] for i in range(4) for j in range(4))
        for c in range(3)
    )


def cross(a, b):
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def derivatives(patch, u, v):
    bu, bv = bernstein(u), bernstein(v)
    return weighted(patch, bernstein_slope(u), bv), weighted(patch, bu, bernstein_slope(v))


def outward_sign(patch, tube):
    """Of across x along: the same over a whole patch, since that product never turns over."""
    if not tube:
        return -1.0  # profiles run from the lid's top along the outside to the base
    # Halfway round the ring that a tube begins with, outwards is away from the ring's middle.
    along, across = derivatives(patch, 0.0, 0.5)
    point = weighted(patch, bernstein(0.0), bernstein(0.5))
    middle = tuple((patch[0][0][c] + patch[0][3][c]) / 2 for c in range(3))
    facing = sum(n * (p - m) for n, p, m in zip(cross(across, along), point, middle))
    return 1.0 if facing > 0 else -1.0


def surface(patch, sign, u, v):
    """Point and outward unit normal."""
    point = weighted(patch, bernstein(u), bernstein(v))
    along, across = derivatives(patch, u, v)
    normal = cross(across, along)
    length = math.sqrt(sum(x * x for x in normal))
    if length < 1e-9:
        # Only where a surface of revolution meets its axis.
        assert math.hypot(point[0], point[1]) < 1e-9
        return point, (0.0, 0.0, 1.0 if point[2] > 1 else -1.0)
    return point, tuple(sign * x / length for x in normal)


def mesh(steps):
    """Vertices (position and normal as float32 bytes, each once) and triangles."""
    index_of, vertices, triangles = {}, [], []
    for patch, tube in patches():
        sign, grid = outward_sign(patch, tube), []
        for i in range(steps + 1):
            row = []
            for j in range(steps + 1):
                point, normal = surface(patch, sign, i / steps, j / steps)
                # Rounded, so that neighbouring patches share what they meet in; -0 becomes 0.
                key = tuple(round(x, 6) + 0.0 for x in point + normal)
                if key not in index_of:
                    index_of[key] = len(vertices)
                    vertices.append(key)
                row.append(index_of[key])
            grid.append(row)
        for i in range(steps):
            for j in range(steps):
                a, b = grid[i][j], grid[i][j + 1]
                c, d = grid[i + 1][j], grid[i + 1][j + 1]
                for triangle in ((a, d, b), (a, c, d)):
                    corners = [vertices[t] for t in triangle]
                    if len({corner[:3] for corner in corners}) < 3:
                        continue  # at the axis two corners fall together
                    edges = [
                        tuple(q - p for p, q in zip(corners[0][:3], corner[:3]))
                        for corner in corners[1:]
                    ]
                    facing = cross(*edges)
                    mean = [sum(corner[3 + c] for corner in corners) for c in range(3)]
                    outwards = sum(f * n for f, n in zip(facing, mean)) > 0
                    triangles.append(triangle if outwards else triangle[::-1])
    return vertices, triangles


def write_ply(path, comment, vertices, triangles):
    """Vertices are (x, y, z, nx, ny, nz)."""
    header = (
        f"ply\nformat binary_little_endian 1.0\ncomment {comment}\n"
        f"element vertex {len(vertices)}\n"
        + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
        + f"element face {len(triangles)}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode("ascii"))
        for vertex in vertices:
            file.write(struct.pack("<6f", *vertex))
        for triangle in triangles:
            file.write(struct.pack("<B3I", 3, *triangle))
    print(f"{path}: {len(vertices)} vertices, {len(triangles)} triangles")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "geometry", "teapot.ply")
    steps = int(sys.argv[2]) if len(sys.argv) > 2 else 16
    if steps < 1:
        sys.exit("make_teapot.py: STEPS must be at least 1")
    comment = f"Utah teapot, 32 patches of {steps} x {steps}, scenes/make_teapot.py"
    write_ply(path, comment, *mesh(steps))


if __name__ == "__main__":
    main()
