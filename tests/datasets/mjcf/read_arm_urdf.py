"""An arm with a hand as URDF, in the hands of another program: this file reads it by URDF's own
rules. Poses of the arm's flange must be those of the Denavit-Hartenberg rows in arm.yaml, and the
palm of a trial must stand where its trajectory has it, to 1e-9 m.

  read_arm_urdf.py GRASPBENCH ARMS      exit code 77: a package is missing
"""

import csv
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

try:
    import numpy as np
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PROGRAM, ARMS = sys.argv[1], pathlib.Path(sys.argv[2])
TOLERANCE = 1e-9


def graspbench(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stdout, done.stderr)
    return done.stdout


def turn(axis, angle):
    """Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    result = np.eye(4)
    result[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return result


def shift(*p):
    result = np.eye(4)
    result[:3, 3] = p
    return result


class Robot:
    def __init__(self, file):
        self.joints = {}  # by child link
        for joint in ElementTree.parse(file).getroot().iter("joint"):
            def numbers(tag, attribute, otherwise):
                element = joint.find(tag)
                return [float(word) for word in
                        (otherwise if element is None else element.get(attribute, otherwise)).split()]
            roll, pitch, yaw = numbers("origin", "rpy", "0 0 0")
            origin = (shift(*numbers("origin", "xyz", "0 0 0")) @ turn((0, 0, 1), yaw)
                      @ turn((0, 1, 0), pitch) @ turn((1, 0, 0), roll))
            self.joints[joint.find("child").get("link")] = (
                joint.get("name"), joint.get("type"), joint.find("parent").get("link"), origin,
                numbers("axis", "xyz", "1 0 0"))

    def pose(self, link, angles):
        result = np.eye(4)
        while link in self.joints:
            name, kind, link, origin, axis = self.joints[link]
            result = origin @ (turn(axis, angles.get(name, 0.0)) if kind != "fixed" else np.eye(4)) @ result
        assert link == "world", link
        return result


def flange(rows, angles):
    """Standard Denavit-Hartenberg rows of arm.yaml."""
    result = np.eye(4)
    for row in rows:
        theta = angles["arm/" + row["name"]] + math.radians(row.get("offset_deg", 0))
        result = (result @ turn((0, 0, 1), theta) @ shift(row["a_m"], 0, row["d_m"])
                  @ turn((1, 0, 0), math.radians(row["alpha_deg"])))
    return result


def check(folder, arm, hand, base):
    session = folder / arm
    graspbench("run", "--hand", hand, "--object", "golf_ball", "--arm", arm, "--arm-base", base,
               "--trials", 1, "--out", session)
    graspbench("export", session, "--urdf")
    urdf = session / "export" / "urdf" / hand / "robot.urdf"
    robot = Robot(urdf)
    rows = yaml.safe_load((ARMS / arm / "arm.yaml").read_text())["joints"]
    x, y, z, yaw = map(float, base.split(","))
    X_WB = shift(x, y, z) @ turn((0, 0, 1), math.radians(yaw))
    root = next(link for link, joint in robot.joints.items() if joint[0] == "arm to hand")
    draws = random.Random(1)
    X_FRoot = None
    for _ in range(200):
        angles = {"arm/" + row["name"]: math.radians(draws.uniform(row["lower_deg"], row["upper_deg"]))
                  for row in rows}
        found = np.linalg.inv(X_WB @ flange(rows, angles)) @ robot.pose(root, angles)
        X_FRoot = found if X_FRoot is None else X_FRoot
        assert np.abs(found - X_FRoot).max() < TOLERANCE, (arm, np.abs(found - X_FRoot).max())

    # The trial itself: the palm's pose at its first instant, at the arm's first angles.
    scenes = folder / (arm + "-scenes")
    scene = pathlib.Path(graspbench("export", session, "--mjcf", "all", "--out", scenes).split()[0])
    with open(scene.parent / "motion.csv") as table:
        first = next(csv.DictReader(table))
    angles = {"arm/" + row["name"]: float(first["arm/" + row["name"] + "_rad"]) for row in rows}
    file = folder / (arm + ".npz")
    graspbench("trial", session, scene.parent.name, "--trajectory", file)
    tables = np.load(file)
    start = dict(zip([name.decode() for name in tables["states_columns"]], tables["states"][0]))
    palm = yaml.safe_load((urdf.parent / "hand.yaml").read_text())["palm"]["link"]
    found = robot.pose(palm, angles)[:3, 3]
    expected = [start[f"hand_{axis}_m"] for axis in "xyz"]
    assert np.abs(found - expected).max() < TOLERANCE, (arm, found, expected)


with tempfile.TemporaryDirectory() as name:
    check(pathlib.Path(name), "puma560", "tum", "-0.5,0,0,0")
    check(pathlib.Path(name), "pa10", "shadow", "-0.4,-0.4,0.1,45")
