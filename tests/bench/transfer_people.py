#!/usr/bin/env python3
"""People whose contacts are known, and whether robot hands can reach them: an oracle for graspbench transfer.

  transfer_people.py people FOLDER [--persons 4] [--same HAND]   writes a study of 21 landmarks a hand
  transfer_people.py judge FOLDER SESSION [HAND=FOLDER ..]       compares graspbench transfer with it
  transfer_people.py wrong FOLDER OUT                            writes the first person's cylinder in 14 wrong ways

Nothing here is shared with core/transfer: hands are read from hand.urdf and hand.yaml, and postures come
from a damped Gauss-Newton search from many random starts. --same: the person's hand is the robot's own,
so that its joints are known. Not looked at: links inside each other.
"""
import json
import pathlib
import sys
import xml.etree.ElementTree as ET

import numpy as np
import yaml

MODELS = pathlib.Path(__file__).resolve().parents[2] / "core/hand/models"
DIGITS = ["TH", "FF", "MF", "RF", "LF"]
NAMES = ["thumb", "index", "middle", "ring", "little"]
JOINTS = {"thumb": ["cmc", "mcp", "ip"]}
OTHER_JOINTS = ["mcp", "pip", "dip"]
REACHED_M = 0.003


def rotate(axis, angle):
    """Rodrigues; angle of any shape."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    s, c = np.sin(angle)[..., None, None], np.cos(angle)[..., None, None]
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def rotate_vector(w):
    """Rotation vectors (n, 3)."""
    angle = np.linalg.norm(w, axis=-1)
    x, y, z = np.moveaxis(w / np.maximum(angle, 1e-12)[:, None], -1, 0)
    zero = 0 * x
    k = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], -1).reshape(-1, 3, 3)
    s, c = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def rpy(r, p, y):
    return rotate((0, 0, 1), np.array(y)) @ rotate((0, 1, 0), np.array(p)) @ rotate((1, 0, 0), np.array(r))


class Chain:
    """Links with a parent, a fixed frame in it and perhaps a joint; balls on the links; pads of digits."""

    def __init__(self):
        self.links, self.index, self.joints, self.balls, self.pads = [], {}, [], [], {}
        self.follows = {}  # joint: (leader, ratio)

    def add_link(self, name, parent, p, R=np.eye(3), joint=None, axis=None, low=0.0, high=0.0):
        number = None
        if joint is not None:
            number = len(self.joints)
            self.joints.append((joint, low, high))
        self.index[name] = len(self.links)
        self.links.append((self.index.get(parent, -1), np.array(p, float), R, number, axis))

    def add_ball(self, link, p, radius):
        self.balls.append((self.index[link], np.array(p, float), radius))

    def joint(self, name):
        return [joint[0] for joint in self.joints].index(name)

    def settle(self, palm):
        """Which joints are free; where the palm's middle is, behind which the hand starts."""
        self.low = np.array([joint[1] for joint in self.joints])
        self.high = np.array([joint[2] for joint in self.joints])
        self.free = [j for j, joint in enumerate(self.joints) if joint[0] not in self.follows and not joint[0].startswith("WRJ")]
        self.palm = np.array(palm, float)

    def fill(self, x):
        """Joints of the free ones (n, free)."""
        q = np.zeros((len(x), len(self.joints)))
        q[:, self.free] = x
        for joint, (leader, ratio) in self.follows.items():
            q[:, self.joint(joint)] = ratio * q[:, self.joint(leader)]
        return np.clip(q, self.low, self.high)

    def poses(self, q):
        R, p = [], []
        for parent, origin, turn, number, axis in self.links:
            own = turn if number is None else turn @ rotate(axis, q[:, number])
            own = np.broadcast_to(own, (len(q), 3, 3))
            if parent < 0:
                R.append(own)
                p.append(np.broadcast_to(origin, (len(q), 3)))
            else:
                R.append(R[parent] @ own)
                p.append(p[parent] + R[parent] @ origin)
        return R, p

    def pad(self, digit, poses):
        """Place, direction out of the pad, direction to the tip."""
        link, pad, tip = self.pads[digit]
        R, p = poses[0][link], poses[1][link]
        axis = tip / np.linalg.norm(tip)
        out = pad - pad.dot(axis) * axis
        return p + R @ pad, R @ (out / np.linalg.norm(out)), R @ axis


def load_robot(name):
    folder = pathlib.Path(name) if "/" in name else MODELS / name
    root = ET.parse(folder / "hand.urdf").getroot()
    facts = yaml.safe_load((folder / "hand.yaml").read_text())
    numbers = lambda text: [float(value) for value in text.split()]
    joints = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
    links = {link.get("name"): link for link in root.findall("link")}
    chain, todo = Chain(), [name for name in links if name not in joints]
    while todo:
        link = todo.pop(0)
        joint = joints.get(link)
        if joint is None:
            chain.add_link(link, "", [0, 0, 0])
        else:
            origin = joint.find("origin")
            place = numbers(origin.get("xyz", "0 0 0")) if origin is not None else [0, 0, 0]
            turn = rpy(*numbers(origin.get("rpy", "0 0 0"))) if origin is not None else np.eye(3)
            moves = joint.get("type") != "fixed"
            limit = joint.find("limit")
            axis = numbers(joint.find("axis").get("xyz")) if moves else None
            bounds = (float(limit.get("lower")), float(limit.get("upper"))) if moves else (0, 0)
            chain.add_link(link, joint.find("parent").get("link"), place, turn, joint.get("name") if moves else None, axis, *bounds)
        todo += [child for child, own in joints.items() if own.find("parent").get("link") == link]
        for shape in links[link].findall("collision"):
            add_balls(chain, link, shape, numbers)
    coupling = facts.get("coupling", {})
    ratio = {"even": 1.0, "middle-first": 0.0, "fixed": coupling.get("fixed_ratio", 1.0)}[coupling.get("rule", "even")]
    chain.follows = {joint: (leader, ratio) for joint, leader in coupling.get("joints", {}).items()}
    for digit in facts["digits"]:
        last = chain.index[digit["links"][-1]]
        chain.pads[digit["id"]] = (last, np.array(digit["pad_m"]), np.array(digit["tip_m"]))
    chain.digits = [digit["id"] for digit in facts["digits"]]
    chain.settle(palm_in_root(chain, facts["palm"]))
    chain.facts = facts
    return chain


def palm_in_root(chain, palm):
    R, p = chain.poses(np.zeros((1, len(chain.joints))))
    link = chain.index[palm["link"]]
    return p[link][0] + R[link][0] @ np.array(palm["centre_m"], float)


def add_balls(chain, link, shape, numbers):
    origin = shape.find("origin")
    place = np.array(numbers(origin.get("xyz", "0 0 0"))) if origin is not None else np.zeros(3)
    turn = rpy(*numbers(origin.get("rpy", "0 0 0"))) if origin is not None else np.eye(3)
    solid = list(shape.find("geometry"))[0]
    if solid.tag == "sphere":
        chain.add_ball(link, place, float(solid.get("radius")))
    elif solid.tag in ("cylinder", "capsule"):
        radius, length = float(solid.get("radius")), float(solid.get("length"))
        half = max(0.0, 0.5 * length - radius)
        for z in np.linspace(-half, half, 4):
            chain.add_ball(link, place + turn @ np.array([0, 0, z]), radius)
    elif solid.tag == "box":
        size = np.array(numbers(solid.get("size")))
        radius = 0.5 * size.min()
        steps = [np.linspace(-0.5 * s + radius, 0.5 * s - radius, 4 if s > 2 * radius else 1) for s in size]
        for x in steps[0]:
            for y in steps[1]:
                for z in steps[2]:
                    chain.add_ball(link, place + turn @ np.array([x, y, z]), radius)


def make_person(scale, flesh, share):
    """Joint centres and bones of an adult's right hand, times scale; z to the fingers, -y out of the palm, +x to the
    thumb. flesh: from the bone to the skin of a pad. share: of the last phalanx between pad and tip."""
    chain, deg = Chain(), np.pi / 180
    chain.add_link("palm", "", [0, 0, 0])
    knuckles = {"FF": (26, 0, 88), "MF": (4, 2, 90), "RF": (-16, 0, 84), "LF": (-34, -4, 75)}
    bones = {"FF": (43, 25, 22), "MF": (48, 29, 23), "RF": (44, 28, 23), "LF": (35, 20, 20), "TH": (45, 33, 27)}
    for digit, knuckle in knuckles.items():
        a, b, c = [1e-3 * scale * bone for bone in bones[digit]]
        chain.add_link(digit + "0", "palm", 1e-3 * scale * np.array(knuckle), np.eye(3), digit + "abduction", (0, 1, 0), -20 * deg, 20 * deg)
        chain.add_link(digit + "1", digit + "0", [0, 0, 0], np.eye(3), digit + "mcp", (1, 0, 0), -20 * deg, 90 * deg)
        chain.add_link(digit + "2", digit + "1", [0, 0, a], np.eye(3), digit + "pip", (1, 0, 0), 0, 100 * deg)
        chain.add_link(digit + "3", digit + "2", [0, 0, b], np.eye(3), digit + "dip", (1, 0, 0), 0, 70 * deg)
        chain.follows[digit + "dip"] = (digit + "pip", 0.6)
        chain.pads[digit] = (chain.index[digit + "3"], np.array([0, -flesh, (1 - share) * c]), np.array([0, 0, c]))
        for link, length in zip("123", (a, b, c)):
            for z in np.linspace(0, length - (flesh if link == "3" else 0), 4):
                chain.add_ball(digit + link, [0, 0, z], flesh)
    a, b, c = [1e-3 * scale * bone for bone in bones["TH"]]
    base = 1e-3 * scale * np.array([22, -10, 20])
    chain.add_link("TH0", "palm", base, rpy(-40 * deg, 0, -80 * deg), "THopposition", (0, 0, -1), -60 * deg, 60 * deg)
    chain.add_link("TH1", "TH0", [0, 0, 0], np.eye(3), "THabduction", (0, 1, 0), 0, 65 * deg)
    chain.add_link("TH2", "TH1", [0, 0, a], np.eye(3), "THmcp", (1, 0, 0), -20 * deg, 60 * deg)
    chain.add_link("TH3", "TH2", [0, 0, b], np.eye(3), "THip", (1, 0, 0), -15 * deg, 80 * deg)
    chain.pads["TH"] = (chain.index["TH3"], np.array([0, -flesh, (1 - share) * c]), np.array([0, 0, c]))
    for link, length in zip("123", (a, b, c)):
        for z in np.linspace(0, length - (flesh if link == "3" else 0), 4):
            chain.add_ball("TH" + link, [0, 0, z], flesh)
    for x in (0.02, -0.005, -0.03):
        for z in (0.02, 0.05, 0.075):
            chain.add_ball("palm", scale * np.array([x, 0.004, z]), 0.012 * scale)
    chain.digits = DIGITS
    chain.settle(scale * np.array([0, 0, 0.05]))
    return chain


class Solid:
    def __init__(self, shape, size):
        self.shape, self.size = shape, np.array(size, float)

    def distance(self, p):
        half = 0.5 * self.size
        if self.shape == "sphere":
            return np.linalg.norm(p, axis=-1) - half[0]
        if self.shape == "cylinder":
            d = np.stack([np.linalg.norm(p[..., :2], axis=-1) - half[0], np.abs(p[..., 2]) - half[2]], -1)
        else:
            d = np.abs(p) - half
        return np.minimum(d.max(-1), 0) + np.linalg.norm(np.maximum(d, 0), axis=-1)

    def normal(self, p, step=1e-5):
        grad = [self.distance(p + step * e) - self.distance(p - step * e) for e in np.eye(3)]
        grad = np.stack(grad, -1)
        return grad / np.linalg.norm(grad, axis=-1, keepdims=True)

    def project(self, p):
        for _ in range(20):
            p = p - self.distance(p)[..., None] * self.normal(p)
        return p


def search(chain, solid, goals, rng, starts=48, steps=40, palm=None):
    """goals: {digit: place}. Gauss-Newton from random postures and turns. The best posture by its largest pad distance
    among those whose links stay out of object and table; None: there is none."""
    digits = list(goals)
    target = np.array([goals[digit] for digit in digits])
    inwards = -solid.normal(target)
    middle = target.mean(0)
    low, high = chain.low[chain.free], chain.high[chain.free]
    n = len(low)
    tips = {chain.pads[digit][0] for digit in digits}
    ball_link = np.array([ball[0] for ball in chain.balls])
    ball_p = np.array([ball[1] for ball in chain.balls])
    ball_r = np.array([ball[2] for ball in chain.balls])
    sink = np.where([link in tips for link in ball_link], 0.002, 0.0)

    def frames(x):
        R, p = chain.poses(chain.fill(x[:, :n]))
        turn = rotate_vector(x[:, n:n + 3])
        return [turn @ own for own in R], [(turn @ own[..., None])[..., 0] + x[:, n + 3:] for own in p]

    def parts(x):
        R, p = frames(x)
        pads = [chain.pad(digit, (R, p)) for digit in digits]
        place = np.stack([pad[0] for pad in pads], 1)
        out = np.stack([pad[1] for pad in pads], 1)
        centres = np.stack([p[link] + R[link] @ own for link, own in zip(ball_link, ball_p)], 1)
        inside = ball_r - sink - solid.distance(centres)
        below = ball_r - (centres[..., 2] + 0.5 * solid.size[2])
        return place, out, inside, below, p

    def residuals(x):
        place, out, inside, below, p = parts(x)
        facing = (out * inwards).sum(-1)
        rows = [((place - target) / 0.001).reshape(len(x), -1), np.maximum(0, 0.5 - facing) / 0.1,
                np.maximum(0, inside) / 0.001, np.maximum(0, below) / 0.001,
                0.05 * (x[:, :n] - 0.5 * (low + high)) / (high - low)]
        if palm is not None:
            to = np.stack(p, 1)[:, 0] - middle
            rows.append(((to / np.linalg.norm(to, axis=-1, keepdims=True)) - palm) / 0.3)
        return np.concatenate(rows, 1)

    # The best of many random postures, each turned and shifted onto the contacts (Kabsch).
    x = np.zeros((40 * starts, n + 6))
    x[:, :n] = low + (high - low) * rng.uniform(0.0, 0.8, (len(x), n))
    place = parts(x)[0]
    weights = rng.uniform(0.3, 1.0, (len(x), len(digits), 1))  # another turn each, of two pads too
    own = weights * (place - place.mean(1, keepdims=True)) + rng.normal(0, 0.01, place.shape)
    U, _, Vt = np.linalg.svd(own.transpose(0, 2, 1) @ (target - middle))
    U[:, :, 2] *= np.sign(np.linalg.det(U @ Vt))[:, None]
    R = (U @ Vt).transpose(0, 2, 1)
    angle = np.arccos(np.clip((np.einsum("nii->n", R) - 1) / 2, -1, 1))
    skew = np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], -1)
    x[:, n:n + 3] = skew / np.maximum(np.linalg.norm(skew, axis=-1), 1e-9)[:, None] * angle[:, None]
    place = parts(x)[0]
    x[:, n + 3:] = middle - place.mean(1)
    r = residuals(x)
    x = x[np.argsort((r * r).sum(1))[:starts]]
    damping = np.full(starts, 1.0)
    r = residuals(x)
    cost = (r * r).sum(1)
    for _ in range(steps):
        step = 1e-6
        bent = np.repeat(x, n + 6, 0) + step * np.tile(np.eye(n + 6), (starts, 1))
        J = (residuals(bent).reshape(starts, n + 6, -1) - r[:, None]) / step
        H = J @ J.transpose(0, 2, 1)
        g = (J @ r[..., None])[..., 0]
        scale = np.einsum("nii->ni", H)
        move = np.linalg.solve(H + np.einsum("ni,ij->nij", damping[:, None] * scale + 1e-9, np.eye(n + 6)), -g[..., None])[..., 0]
        new = x + move
        new[:, :n] = np.clip(new[:, :n], low, high)
        new_r = residuals(new)
        new_cost = (new_r * new_r).sum(1)
        better = new_cost < cost
        x[better], r[better], cost[better] = new[better], new_r[better], new_cost[better]
        damping = np.where(better, damping / 3, damping * 4).clip(1e-6, 1e6)
    place, out, inside, below, _ = parts(x)
    miss = np.linalg.norm(place - target, axis=-1).max(1)
    free = (inside.max(1) < 0.0015) & (below.max(1) < 0.0015) & (((out * inwards).sum(-1)).min(1) > 0.3)
    if not free.any():
        return None
    best = np.argmin(np.where(free, miss, np.inf))
    return {"miss": miss[best], "q": chain.fill(x[best:best + 1, :n])[0], "frames": [f[0] for f in frames(x[best:best + 1])[0]],
            "places": [f[0] for f in frames(x[best:best + 1])[1]]}


OBJECTS = [("cylinder_45mm", "cylinder", (0.045, 0.045, 0.11)), ("cylinder_60mm", "cylinder", (0.06, 0.06, 0.11)),
           ("cylinder_75mm", "cylinder", (0.075, 0.075, 0.11)), ("box_50mm", "box", (0.05, 0.09, 0.11)),
           ("sphere_70mm", "sphere", (0.07, 0.07, 0.07))]
RATE, NOISE_M, MARKERS = 100.0, 0.0005, 3


def draw_contacts(solid, scale, rng):
    """Thumb on one side, fingers in a row on the other, of a right hand that comes along +y; places in O."""
    spread = scale * rng.uniform(0.017, 0.021)
    height = rng.uniform(-0.005, 0.015)
    if solid.shape == "sphere":
        spread, height = 0.8 * spread, 0.1 * height
    turn = rng.uniform(-0.25, 0.25)
    rough = {"TH": (-1.0, rng.uniform(-0.006, 0.006), height)}
    for k, digit in enumerate(DIGITS[1:]):
        rough[digit] = (1.0, 0.004 * (1.5 - abs(k - 1.5)) + rng.uniform(-0.003, 0.003), height + spread * (1.5 - k))
    c, s = np.cos(turn), np.sin(turn)
    side = 0.5 * solid.size[0] + 0.002
    return {d: solid.project(np.array([c * x * side - s * y, s * x * side + c * y, z])) for d, (x, y, z) in rough.items()}


def landmarks(chain, found):
    """{label: place in O} of wrist, three joints a digit, tips."""
    places = {"wrist": found["places"][0]}
    for digit, name in zip(DIGITS, NAMES):
        if digit not in chain.pads:
            continue
        last, _, tip = chain.pads[digit]
        origins, link = [], last
        while link > 0 and len(origins) < 3:
            place = found["places"][link]
            if not origins or np.linalg.norm(place - origins[0]) > 1e-6:
                origins.insert(0, place)
            link = chain.links[link][0]
        for joint, place in zip(JOINTS.get(name, OTHER_JOINTS), origins):
            places[name + "_" + joint] = place
        places[name + "_tip"] = found["places"][last] + found["frames"][last] @ tip
    return places


def min_jerk(t):
    t = np.clip(t, 0, 1)
    return t ** 3 * (10 - 15 * t + 6 * t * t)


def record(places, solid, rng):
    """A reach: rest, the hand comes, opens and closes, digits touch, the object is lifted. {label: (n, 3)}."""
    times = np.arange(0, 2.4, 1 / RATE)
    p_WO = np.array([0.3, 0.4, 0.5 * solid.size[2]]) + rng.uniform(-0.02, 0.02, 3) * [1, 1, 0]
    touch = {name: 1.15 + rng.uniform(0, 0.03) for name in NAMES}
    lift = np.outer(min_jerk((times - 1.4) / 0.7), [0, 0, 0.15])
    hand = np.outer(1 - min_jerk((times - 0.3) / 0.75), [0.02, -0.28, 0.06])
    table = {}
    for label, place in places.items():
        name, _, joint = label.partition("_")
        moved = p_WO + place + lift + hand
        if joint:
            share = {"tip": 1.0, "dip": 0.75, "ip": 0.75, "pip": 0.4}.get(joint, 0.1)
            outwards = solid.normal(places[name + "_tip"])
            outwards[2] = 0
            rising = min_jerk((times - 0.3) / 0.45)
            closing = np.clip((times - 0.75) / (touch[name] - 0.75), 0, 1)
            moved = moved + share * np.outer(rising * (1 - closing ** 2) * 0.03, outwards)
        table[label] = moved
    half = 0.5 * solid.size
    for k, corner in enumerate([(0.6, 0.3), (-0.6, 0.3), (0.0, -0.7)]):
        table["object_%d" % (k + 1)] = p_WO + half * [corner[0], corner[1], 1.0] + lift
    return times, {label: values + rng.normal(0, NOISE_M, values.shape) for label, values in table.items()}


def write_study(folder, persons, same):
    folder = pathlib.Path(folder)
    (folder / "recordings").mkdir(parents=True)
    rows, truth = ["participant,trial,file,object,hand"], []
    for person in range(1, persons + 1):
        rng = np.random.default_rng(person)
        scale = 1.0 if same else rng.uniform(0.9, 1.08)
        chain = load_robot(same) if same else make_person(scale, rng.uniform(0.0065, 0.0085), rng.uniform(0.33, 0.47))
        for name, shape, size in OBJECTS:
            solid = Solid(shape, size)
            found = None
            for _ in range(6):
                contacts = draw_contacts(solid, scale, rng)
                contacts = {digit: place for digit, place in contacts.items() if digit in chain.pads}
                found = search(chain, solid, contacts, rng, palm=np.array([0.3, -0.85, 0.43]))
                if found and found["miss"] < 0.0015:
                    break
            if not found or found["miss"] >= 0.0015:
                continue
            places = landmarks(chain, found)
            times, table = record(places, solid, rng)
            file = "recordings/p%02d_%s.csv" % (person, name)
            with open(folder / file, "w") as out:
                out.write("time_s," + ",".join("%s_%s_m" % (label, axis) for label in table for axis in "xyz") + "\n")
                for i, time in enumerate(times):
                    out.write("%.3f," % time + ",".join("%.6f" % v for label in table for v in table[label][i]) + "\n")
            rows.append("p%02d,%d,%s,%s,right" % (person, len(truth) + 1, file, name))
            truth.append({"participant": "p%02d" % person, "object": name, "contacts": {d: list(p) for d, p in contacts.items()},
                          "palm": list((found["places"][0]) - np.mean(list(contacts.values()), 0)),
                          "q": dict(zip([j[0] for j in chain.joints], found["q"])) if same else {}})
            labels = list(table)
    (folder / "trials.csv").write_text("\n".join(rows) + "\n")
    (folder / "truth.json").write_text(json.dumps(truth, indent=1))
    objects = ["object,shape,length_m,width_m,height_m,centre_x_m,centre_y_m,centre_z_m"]
    for name, shape, size in OBJECTS:
        centre = -0.5 * np.array(size) * [0, -0.1 / 3, 1]
        objects.append(",".join([name, shape, *("%g" % s for s in size), *("%.6f" % c for c in centre)]))
    (folder / "objects.csv").write_text("\n".join(objects) + "\n")
    points = "".join("  %s: [%s]\n" % (label, ", ".join("%s_%s_m" % (label, axis) for axis in "xyz")) for label in labels)
    (folder / "columns.yaml").write_text("unit: m\ntime: time_s\ntime_unit: s\npoints:\n" + points)
    digits = [name for name in NAMES if name + "_tip" in labels]
    tips = "".join("  %s: %s_tip\n" % (name, name) for name in digits)
    joints = "".join("    %s: [%s]\n" % (name, ", ".join(name + "_" + j for j in JOINTS.get(name, OTHER_JOINTS))) for name in digits)
    (folder / "study.yaml").write_text("name: People whose contacts are known\nobjects: objects.csv\nrecording: {mapping: columns.yaml}\n"
                                       "markers:\n" + tips + "  wrist: wrist\n  object: [object_1, object_2, object_3]\n  joints:\n" + joints)
    print("%d grasps of %d persons in %s" % (len(truth), persons, folder))


def make_goals(chain, contacts, solid, stands_for):
    """Where a robot's pads are to be: at the true contact of the digit that each stands for, or at the projected mean
    of several. stands_for: {digit: "MF+RF"}, of the program, whose order of fingers is free on hands with two."""
    return {digit: solid.project(np.mean([contacts[one] for one in people.split("+")], 0)) for digit, people in stands_for.items()}


def place_grasp(chain, file, height):
    """Pads of a grasp file at contact, in O, and its joints."""
    grasp = yaml.safe_load(pathlib.Path(file).read_text())
    placement = grasp["placement"]
    x = np.zeros((1, len(chain.joints)))
    for digit in chain.facts["digits"]:
        links = [chain.links[chain.index[link]] for link in digit["links"]]
        names = [chain.joints[link[3]][0] for link in links if link[3] is not None and chain.joints[link[3]][0] not in chain.follows]
        pre, target = np.array(grasp["pre_deg"][digit["id"]]), np.array(grasp["target_deg"][digit["id"]])
        for name, angle in zip(names, np.radians(pre + placement["closing_at_contact"] * (target - pre))):
            x[0, chain.joint(name)] = angle
    q = chain.fill(x[:, chain.free])
    w, v = placement["orientation_wxyz"][0], np.array(placement["orientation_wxyz"][1:])
    skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    R_WH = np.eye(3) + 2 * w * skew + 2 * skew @ skew
    R, p = chain.poses(q)
    p_H = p[chain.index[chain.facts["palm"]["link"]]][0]  # of the root: H is the palm's frame at zero
    p_OH = np.array(placement["position_m"]) - [0, 0, 0.5 * height]
    pads = {digit: p_OH + R_WH @ (chain.pad(digit, (R, p))[0][0] - p_H) for digit in grasp["digits"]}
    return pads, q[0]


def judge(folder, session, models):
    folder, session = pathlib.Path(folder), pathlib.Path(session)
    truth = json.loads((folder / "truth.json").read_text())
    solids = {name: Solid(shape, size) for name, shape, size in OBJECTS}
    rows = json.loads((session / "inputs/grasps/transfer.json").read_text())["rows"]
    files = {}
    for file in (session / "inputs/grasps").glob("*.yaml"):
        grasp = yaml.safe_load(file.read_text())
        files[grasp["hand"], grasp.get("object"), grasp["id"]] = file
    for hand in dict.fromkeys(row["hand"] for row in rows):
        chain = load_robot(models.get(hand, hand))
        reachable = reached = transferred = own = both = 0
        errors, angles, lost = [], [], []
        for row in [row for row in rows if row["hand"] == hand]:
            known = next((t for t in truth if (t["participant"], t["object"]) == (row["participant"], row["object"])), None)
            if known is None:
                continue
            solid = solids[row["object"]]
            contacts = {digit: np.array(place) for digit, place in known["contacts"].items()}
            if not row["pads"]:
                continue
            goals = make_goals(chain, contacts, solid, {pad["digit"]: pad["person"] for pad in row["pads"]})
            found = search(chain, solid, goals, np.random.default_rng(7))
            is_reachable = found is not None and found["miss"] <= REACHED_M
            done = not row["not_transferable"]
            pads = row["pads"]
            near = len(pads) == len(goals) and all(pad["is_reached"] and pad["distance_m"] <= REACHED_M for pad in pads)
            reachable += is_reachable
            reached += is_reachable and near
            both += is_reachable and done
            transferred += done
            own += near and not is_reachable
            if is_reachable and not (near and done):
                lost.append("%s %s: %s" % (row["participant"], row["object"], row["not_transferable"] or [round(1e3 * p["distance_m"], 1) for p in pads]))
            if not done:
                continue
            places, q = place_grasp(chain, files[hand, row["object"], row["grasp"]], solid.size[2])
            errors += [np.linalg.norm(places[d] - goals[d]) for d in places if d in goals]
            moved = [j for j in chain.free if known["q"] and any(chain.joints[j][0].startswith(d) for d in places)]
            angles += [abs(q[j] - known["q"][chain.joints[j][0]]) for j in moved if chain.joints[j][0] in known["q"]]
        print("%s: %d grasps, %d reachable by the oracle; of these all pads within 3 mm %d, transferred %d; transferred in all %d, "
              "within 3 mm and not found by the oracle %d" % (hand, len([r for r in rows if r["hand"] == hand]), reachable, reached, both, transferred, own))
        if errors:
            print("  pads from the true contacts: median %.1f mm, largest %.1f mm" % (1e3 * np.median(errors), 1e3 * max(errors)))
        if angles:
            print("  joints from the person's: median %.1f deg, 90 %% below %.1f deg" % (np.degrees(np.median(angles)), np.degrees(np.quantile(angles, 0.9))))
        for text in lost:
            print("  not: " + text)


def write_wrong(folder, out):
    """One study for each: the same recording mirrored, in another unit, with the object's pose missing or of another
    trial, with digits exchanged, as another object, as the other hand."""
    folder, out = pathlib.Path(folder), pathlib.Path(out)

    def read(file):
        lines = (folder / file).read_text().split("\n")[:-1]
        return lines[0].split(","), np.array([[float(v) for v in line.split(",")] for line in lines[1:]])

    heads, right = read("recordings/p01_cylinder_60mm.csv")
    other = read("recordings/p01_box_50mm.csv")[1]
    of_object = np.array([head.startswith("object") for head in heads])
    is_place = np.array([head != "time_s" for head in heads])
    is_x = np.array([head.endswith("_x_m") for head in heads])

    def scale(columns, factor):
        return np.where(columns, factor * right, right)

    def exchange(pairs):
        table = right.copy()
        for a, b in pairs:
            for axis in "xyz":
                i, j = (heads.index("%s_%s_m" % (name, axis)) for name in (a, b))
                table[:, [i, j]] = table[:, [j, i]]
        return table

    def swap(a, b):
        return exchange([(a + "_" + joint, b + "_" + joint) for joint in [*OTHER_JOINTS, "tip"]])

    thumb = [("thumb_tip", "index_tip"), ("thumb_ip", "index_dip"), ("thumb_mcp", "index_pip"), ("thumb_cmc", "index_mcp")]
    cases = {
        "mirrored": (scale(is_x, -1), "right", ""), "mirrored_unstated": (scale(is_x, -1), "", ""), "left": (scale(is_x, -1), "left", ""),
        "times_1000": (scale(is_place, 1000), "right", ""), "times_10": (scale(is_place, 10), "right", ""),
        "tenth": (scale(is_place, 0.1), "right", ""), "hand_times_1000": (scale(is_place & ~of_object, 1000), "right", ""),
        "no_object": (right, "right", "no_object"), "other_pose": (np.where(of_object, other, right), "right", ""),
        "shifted_pose": (right + 0.02 * (of_object & is_x), "right", ""), "index_little": (swap("index", "little"), "right", ""),
        "index_middle": (swap("index", "middle"), "right", ""), "thumb_index": (exchange(thumb), "right", ""),
        "other_object": (right, "right", "cylinder_75mm")}
    for name, (table, hand, what) in cases.items():
        own = out / name
        own.mkdir(parents=True)
        for file in ("objects.csv", "columns.yaml", "study.yaml"):
            (own / file).write_text((folder / file).read_text())
        if what == "no_object":
            text = (own / "study.yaml").read_text()
            (own / "study.yaml").write_text(text.replace("  object: [object_1, object_2, object_3]\n", ""))
        (own / "reach.csv").write_text("\n".join([",".join(heads), *(",".join("%.6f" % v for v in row) for row in table)]) + "\n")
        known = what if what.startswith("cylinder") else "cylinder_60mm"
        (own / "trials.csv").write_text("participant,trial,file,object%s\np01,1,reach.csv,%s%s\n"
                                        % (",hand" if hand else "", known, "," + hand if hand else ""))


if __name__ == "__main__":
    if sys.argv[1] == "wrong":
        write_wrong(sys.argv[2], sys.argv[3])
    elif sys.argv[1] == "people":
        arguments = dict(zip(sys.argv[3::2], sys.argv[4::2]))
        write_study(sys.argv[2], int(arguments.get("--persons", 4)), arguments.get("--same"))
    else:
        judge(sys.argv[2], sys.argv[3], dict(model.split("=") for model in sys.argv[4:]))
