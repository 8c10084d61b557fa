#!/usr/bin/env python3
"""Grasps as BODex and Dexonomy save them, for a test of `graspbench grasps`; without numpy.

Written from the description of the format alone: a dictionary with pregrasp_qpos, grasp_qpos and
squeeze_qpos of 29 numbers (x y z, w x y z of a quaternion, FF MF RF J4..J1, LF J5..J1, TH J5..J1),
obj_scale and obj_path, pickled behind a header of numpy; one grasp a file (BODex, J1 = J2) or arrays
(N, 29) (Dexonomy, J1 free). Stand-ins pickle themselves under the names of numpy's classes.

  write_foreign_grasps.py PROGRAM [NUM_GRASPS]
writes them into a temporary folder, lets PROGRAM read them, and compares every number."""

import json
import math
import os
import pickle
import random
import struct
import subprocess
import sys
import tempfile
import types


def numpy_stand_ins():
    """Modules by the names that numpy has, of classes that pickle as numpy's do."""
    multiarray = types.ModuleType("numpy.core.multiarray")
    numpy = types.ModuleType("numpy")

    def reconstruct(*_):
        raise NotImplementedError

    def scalar(*_):
        raise NotImplementedError

    reconstruct.__module__ = scalar.__module__ = "numpy.core.multiarray"
    reconstruct.__qualname__ = reconstruct.__name__ = "_reconstruct"
    scalar.__qualname__ = scalar.__name__ = "scalar"
    multiarray._reconstruct = reconstruct
    multiarray.scalar = scalar

    class dtype:
        def __init__(self, code, order="<", size=-1, flags=0):
            self.state = (code, order, size, flags)

        def __reduce__(self):
            code, order, size, flags = self.state
            return (dtype, (code, False, True), (3, order, None, None, None, size, size, flags))

    class ndarray:
        def __init__(self, shape, kind, content):
            self.parts = (shape, kind, content)

        def __reduce__(self):
            shape, kind, content = self.parts
            return (reconstruct, (ndarray, (0,), b"b"), (1, shape, kind, False, content))

    for one in (dtype, ndarray):
        one.__module__ = "numpy"
        one.__qualname__ = one.__name__
        setattr(numpy, one.__name__, one)
    sys.modules["numpy"] = numpy
    sys.modules["numpy.core"] = types.ModuleType("numpy.core")
    sys.modules["numpy.core.multiarray"] = multiarray
    return numpy, multiarray


NUMPY, MULTIARRAY = numpy_stand_ins()


class Scalar:
    def __init__(self, value):
        self.value = value

    def __reduce__(self):
        return (MULTIARRAY.scalar, (NUMPY.dtype("f8"), struct.pack("<d", self.value)))


def array(rows, code):
    """Of one row or of several, as float32 or float64."""
    flat = [x for row in rows for x in row] if isinstance(rows[0], list) else rows
    shape = (len(rows), len(rows[0])) if isinstance(rows[0], list) else (len(rows),)
    form = "<%d%s" % (len(flat), {"f4": "f", "f8": "d"}[code])
    return NUMPY.ndarray(shape, NUMPY.dtype(code), struct.pack(form, *flat))


def save(path, dictionary, protocol):
    """What np.save does with a dictionary: an array of objects without dimensions."""
    whole = NUMPY.ndarray((), NUMPY.dtype("O8", "|", -1, 63), [dictionary])
    header = "{'descr': '|O', 'fortran_order': False, 'shape': (), }"
    header += " " * (63 - (10 + len(header)) % 64) + "\n"
    with open(path, "wb") as out:
        out.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode())
        out.write(pickle.dumps(whole, protocol=protocol))


def draw_row(rng, is_coupled):
    q = [rng.gauss(0, 1) for _ in range(4)]
    norm = math.sqrt(sum(x * x for x in q))
    row = [rng.uniform(-0.2, 0.2) for _ in range(3)] + [x / norm for x in q]
    for digit in ("FF", "MF", "RF", "LF"):
        side = ([rng.uniform(0.0, 0.7)] if digit == "LF" else []) + [rng.uniform(-0.3, 0.3)]
        bend = [rng.uniform(0.0, 1.5) for _ in range(3)]
        if is_coupled:
            bend[2] = bend[1]
        row += side + bend
    return row + [rng.uniform(-0.5, 0.9) for _ in range(5)]


def to_float(row, code):
    return [struct.unpack("<f", struct.pack("<f", x))[0] for x in row] if code == "f4" else row


def write_grasps(folder, num_grasps, rng):
    """The folder's grasps by source and index: object, scale, stages."""
    expected = {}
    written = 0
    while written < num_grasps:
        is_bodex = rng.random() < 0.5
        code = rng.choice(["f4", "f8"])
        count = 1 if is_bodex else min(rng.randint(1, 12), num_grasps - written)
        name = "core_%s_%d" % (rng.choice(["bottle", "mug", "bowl"]), rng.randint(0, 9))
        stages = {}
        for stage in ("pregrasp", "grasp", "squeeze"):
            rows = [to_float(draw_row(rng, is_bodex), code) for _ in range(count)]
            stages[stage] = rows
        scale = rng.uniform(0.05, 0.2)
        dictionary = {s + "_qpos": array(r[0] if is_bodex else r, code) for s, r in stages.items()}
        dictionary["obj_scale"] = Scalar(scale) if rng.random() < 0.5 else scale
        dictionary["obj_path"] = "assets/object/" + name
        dictionary["grasp_error"] = [rng.random(), None, True, "anything"]
        if rng.random() < 0.5:
            dictionary["obj_pose"] = array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], "f4")
        path = "%s/%s_%d.npy" % (name, "bodex" if is_bodex else "dexonomy", written)
        os.makedirs(os.path.join(folder, name), exist_ok=True)
        save(os.path.join(folder, path), dictionary, rng.choice([2, 3, 4, 5]))
        for i in range(count):
            expected[path, i] = (dictionary["obj_path"], scale, [r[i] for r in stages.values()])
        written += count
    return expected


def compare(found, expected):
    if found["unread"]:
        sys.exit("not read: %s" % found["unread"][0])
    if len(found["grasps"]) != len(expected):
        sys.exit("%d grasps of %d" % (len(found["grasps"]), len(expected)))
    for grasp in found["grasps"]:
        where = (grasp["source"], grasp["index"])
        name, scale, rows = expected[where]
        if grasp["object"] != name or grasp["scale"] != scale or len(grasp["stages"]) != 3:
            sys.exit("%s: another object, scale or number of stages" % (where,))
        for stage, row in zip(grasp["stages"], rows):
            pose = stage["X_OR_m_wxyz"]
            sign = 1 if sum(a * b for a, b in zip(pose[3:], row[3:7])) > 0 else -1
            turn = max(abs(sign * a - b) for a, b in zip(pose[3:], row[3:7]))
            if pose[:3] != row[:3] or stage["joints"] != row[7:] or turn > 1e-6:
                sys.exit("%s, %s: other numbers" % (where, stage["name"]))


def main():
    program, num_grasps = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 400
    with tempfile.TemporaryDirectory() as folder:
        expected = write_grasps(folder, num_grasps, random.Random(43))
        run = subprocess.run(
            [program, "grasps", "info", folder, "--hand", "shadow", "--json"],
            capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(run.stderr + run.stdout[-2000:])
        compare(json.loads(run.stdout), expected)
    print("%d of %d grasps are read and taken by the hand" % (len(expected), num_grasps))


main()
