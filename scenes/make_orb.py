"""Writes the stand and the backdrop of scenes/material-orb.pbrt as triangle meshes with normals.

    python3 scenes/make_orb.py [FOLDER]

The stand is a profile (radius, height) turned about the z axis, smooth between the corners that the
profile names; the backdrop is a floor that bends up into a wall along a quarter circle. The same
version gives the same bytes; they are scenes/geometry/orb-stand.ply and orb-backdrop.ply.
"""

import math
import os
import sys

from make_teapot import write_ply

AROUND = 96

# Pieces of the stand from its foot upwards: points (radius, height) of polylines; the normal is that
# of each segment, so that pieces and segments have sharp edges, and rounded ones many segments.
FOOT = [(0.0, 0.0), (0.95, 0.0)]
RIM = [(0.95 + 0.05 * math.sin(a), 0.05 - 0.05 * math.cos(a)) for a in
       (math.pi * i / 16 for i in range(17))]
STEM = [(0.33 + 0.62 * (1 - t) ** 3 + 0.13 * t**4, 0.1 + 0.4 * t) for t in
        (i / 24 for i in range(25))]
CUP = [(0.46, 0.5), (0.40, 0.5), (0.0, 0.42)]


def smooth_normals(profile):
    """Of a polyline that stands for a smooth curve: outwards, from its neighbours' chord."""
    normals = []
    for i in range(len(profile)):
        before, after = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        dr, dz = after[0] - before[0], after[1] - before[1]
        length = math.hypot(dr, dz)
        normals.append((dz / length, -dr / length))
    return normals


def turned(pieces):
    vertices, triangles = [], []
    for profile in pieces:
        first, normals = len(vertices), smooth_normals(profile)
        for (r, z), (nr, nz) in zip(profile, normals):
            for k in range(AROUND):
                c, s = math.cos(2 * math.pi * k / AROUND), math.sin(2 * math.pi * k / AROUND)
                vertices.append((r * c, r * s, z, nr * c, nr * s, nz))
        for i in range(len(profile) - 1):
            for k in range(AROUND):
                a, b = first + i * AROUND + k, first + i * AROUND + (k + 1) % AROUND
                c, d = a + AROUND, b + AROUND
                # On the axis a ring is one point, and one of the two triangles has no area.
                if profile[i][0] > 0:
                    triangles.append((a, b, d))
                if profile[i + 1][0] > 0:
                    triangles.append((a, d, c))
    return vertices, triangles


def backdrop(half_width=12.0, front=-9.0, back=4.0, radius=3.0, height=9.0, steps=32):
    """Floor z = 0 from y = front to back - radius, a quarter circle, a wall y = back."""
    curve = [(front, 0.0, 0.0, 1.0)]
    for i in range(steps + 1):
        a = math.pi / 2 * i / steps
        y, z = back - radius + radius * math.sin(a), radius - radius * math.cos(a)
        curve.append((y, z, -math.sin(a), math.cos(a)))
    curve.append((back, height, -1.0, 0.0))
    vertices = [(x, y, z, 0.0, ny, nz) for y, z, ny, nz in curve for x in (-half_width, half_width)]
    triangles = []
    for i in range(len(curve) - 1):
        a, b, c, d = 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3
        triangles += [(a, b, d), (a, d, c)]
    return vertices, triangles


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "geometry")
    stand = turned([FOOT, RIM, STEM, CUP[:2], CUP[1:]])
    write_ply(os.path.join(folder, "orb-stand.ply"), "stand of the orb, scenes/make_orb.py", *stand)
    write_ply(
        os.path.join(folder, "orb-backdrop.ply"), "backdrop of the orb, scenes/make_orb.py",
        *backdrop(),
    )


if __name__ == "__main__":
    main()
