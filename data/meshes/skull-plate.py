"""Makes skull-plate.ply: a plate with five screws on the skull of cthead.

    python3 skull-plate.py FOLDER-OF-CTHEAD > skull-plate.ply

The outer face of the bone between y = 80 and 150, x = f(y, z), is found in the scan and smoothed by a polynomial of
degree 2; the plate lies on it. Needs Python 3 alone.
"""

import gzip
import math
import struct
import sys

BONE = 1400.0
LENGTH, WIDTH, THICKNESS = 64.0, 9.5, 2.2
SCREWS, PITCH = 5, 13.0
CENTRE = (114.0, 60.5)

voxels = gzip.open(sys.argv[1] + "/cthead.raw.gz").read()


def value(x, y, k):
    """A voxel; the file is big-endian."""
    return struct.unpack_from(">h", voxels, 2 * ((k * 256 + y) * 256 + x))[0]


def face(y, k):
    """The x at which bone begins, from the outside, in slice k."""
    for x in range(240, 120, -1):
        a, b = value(x, y, k), value(x + 1, y, k)
        if a >= BONE:
            return x + (a - BONE) / (a - b)
    raise ValueError("no bone")


def solve(rows, right):
    """Least squares by the normal equations."""
    n = len(rows[0])
    m = [[sum(r[i] * r[j] for r in rows) for j in range(n)] + [sum(r[i] * b for r, b in zip(rows, right))] for i in range(n)]
    for i in range(n):
        p = max(range(i, n), key=lambda r: abs(m[r][i]))
        m[i], m[p] = m[p], m[i]
        for r in range(n):
            if r != i:
                f = m[r][i] / m[i][i]
                m[r] = [a - f * b for a, b in zip(m[r], m[i])]
    return [m[i][n] / m[i][i] for i in range(n)]


def terms(y, z):
    u, w = (y - CENTRE[0]) / 30, (z - CENTRE[1]) / 10
    return [1, u, w, u * u, u * w, w * w]


samples = [(y, 2 * k, face(y, k)) for y in range(80, 150) for k in range(26, 35)]
POLYNOMIAL = solve([terms(y, z) for y, z, _ in samples], [x for _, _, x in samples])


def bone(y, z):
    return sum(c * t for c, t in zip(POLYNOMIAL, terms(y, z)))


def normal_of_bone(y, z):
    h = 1e-3
    return unit([1, (bone(y - h, z) - bone(y + h, z)) / (2 * h), (bone(y, z - h) - bone(y, z + h)) / (2 * h)])


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v] if length else [0, 0, 0]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


vertices, normals, triangles = [], [], []


def patch(points, closed=False):
    """Adds a grid of points, smooth inside itself and with an edge to others."""
    rows, columns, first = len(points), len(points[0]), len(vertices)
    vertices.extend(p for row in points for p in row)
    sums = [[0, 0, 0] for _ in range(rows * columns)]
    for i in range(rows - 1):
        for j in range(columns if closed else columns - 1):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            for t in ([a, b, a + columns], [b, b + columns, a + columns]):
                p, q, r = (vertices[first + k] for k in t)
                n = cross([q[i] - p[i] for i in range(3)], [r[i] - p[i] for i in range(3)])
                if any(n):
                    triangles.append([first + k for k in t])
                    for k in t:
                        sums[k] = [s + c for s, c in zip(sums[k], n)]
    normals.extend(unit(n) for n in sums)


def on_bone(y, z, height):
    """A point at a height over the bone."""
    n = normal_of_bone(y, z)
    return [bone(y, z) + n[0] * height, y + n[1] * height, z + n[2] * height]


def half_width(s):
    """Half the plate's width at s from its middle: a waist between screws, round ends."""
    waist = WIDTH / 2 * (0.8 + 0.2 * math.cos(2 * math.pi * s / PITCH))
    end = LENGTH / 2 - abs(s)
    return min(waist, math.sqrt(max(0, end * (WIDTH - end)))) if end < WIDTH / 2 else waist


def plate():
    along = [LENGTH / 2 * math.sin(math.pi / 2 * (2 * i / 120 - 1)) for i in range(121)]
    across = [math.sin(math.pi / 2 * (2 * j / 10 - 1)) for j in range(11)]
    height = lambda v: THICKNESS * (1 - 0.25 * v ** 4)
    at = lambda s, v, h: on_bone(CENTRE[0] + s, CENTRE[1] + v * half_width(s), h)
    patch([[at(s, v, height(v)) for v in across] for s in along])
    for v in (-1, 1):
        patch([[at(s, v, h) for h in (-1, height(v))] for s in along])


def screw(s):
    """A head with a socket on the plate, and a shaft into the bone, as a lathe makes them."""
    y, z = CENTRE[0] + s, CENTRE[1]
    foot, n = on_bone(y, z, THICKNESS), normal_of_bone(y, z)
    u = unit(cross(n, [0, 0, 1]))
    w = cross(n, u)
    profile = [(3.4, -0.6), (3.3, 0.5), (2.7, 1.1), (1.8, 1.35), (1.6, 1.2), (1.5, 0.0), (0, 0.0)]
    shaft = [(1.3, -1.0)] + [(1.15 + 0.35 * (k % 2), -1.0 - 0.5 * k) for k in range(1, 13)] + [(0, -9.0)]
    for line, smooth in ((profile, False), (shaft, True)):
        rings = [[[f + r * (a * math.cos(t) + b * math.sin(t)) + h * c for f, a, b, c in zip(foot, u, w, n)]
                  for t in (2 * math.pi * k / 24 for k in range(24))] for r, h in line]
        if smooth:
            patch(rings, closed=True)
        else:
            for pair in zip(rings, rings[1:]):
                patch(list(pair), closed=True)


plate()
for i in range(SCREWS):
    screw((i - (SCREWS - 1) / 2) * PITCH)
out = sys.stdout.buffer
out.write(("ply\nformat binary_little_endian 1.0\ncomment a plate with five screws, made by skull-plate.py\n"
           f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
           "property float nx\nproperty float ny\nproperty float nz\n"
           f"element face {len(triangles)}\nproperty list uchar ushort vertex_indices\nend_header\n").encode())
for p, n in zip(vertices, normals):
    out.write(struct.pack("<6f", *p, *n))
for t in triangles:
    out.write(struct.pack("<B3H", 3, *t))
