#!/usr/bin/env python3
"""Writes objects of shapes that are in no family of the program: convex stones, bumpy bodies and bent
tubes. rehearsal_objects.py DIR [COUNT_OF_EACH] [SEED]

Nobody looked at what any hand holds when the ranges were chosen; the numbers follow from the seed."""
import math
import os
import random
import sys


def hull(points):
    """Outward triangles of the convex hull, by trying each triple."""
    triangles = []
    n = len(points)
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(j + 1, n):
                a, b, c = points[i], points[j], points[k]
                u = [b[d] - a[d] for d in range(3)]
                v = [c[d] - a[d] for d in range(3)]
                normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0])
                sides = [sum(normal[d] * (p[d] - a[d]) for d in range(3))
                         for m, p in enumerate(points) if m not in (i, j, k)]
                if max(sides) <= 0:
                    triangles.append((i, j, k))
                elif min(sides) >= 0:
                    triangles.append((i, k, j))
    used = sorted({i for triangle in triangles for i in triangle})
    place = {i: m for m, i in enumerate(used)}
    return [points[i] for i in used], [tuple(place[i] for i in t) for t in triangles]


def make_stone(rng):
    axes = sorted((rng.uniform(0.025, 0.06) for _ in range(2)), reverse=True)
    axes = [rng.uniform(max(axes), 0.12)] + axes
    points = []
    for _ in range(26):
        direction = [rng.gauss(0, 1) for _ in range(3)]
        length = math.sqrt(sum(x * x for x in direction))
        points.append(tuple(0.5 * axes[d] * direction[d] / length for d in range(3)))
    return hull(points)


def icosphere(times):
    t = (1 + math.sqrt(5)) / 2
    points = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t),
              (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    triangles = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
                 (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
                 (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(times):
        middle, finer = {}, []

        def half(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(tuple((points[a][d] + points[b][d]) / 2 for d in range(3)))
            return middle[key]

        for a, b, c in triangles:
            ab, bc, ca = half(a, b), half(b, c), half(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        triangles = finer
    unit = []
    for p in points:
        length = math.sqrt(sum(x * x for x in p))
        unit.append(tuple(x / length for x in p))
    return unit, triangles


def make_bumpy(rng):
    points, triangles = icosphere(4)
    bumps = []
    for _ in range(rng.randint(3, 6)):
        direction = [rng.gauss(0, 1) for _ in range(3)]
        length = math.sqrt(sum(x * x for x in direction))
        bumps.append(([x / length for x in direction], rng.uniform(-0.25, 0.5),
                      rng.uniform(2.0, 8.0)))
    axes = [rng.uniform(0.015, 0.045), rng.uniform(0.015, 0.035), rng.uniform(0.015, 0.035)]
    shaped = []
    for p in points:
        radius = 1.0
        for direction, height, narrow in bumps:
            cosine = sum(p[d] * direction[d] for d in range(3))
            radius += height * math.exp(narrow * (cosine - 1))
        shaped.append(tuple(radius * axes[d] * p[d] for d in range(3)))
    return shaped, triangles


def make_tube(rng):
    """A tube of changing radius about an arc of a helix, with round ends."""
    radius, change = rng.uniform(0.008, 0.02), rng.uniform(-0.3, 0.3)
    bend = rng.uniform(2.2, 4.0) * radius
    turn = math.radians(rng.uniform(50, 230))
    climb = rng.uniform(0.0, 1.2) * radius
    rings, around, ends = 40, 28, 7

    def axis(s):
        angle = turn * s
        p = (bend * math.cos(angle), bend * math.sin(angle), climb * s)
        speed = (-bend * turn * math.sin(angle), bend * turn * math.cos(angle), climb)
        length = math.sqrt(sum(x * x for x in speed))
        tangent = [x / length for x in speed]
        out = (math.cos(angle), math.sin(angle), 0.0)
        along = sum(out[d] * tangent[d] for d in range(3))
        out = [out[d] - along * tangent[d] for d in range(3)]
        length = math.sqrt(sum(x * x for x in out))
        out = [x / length for x in out]
        up = [tangent[1] * out[2] - tangent[2] * out[1], tangent[2] * out[0] - tangent[0] * out[2],
              tangent[0] * out[1] - tangent[1] * out[0]]
        return p, tangent, out, up

    def wide(s):
        return radius * (1 + change * math.sin(math.pi * s))

    stations = []  # (s, shift along the tangent, radius)
    for k in range(1, ends):
        angle = math.pi / 2 * (1 - k / ends)
        stations.append((0.0, -wide(0) * math.sin(angle), wide(0) * math.cos(angle)))
    stations += [(k / rings, 0.0, wide(k / rings)) for k in range(rings + 1)]
    for k in range(ends - 1, 0, -1):
        angle = math.pi / 2 * (1 - k / ends)
        stations.append((1.0, wide(1) * math.sin(angle), wide(1) * math.cos(angle)))
    points, triangles = [], []
    for s, shift, r in stations:
        p, tangent, out, up = axis(s)
        for j in range(around):
            a = 2 * math.pi * j / around
            points.append(tuple(p[d] + shift * tangent[d] + r * (math.cos(a) * out[d] +
                                                                  math.sin(a) * up[d])
                                for d in range(3)))
    for i in range(len(stations) - 1):
        for j in range(around):
            a, b = i * around + j, i * around + (j + 1) % around
            c, d = a + around, b + around
            triangles += [(a, b, c), (b, d, c)]
    for s, sign, first in ((0.0, -1, 0), (1.0, 1, (len(stations) - 1) * around)):
        p, tangent, _, _ = axis(s)
        tip = len(points)
        points.append(tuple(p[d] + sign * wide(s) * tangent[d] for d in range(3)))
        for j in range(around):
            a, b = first + j, first + (j + 1) % around
            triangles.append((tip, b, a) if sign < 0 else (tip, a, b))
    return points, triangles


def volume(points, triangles):
    total = 0.0
    for a, b, c in triangles:
        p, q, r = points[a], points[b], points[c]
        total += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                  p[2] * (q[0] * r[1] - q[1] * r[0])) / 6
    return total


def write(folder, name, points, triangles, rng):
    if volume(points, triangles) < 0:
        triangles = [(a, c, b) for a, b, c in triangles]
    os.makedirs(os.path.join(folder, name), exist_ok=True)
    friction = rng.uniform(0.35, 0.6)
    with open(os.path.join(folder, name, "mesh.obj"), "w") as file:
        for p in points:
            file.write("v %.6f %.6f %.6f\n" % p)
        for a, b, c in triangles:
            file.write("f %d %d %d\n" % (a + 1, b + 1, c + 1))
    with open(os.path.join(folder, name, "object.yaml"), "w") as file:
        file.write("name: %s\nmesh: mesh.obj\nmesh_unit: m\ndensity_kg_per_m3: %.0f\n"
                   "friction_static: %.2f\nfriction_dynamic: %.2f\n" %
                   (name.replace("_", " "), rng.uniform(250, 1100), friction, 0.88 * friction))


def main():
    folder = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    seed = sys.argv[3:4]
    for kind, make in (("stone", make_stone), ("bumpy", make_bumpy), ("tube", make_tube)):
        for number in range(count):
            rng = random.Random(" ".join(["graspbench rehearsal", kind, str(number)] + seed))
            points, triangles = make(rng)
            write(folder, "%s_%02d" % (kind, number), points, triangles, rng)


main()
