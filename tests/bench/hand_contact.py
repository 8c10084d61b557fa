#!/usr/bin/env python3
"""How true what an imported hand touches with is to its description: an oracle for graspbench hand import.

  hand_contact.py GRASPBENCH FOLDER [DESCRIPTION.urdf ..]

Writes twelve hands of known shapes to FOLDER, imports them and the named descriptions, or without any
those of GRASPBENCH_DATA (else ../shared/data), and measures the imported hands against the description's
own meshes, all joints at zero. Ends with one line for each hand. Nothing here is shared with the
fit: distances to triangles are exact, inside is a generalised winding number above a half (Jacobson
2013), and a probe ball of 5 mm is marched until it touches a ball of the hand.

Out: points on balls and capsules that no other ball of the link holds, outside its meshes, and not in
those of a neighbour. Sink: surface points where the probe rests on the description and comes straight from
far away. Palmar: the normal is within 60 deg of the palm's. Ends with 1 where a bar is missed: out 1 mm
(open meshes 3 mm), sink 1 mm at 95 of 100 points, 5 mm at most on the palmar side and tips.
"""
import itertools
import os
import pathlib
import struct
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import yaml

PROBE = 0.005
CLOSED_OUT, OPEN_OUT, SINK_95, SINK_MOST = 0.001, 0.003, 0.001, 0.005


# ---- geometry ----------------------------------------------------------------------------------------


def rpy(r, p, y):
    c, s = np.cos([r, p, y]), np.sin([r, p, y])
    rx = np.array([[1, 0, 0], [0, c[0], -s[0]], [0, s[0], c[0]]])
    ry = np.array([[c[1], 0, s[1]], [0, 1, 0], [-s[1], 0, c[1]]])
    rz = np.array([[c[2], -s[2], 0], [s[2], c[2], 0], [0, 0, 1]])
    return rz @ ry @ rx


def chunks(n, width, most=500_000):
    step = max(1, most // max(1, width))
    return [slice(k, min(n, k + step)) for k in range(0, n, step)]


def segment_distance(p, a, b):
    ab = b - a
    t = np.einsum("ij,ij->i", p - a, ab) / np.maximum(np.einsum("ij,ij->i", ab, ab), 1e-30)
    return np.linalg.norm(p - a - np.clip(t, 0, 1)[:, None] * ab, axis=1)


def triangle_distance(p, t):
    """Point i to triangle i: in the plane where the foot lies within, else to the nearest edge."""
    a, b, c = t[:, 0], t[:, 1], t[:, 2]
    n = np.cross(b - a, c - a)
    area = np.linalg.norm(n, axis=1)
    n = n / np.maximum(area, 1e-30)[:, None]
    foot_in = area > 1e-16
    for u, v in ((a, b), (b, c), (c, a)):
        foot_in &= np.einsum("ij,ij->i", np.cross(v - u, p - u), n) >= 0
    edges = np.minimum(np.minimum(segment_distance(p, a, b), segment_distance(p, b, c)), segment_distance(p, c, a))
    return np.where(foot_in, np.abs(np.einsum("ij,ij->i", p - a, n)), edges)


def distances(a, b):
    """Of all points a from all points b."""
    return np.sqrt(np.maximum(0, (a**2).sum(1)[:, None] + (b**2).sum(1) - 2 * a @ b.T))


class Surface:
    """Triangles (t, 3, 3)."""

    def __init__(self, triangles):
        size = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
        self.t = triangles[size > 1e-14]
        self.area = size[size > 1e-14] / 2
        self.middle = (self.t.min(axis=1) + self.t.max(axis=1)) / 2
        self.reach = np.linalg.norm(self.t - self.middle[:, None], axis=2).max(axis=1)

    def distance(self, points):
        least = np.empty(len(points))
        for part in chunks(len(points), len(self.t)):
            p = points[part]
            far = distances(p, self.middle)
            row, column = np.nonzero(far - self.reach <= (far + self.reach).min(axis=1)[:, None] + 1e-9)
            least[part] = np.inf
            for k in chunks(len(row), 1, 100_000):
                np.minimum.at(least[part], row[k], triangle_distance(p[row[k]], self.t[column[k]]))
        return least

    def winding(self, points):
        total = np.empty(len(points))
        for part in chunks(len(points), len(self.t), 150_000):
            a, b, c = (self.t[None, :, k] - points[part][:, None] for k in range(3))
            la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
            dot = lambda u, v: np.einsum("ijk,ijk->ij", u, v)
            angle = np.arctan2(dot(a, np.cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
            total[part] = angle.sum(axis=1) / (2 * np.pi)
        return np.abs(total)

    def sample(self, count, random):
        k = random.choice(len(self.t), count, p=self.area / self.area.sum())
        u, v = random.random((2, count))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        a, b, c = self.t[k, 0], self.t[k, 1], self.t[k, 2]
        n = np.cross(b - a, c - a)
        return a + u[:, None] * (b - a) + v[:, None] * (c - a), n / np.linalg.norm(n, axis=1)[:, None]


def is_open(triangles):
    """An edge that one triangle alone has."""
    _, index = np.unique(np.round(triangles.reshape(-1, 3), 8), axis=0, return_inverse=True)
    corners = index.reshape(-1, 3)
    corners = corners[(np.diff(np.sort(corners, axis=1), axis=1) > 0).all(axis=1)]
    edges = np.sort(np.vstack([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    return bool((np.unique(edges, axis=0, return_counts=True)[1] % 2 == 1).any())


# ---- reading -----------------------------------------------------------------------------------------


def read_mesh(file):
    data = file.read_bytes()
    if file.suffix.lower() == ".stl":
        count = struct.unpack("<I", data[80:84])[0]
        rows = np.frombuffer(data, np.dtype([("n", "<3f4"), ("t", "<9f4"), ("a", "<u2")]), count, 84)
        return rows["t"].reshape(-1, 3, 3).astype(float)
    vertices, faces = [], []
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            corner = [int(w.split("/")[0]) for w in words[1:]]
            corner = [k - 1 if k > 0 else len(vertices) + k for k in corner]
            faces += [[corner[0], corner[k], corner[k + 1]] for k in range(1, len(corner) - 1)]
    return np.array(vertices)[np.array(faces)]


def numbers(element, attribute, otherwise):
    text = element.get(attribute) if element is not None else None
    return np.array([float(w) for w in text.split()]) if text else np.array(otherwise, float)


def origin(element):
    o = element.find("origin")
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = rpy(*numbers(o, "rpy", [0, 0, 0])), numbers(o, "xyz", [0, 0, 0])
    return X


def move(X, points):
    return points @ X[:3, :3].T + X[:3, 3]


def box(size):
    t = []
    for axis, side in itertools.product(range(3), (-1, 1)):
        u, v = np.zeros(3), np.zeros(3)
        u[(axis + 1) % 3], v[(axis + 2) % 3] = size[(axis + 1) % 3] / 2, size[(axis + 2) % 3] / 2
        m = np.zeros(3)
        m[axis] = side * size[axis] / 2
        q = [m - u - v, m + u - v, m + u + v, m - u + v]
        q = q if side > 0 else q[::-1]
        t += [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
    return np.array(t)


def solid(geometry, folder):
    shape = geometry[0]
    if shape.tag == "mesh":
        scale = numbers(shape, "scale", [1, 1, 1])
        t = read_mesh(folder / shape.get("filename").replace("package://", "")) * scale
        return t if scale.prod() > 0 else t[:, ::-1]
    if shape.tag == "box":
        return box(numbers(shape, "size", [0, 0, 0]))
    r = float(shape.get("radius"))
    if shape.tag == "sphere":
        return revolve([(r * np.cos(a), r * np.sin(a)) for a in np.linspace(-np.pi / 2, np.pi / 2, 25)])
    h = float(shape.get("length")) / 2
    return revolve([(0, -h), (r, -h), (r, h), (0, h)])


class Urdf:
    def __init__(self, file):
        self.folder = file.parent
        self.links = {e.get("name"): e for e in ET.parse(file).getroot().findall("link")}
        self.above = {}
        for joint in ET.parse(file).getroot().findall("joint"):
            self.above[joint.find("child").get("link")] = (
                joint.find("parent").get("link"), origin(joint), joint.get("type"))

    def pose(self, link):
        if link not in self.above:
            return np.eye(4)
        parent, X, _ = self.above[link]
        return self.pose(parent) @ X

    def body(self, link):
        """The link that carries it: up over fixed joints."""
        while link in self.above and self.above[link][2] == "fixed":
            link = self.above[link][0]
        return link

    def surfaces(self):
        """By body, at zero: what touches, the pictures where a body has nothing else."""
        parts, touching = {}, {self.body(name) for name, link in self.links.items() if link.findall("collision")}
        for name, link in self.links.items():
            for shape in link.findall("collision" if self.body(name) in touching else "visual"):
                t = solid(shape.find("geometry"), self.folder)
                t = move(self.pose(name) @ origin(shape), t.reshape(-1, 3)).reshape(-1, 3, 3)
                parts.setdefault(self.body(name), []).append(t)
        return parts


def spread(half, apart):
    gaps = int(np.ceil(2 * half / apart - 1e-9))
    return [0.0] if gaps <= 0 else [half * (2 * k / gaps - 1) for k in range(gaps + 1)]


def list_balls(shape, apart):
    """What core/hand/contact_shape.h says of a shape: balls (centre, radius), capsules (a, b, radius)."""
    geometry = shape.find("geometry")[0]
    X, kind = origin(shape), geometry.tag
    if kind == "sphere":
        r = float(geometry.get("radius"))
        return [(X[:3, 3], r)], [(X[:3, 3], X[:3, 3], r)]
    if kind == "cylinder":
        d, length = 2 * float(geometry.get("radius")), float(geometry.get("length"))
        size = np.array([d, d, length])
        along, wide = 2, 0
        if length < d:
            size[:2] *= np.sqrt(np.pi) / 2
            kind = "box"
    else:
        size = numbers(geometry, "size", [0, 0, 0])
    if kind == "box":
        thin, along = int(np.argmin(size)), int(np.argmax(size))
        along = (thin + 1) % 3 if along == thin else along
        wide = 3 - thin - along
        r = size[thin] / 2
    else:
        r = size[0] / 2
    balls, capsules = [], []
    for across in spread(size[wide] / 2 - r, apart * r):
        row = []
        for position in spread(size[along] / 2 - r, apart * r):
            p = np.zeros(3)
            p[wide], p[along] = across, position
            row.append(move(X, p))
        balls += [(p, r) for p in row]
        p, q = np.zeros(3), np.zeros(3)
        p[wide], q[wide] = across, across
        p[along], q[along] = -(size[along] / 2 - r), size[along] / 2 - r
        capsules.append((move(X, p), move(X, q), r))
    return balls, capsules


class ImportedHand:
    """Balls (centre, radius) in the frame of the description's body, with the body's name."""

    def __init__(self, folder, description):
        urdf = Urdf(folder / "hand.urdf")
        hand = yaml.safe_load((folder / "hand.yaml").read_text())
        self.tips = {digit["links"][-1] for digit in hand["digits"]}
        palm = hand["palm"]["link"]
        self.normal = description.pose(palm)[:3, :3] @ np.array(hand["palm"]["normal"], float)
        self.balls, self.capsules = {}, {}
        for name, link in urdf.links.items():
            body = description.body(name)
            X = description.pose(name)
            for shape in link.findall("collision"):
                balls, capsules = list_balls(shape, 0.8 if name in self.tips else 1.5)
                if shape.get("name") != "self_contact":
                    self.balls.setdefault(body, []).extend((move(X, c), r) for c, r in balls)
                if shape.get("name") != "cover":
                    self.capsules.setdefault(body, []).extend((move(X, a), move(X, b), r) for a, b, r in capsules)
        self.tips = {description.body(tip) for tip in self.tips}


# ---- measuring ---------------------------------------------------------------------------------------


def on_sphere(radius):
    count = int(np.clip(4 * np.pi * radius**2 / 0.0012**2, 60, 4000))
    k = np.arange(count) + 0.5
    z = 1 - 2 * k / count
    angle = k * (np.pi * (1 + np.sqrt(5)))
    s = np.sqrt(1 - z**2)
    return np.stack([s * np.cos(angle), s * np.sin(angle), z], axis=1)


def find_out(balls, capsules, surface, others, is_opened):
    chain = [(a + s * (b - a), r) for a, b, r in capsules
             for s in np.linspace(0, 1, 1 + int(np.ceil(np.linalg.norm(b - a) / max(r / 2, 1e-3))))]
    centres = np.array([c for c, _ in balls + chain])
    radii = np.array([r for _, r in balls + chain])
    points, normals = [], []
    for k, (c, r) in enumerate(zip(centres, radii)):
        n = on_sphere(r)
        p = c + r * n
        near = np.nonzero(np.linalg.norm(centres - c, axis=1) < radii + r)[0]
        near = near[near != k]
        if len(near):
            free = (np.linalg.norm(p[:, None] - centres[near], axis=2) >= radii[near] - 1e-9).all(axis=1)
            p, n = p[free], n[free]
        points.append(p)
        normals.append(n)
    points, normals = np.vstack(points), np.vstack(normals)
    out = surface.distance(points)
    far = np.nonzero(out > 0.0002)[0]
    out[out <= 0.0002] = 0.0
    for part in [surface] + others:
        inside = part.winding(points[far]) > 0.5
        out[far[inside]] = 0.0
        far = far[~inside]
    if is_opened and len(far):  # not farther than from where half of the surface is around
        out[far] = np.minimum(out[far], way_in(surface, points[far], OPEN_OUT + 0.001))
    return out, normals


def way_in(surface, points, most, step=0.0001):
    """Along the gradient of the winding number until it is a half; `most` where it is not."""
    ways, at, left = np.full(len(points), most), points.copy(), np.arange(len(points))
    slope = np.stack([surface.winding(points + d) - surface.winding(points - d) for d in 0.0005 * np.eye(3)], 1)
    slope /= np.maximum(np.linalg.norm(slope, axis=1), 1e-12)[:, None]
    for k in range(1, int(most / step)):
        at[left] += step * slope[left]
        inside = surface.winding(at[left]) > 0.5
        ways[left[inside]] = k * step
        left = left[~inside]
    return ways


def can_come(centre, normal, cloud, count=40):
    """A straight way for the probe from far away, along the normal or another direction."""
    comes = np.zeros(len(centre), bool)
    for part in chunks(len(centre), len(cloud)):
        way = cloud[None] - centre[part, None]
        along = np.einsum("ijk,ik->ij", way, normal[part])
        comes[part] = ~((along > 0) & ((way**2).sum(axis=2) - along**2 < (PROBE - 0.0003) ** 2)).any(axis=1)
    for d in on_sphere(0.001)[:count]:
        left = np.nonzero(~comes & (normal @ d > -0.2))[0]
        for part in chunks(len(left), len(cloud)):
            k = left[part]
            along = (cloud @ d)[None, :] - (centre[k] @ d)[:, None]
            comes[k] = ~((along > 0) & (distances(centre[k], cloud) ** 2 - along**2 < (PROBE - 0.0003) ** 2)).any(axis=1)
    return comes


def find_sink(surface, others, centres, radii, random, count=1000):
    p, n = surface.sample(count, random)
    p, n = np.vstack([p, p]), np.vstack([n, -n])
    centre = p + PROBE * n
    rests = surface.distance(centre) > PROBE - 0.0001
    for other in others:
        k = np.nonzero(rests)[0]
        if len(k):
            rests[k] = other.distance(centre[k]) > PROBE - 0.0001
    p, n, centre = p[rests], n[rests], centre[rests]
    for part in [surface] + others:
        outside = part.winding(centre) < 0.5
        p, n, centre = p[outside], n[outside], centre[outside]
    comes = can_come(centre, n, surface.sample(2000, random)[0])
    p, n = p[comes], n[comes]
    sink, left = np.zeros(len(p)), np.arange(len(p))
    while len(left):  # as far as no ball can be met, again and again
        at = p[left] + (PROBE - sink[left])[:, None] * n[left]
        gap = np.concatenate([(distances(at[part], centres) - radii - PROBE).min(axis=1)
                              for part in chunks(len(left), len(centres))])
        sink[left] += np.maximum(gap, 0)
        left = left[(gap > 1e-6) & (sink[left] < 0.01)]
    return np.minimum(sink, 0.01), n


def two(values):
    if len(values) == 0:
        return (0.0, 0.0)
    values = np.sort(values)
    return (values[(len(values) - 1) * 95 // 100], values[-1])


def measure(name, description_file, folder):
    """Prints a row for each link; returns what misses a bar and a line of the worst of each figure."""
    random = np.random.default_rng(5)
    description = Urdf(description_file)
    hand = ImportedHand(folder, description)
    triangles = {body: np.vstack(parts) for body, parts in description.surfaces().items()}
    surfaces = {body: Surface(t) for body, t in triangles.items()}
    opens = {body: any(is_open(t) for t in parts) for body, parts in description.surfaces().items()}
    every = [ball for balls in hand.balls.values() for ball in balls]
    missed, worst = [], np.zeros(5)
    for body, balls in hand.balls.items():
        if body not in surfaces:
            continue
        low, high = triangles[body].min(axis=(0, 1)) - 0.02, triangles[body].max(axis=(0, 1)) + 0.02
        others = [s for other, s in surfaces.items() if other != body and
                  (s.t.min(axis=(0, 1)) < high).all() and (s.t.max(axis=(0, 1)) > low).all()]
        near = [(c, r) for c, r in every if (c + r > low).all() and (c - r < high).all()]
        out, _ = find_out(balls, hand.capsules.get(body, []), surfaces[body], others, opens[body])
        sink, n = find_sink(surfaces[body], others, np.array([c for c, _ in near]), np.array([r for _, r in near]),
                            random)
        is_tip = body in hand.tips
        guarded = sink if is_tip else sink[n @ hand.normal > 0.5]
        row = 1000 * np.array([*two(out), *two(sink), two(guarded)[1]])
        bars = 1000 * np.array([np.inf, OPEN_OUT if opens[body] else CLOSED_OUT, SINK_95, np.inf, SINK_MOST])
        fails = bool((row > bars).any())
        print(f"{name:16} {body:22} {len(balls):5d} {'open' if opens[body] else '':4} {'tip' if is_tip else '':3} "
              f"{row[0]:5.2f} {row[1]:5.2f}  {row[2]:5.2f} {row[3]:5.2f} {row[4]:5.2f} {len(sink):6d}"
              f"{'  MISSED' if fails else ''}", flush=True)
        missed += [body] if fails else []
        worst = np.maximum(worst, row)
    verdict = "met" if not missed else "MISSED by " + ", ".join(missed)
    return missed, (f"{len(hand.balls):5d} {len(every):6d} " + " ".join(f"{v:9.2f}" for v in worst[[1, 2, 3, 4]]) +
                    f" {'open' if any(opens.values()) else 'closed':>7}  {verdict}")


# ---- hands of known shapes ---------------------------------------------------------------------------


def revolve(profile, turns=48):
    """Around z; the profile (r, z) from below upwards, its outside to the right."""
    angle = np.linspace(0, 2 * np.pi, turns, endpoint=False)
    rings = [np.stack([r * np.cos(angle), r * np.sin(angle), np.full(turns, z)], 1) for r, z in profile]
    t = []
    for low, high in zip(rings, rings[1:]):
        for k in range(turns):
            a, b, c, d = low[k], low[(k + 1) % turns], high[(k + 1) % turns], high[k]
            t += [[a, b, c], [a, c, d]]
    t = np.array(t)
    return t[np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1) > 1e-14]


def ear_clip(polygon):
    """Corners of triangles; the polygon counter-clockwise."""
    left, triangles = list(range(len(polygon))), []
    cross = lambda a, b, c: (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    while len(left) > 3:
        for k in range(len(left)):
            i, j, l = left[k - 1], left[k], left[(k + 1) % len(left)]
            a, b, c = polygon[i], polygon[j], polygon[l]
            if cross(a, b, c) <= 1e-15:
                continue
            if any(min(cross(a, b, q), cross(b, c, q), cross(c, a, q)) >= 0
                   for m, q in enumerate(polygon) if m not in (i, j, l)):
                continue
            triangles.append((i, j, l))
            del left[k]
            break
        else:
            raise ValueError("no ear")
    return triangles + [tuple(left)]


def extrude(polygon, low, high, caps=(True, True)):
    """A polygon (u, v), counter-clockwise, along w from low to high."""
    bottom = np.array([[u, v, low] for u, v in polygon])
    top = np.array([[u, v, high] for u, v in polygon])
    t, count = [], len(polygon)
    for k in range(count):
        a, b, c, d = bottom[k], bottom[(k + 1) % count], top[(k + 1) % count], top[k]
        t += [[a, b, c], [a, c, d]]
    for i, j, k in ear_clip(polygon):
        t += [[bottom[i], bottom[k], bottom[j]]] if caps[0] else []
        t += [[top[i], top[j], top[k]]] if caps[1] else []
    return np.array(t)


def turn(t, order):
    """Axes in another order that keeps the handedness, e.g. (2, 0, 1): u of the polygon becomes y."""
    return t[:, :, list(order)]


def superellipsoid(a, b, c, e, rows=32):
    power = lambda x: np.sign(x) * np.abs(x) ** (2 / e)
    grid = lambda u, v: np.array([a * power(np.cos(u)) * power(np.cos(v)), b * power(np.cos(u)) * power(np.sin(v)),
                                  c * power(np.sin(u))])
    us, vs = np.linspace(-np.pi / 2, np.pi / 2, rows), np.linspace(0, 2 * np.pi, 2 * rows + 1)
    t = []
    for u0, u1 in zip(us, us[1:]):
        for v0, v1 in zip(vs, vs[1:]):
            q = [grid(u0, v0), grid(u0, v1), grid(u1, v1), grid(u1, v0)]
            t += [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
    t = np.array(t)
    return t[np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1) > 1e-14]


def arc(radius, start, end, count):
    return [(radius * np.cos(a), radius * np.sin(a)) for a in np.linspace(start, end, count)]


def make_palms():
    """About the origin, 90 mm along z, the palmar side to -y. [m]"""
    pi = np.pi
    along_x = lambda polygon, half: turn(extrude(polygon, -half, half), (2, 0, 1))  # polygon in (y, z)
    along_z = lambda polygon, half, caps=(True, True): extrude(polygon, -half, half, caps)  # in (x, y)
    comb = [(0.04, 0.015), (-0.04, 0.015)]
    for k in range(7):
        x = -0.04 + 0.01 * k
        comb += [(x, -0.015), (x + 0.006, -0.015), (x + 0.006, -0.006), (x + 0.01, -0.006)]
    comb += [(0.03, -0.015), (0.04, -0.015)]
    half_tube = arc(0.042, 0.0, pi, 33)
    sheet = [[(x, y, -0.045), (u, v, -0.045), (u, v, 0.045)] for (x, y), (u, v) in zip(half_tube, half_tube[1:])]
    sheet += [[(x, y, -0.045), (u, v, 0.045), (x, y, 0.045)] for (x, y), (u, v) in zip(half_tube, half_tube[1:])]
    bowl = arc(0.045, -pi / 2, 0, 17) + [(0.042, 0)] + arc(0.042, 0, -pi / 2, 17)
    wedge = extrude([(-0.04, -0.006), (0.04, -0.006), (0.04, 0.006), (-0.04, 0.006)], -0.045, 0.045)
    wedge[:, :, 1] *= (1.0 - wedge[:, :, 2] / 0.09)[:, :]  # 18 mm thick below, 6 mm above
    return {
        "soap": superellipsoid(0.04, 0.015, 0.045, 4),
        "ell": along_x([(-0.04, -0.045), (0.008, -0.045), (0.008, 0.045), (-0.004, 0.045), (-0.004, -0.033),
                        (-0.04, -0.033)], 0.035),
        "plate": along_z([(-0.042, -0.0015), (0.042, -0.0015), (0.042, 0.0015), (-0.042, 0.0015)], 0.045),
        "foil": along_z([(-0.03, -0.0005), (0.03, -0.0005), (0.03, 0.0005), (-0.03, 0.0005)], 0.045),
        "gutter": np.array(sheet) - np.array([0, 0.042, 0]),
        "bowl": turn(revolve(bowl), (2, 0, 1))[:, :, [1, 0, 2]][:, ::-1],
        "bottomless": along_z([(-0.04, -0.015), (0.04, -0.015), (0.04, 0.015), (-0.04, 0.015)], 0.045, (False, True)),
        "tray": along_z([(-0.04, -0.015), (-0.037, -0.015), (-0.037, 0.0), (0.037, 0.0), (0.037, -0.015),
                         (0.04, -0.015), (0.04, 0.003), (-0.04, 0.003)], 0.045),
        "comb": along_z(comb, 0.045),
        "pipe": revolve([(0.02, -0.045), (0.026, -0.045), (0.026, 0.045), (0.02, 0.045), (0.02, -0.045)]),
        "wedge": wedge,
        "star": along_z([(0.01 * (3.6 if k % 2 == 0 else 2) * np.cos(k * pi / 7),
                          0.01 * (3.6 if k % 2 == 0 else 2) * np.sin(k * pi / 7)) for k in range(14)], 0.045),
    }


def make_tips():
    """From z = 0 upwards, 34 mm long."""
    pi = np.pi
    along_x = lambda polygon, half: turn(extrude(polygon, -half, half), (2, 0, 1))
    hook = arc(0.02, 0.0, pi / 2, 13) + arc(0.009, pi / 2, 0.0, 13)
    return {
        "round": revolve([(0, 0), (0.008, 0), (0.008, 0.026)] + [
            (0.008 * np.cos(a), 0.026 + 0.008 * np.sin(a)) for a in np.linspace(0, pi / 2, 9)[1:]]),
        "wedge": along_x([(-0.008, 0), (0.008, 0), (0.0005, 0.034), (-0.0005, 0.034)], 0.009),
        "blade": along_x([(-0.00075, 0), (0.00075, 0), (0.00075, 0.034), (-0.00075, 0.034)], 0.009),
        "ell": along_x([(-0.014, 0.026), (0.004, 0.026), (0.004, 0), (0.012, 0), (0.012, 0.034), (-0.014, 0.034)], 0.008),
        "hook": along_x([(y - 0.0145, z + 0.0) for y, z in hook], 0.008),
        "thimble": revolve([(0.008, 0), (0.008, 0.026)] + [
            (0.008 * np.cos(a), 0.026 + 0.008 * np.sin(a)) for a in np.linspace(0, pi / 2, 9)[1:]]),
        "spoon": turn(revolve(arc(0.011, -pi / 2, 0, 11) + [(0.0095, 0)] + arc(0.0095, 0, -pi / 2, 11)),
                      (2, 0, 1))[:, :, [1, 0, 2]][:, ::-1] + np.array([0, 0, 0.022]),
        "pillow": superellipsoid(0.009, 0.007, 0.017, 3, 20) + np.array([0, 0, 0.017]),
    }


def volume(t):
    return np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6


def write_obj(file, t, unit):
    lines = [f"v {p[0] / unit:.9g} {p[1] / unit:.9g} {p[2] / unit:.9g}" for p in t.reshape(-1, 3)]
    lines += [f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}" for k in range(len(t))]
    file.write_text("\n".join(lines) + "\n")


def write_stl(file, t, unit):
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *(one / unit).ravel(), 0) for one in t)
    file.write_bytes(bytes(80) + struct.pack("<I", len(t)) + rows)


def write_hand(folder, palm_name, palm, tips, unit, mirrored, as_stl):
    """Three fingers at z = 45 mm that bend to -y, a thumb below them that bends to them."""
    folder.mkdir(parents=True, exist_ok=True)
    write = write_stl if as_stl else write_obj
    ending = "stl" if as_stl else "obj"
    scale = unit * np.array([-1.0 if mirrored else 1.0, 1, 1])

    def mesh(name, t):
        if mirrored:  # as a left hand's file stands for a right one
            t = (t * np.array([-1, 1, 1]))[:, ::-1]
        write(folder / f"{name}.{ending}", t, unit)
        geometry = f'<geometry><mesh filename="{name}.{ending}" scale="{scale[0]} {scale[1]} {scale[2]}"/></geometry>'
        return f"<visual>{geometry}</visual><collision>{geometry}</collision>"

    def inertia(mass, size, z):
        ixx, iyy, izz = (mass / 12 * (s**2 + t**2) for s, t in
                         ((size[1], size[2]), (size[0], size[2]), (size[0], size[1])))
        return (f'<inertial><origin xyz="0 0 {z}"/><mass value="{mass}"/><inertia ixx="{ixx:.6g}" iyy="{iyy:.6g}" '
                f'izz="{izz:.6g}" ixy="0" ixz="0" iyz="0"/></inertial>')

    y = 0.5 * (palm[:, :, 1][palm[:, :, 2] > 0.04].min() + palm[:, :, 1][palm[:, :, 2] > 0.04].max())
    text = [f'<robot name="{palm_name}">', f'<link name="palm">{inertia(0.3, (0.08, 0.03, 0.09), 0)}'
            f'{mesh("palm", palm)}</link>']
    segment = turn(extrude([(-0.007, 0), (0.007, 0), (0.006, 0.038), (-0.006, 0.038)], -0.008, 0.008), (2, 0, 1))
    bases = [("f1", f"-0.025 {y:.6g} 0.045", "0 0 0", 1), ("f2", f"0 {y:.6g} 0.045", "0 0 0", 1),
             ("f3", f"0.025 {y:.6g} 0.045", "0 0 0", 1), ("t", f"0 {palm[:, :, 1].min() - 0.012:.6g} 0", "1.2 0 0", -1)]
    for (digit, xyz, angles, sign), tip in zip(bases, tips):
        tip_mesh = make_tips()[tip]
        if sign < 0:  # the thumb's pad faces the fingers
            tip_mesh = tip_mesh * np.array([-1, -1, 1])
        text += [
            f'<link name="{digit}_1">{inertia(0.03, (0.016, 0.014, 0.04), 0.02)}{mesh("segment", segment)}</link>',
            f'<link name="{digit}_2">{inertia(0.02, (0.016, 0.014, 0.034), 0.017)}{mesh(digit + "_" + tip, tip_mesh)}'
            '</link>']
        for parent, child, p, a in (("palm", f"{digit}_1", xyz, angles), (f"{digit}_1", f"{digit}_2", "0 0 0.04", "0 0 0")):
            text.append(f'<joint name="{child}" type="revolute"><origin xyz="{p}" rpy="{a}"/><parent link="{parent}"/>'
                        f'<child link="{child}"/><axis xyz="{sign} 0 0"/>'
                        '<limit lower="0" upper="1.5" effort="1" velocity="3"/></joint>')
    (folder / "made.urdf").write_text("\n".join(text) + "\n</robot>\n")
    return folder / "made.urdf"


def make_hands(folder):
    tips = list(make_tips())
    files = {}
    for k, (name, palm) in enumerate(make_palms().items()):
        unit = [1.0, 0.001, 0.0254][k % 3]
        own = [tips[(k + j) % len(tips)] for j in range(4)]
        files[name] = write_hand(folder / name, name, palm, own, unit, k % 4 == 3, k % 2 == 1)
    return files


def find_descriptions():
    """Hands by others, where this machine has them; not those that the import must refuse."""
    data = pathlib.Path(os.environ.get("GRASPBENCH_DATA", pathlib.Path(__file__).parents[3] / "shared" / "data"))
    files = {file.relative_to(data / "hands").parts[0]: file for file in sorted((data / "hands").rglob("*.urdf"))}
    files.update({file.stem: file for file in sorted((data / "strangers" / "hands").glob("*.urdf"))
                  if all((file.parent / mesh.get("filename")).exists() for mesh in ET.parse(file).iter("mesh"))})
    return files


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    files = make_hands(folder)
    files.update({pathlib.Path(given).stem: pathlib.Path(given) for given in sys.argv[3:]} or find_descriptions())
    print("hand             link                   balls           out [mm]     sink [mm]  guarded  points")
    table, num_missed = [], 0
    for name, file in files.items():
        out = folder / "imported" / name
        subprocess.run(["rm", "-rf", str(out)], check=True)
        done = subprocess.run([program, "hand", "import", str(file), "--out", str(out)], capture_output=True, text=True)
        missed, line = measure(name, file, out) if done.returncode == 0 else (["import"], done.stderr.strip())
        num_missed += bool(missed)
        table.append(f"{name:16} {line}")
    print("\nthe worst link of each hand [mm]: sticks out (bar 1, open meshes 3), sinks in at 95 of 100 points (1),"
          "\nat most, and at most on the palmar side and tips (5)"
          "\nhand             links  balls       out   sink 95 sink most   guarded  meshes  bars")
    print("\n".join(table))
    print(f"bars met by {len(files) - num_missed} of {len(files)} hands")
    sys.exit(1 if num_missed else 0)


if __name__ == "__main__":
    main()
