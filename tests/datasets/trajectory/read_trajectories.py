"""Trajectories in the hands of other programs: pandas reads the tables, h5py the HDF5, numpy the NPZ, and this file
the MCAP by its specification with Debian's zstd and Google's protobuf. Each must find the poses and
joints of the record's snapshots, and its contacts and events, to 1e-6.

  read_trajectories.py GRASPBENCH      exit code 77: a package is missing
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy as np
    import pandas
    import zstandard
    from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PROGRAM = sys.argv[1]
TOLERANCE = 1e-6


def graspbench(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stdout, done.stderr)
    return done.stdout


def rotation(x, y, z, w):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def expect_pose(recorded, position, quaternion, what):
    assert np.abs(np.array(position) - recorded["p_m"]).max() < TOLERANCE, (what, position)
    assert np.abs(rotation(*quaternion) - recorded["R"]).max() < TOLERANCE, what


# --- The forms ------------------------------------------------------------------------------------


class Csv:
    def __init__(self, file):
        self.instants = pandas.read_csv(file)
        self.contacts = pandas.read_csv(file.with_suffix(".contacts.csv"))
        self.happened = pandas.read_csv(file.with_suffix(".events.csv"), keep_default_na=False)
        self.pressed = pandas.read_csv(file.with_suffix(".taxels.csv"))
        self.elements = pandas.read_csv(file.with_suffix(".elements.csv"))

    def row(self, time):
        return self.instants.iloc[(self.instants.time_s - time).abs().idxmin()]

    def pose(self, of, time):
        row = self.row(time)
        return ([row[f"{of}_{axis}_m"] for axis in "xyz"],
                [row[f"{of}_q{part}"] for part in "xyzw"])

    def joint(self, name, time):
        return self.row(time)[name + "_rad"]

    def forces(self):
        return [(time, group.normal_force_n.sum(), self.row(time).grip_force_n)
                for time, group in self.contacts.groupby("time_s")]

    def events(self):
        return list(zip(self.happened.time_s, self.happened.kind))

    def taxels(self):
        return self.pressed.to_numpy()[:, 1:], self.elements[["p_x_m", "p_y_m", "p_z_m", "n_x", "n_y", "n_z"]].to_numpy()


class Arrays:
    """Arrays with the names of their columns, as HDF5 and NumPy hold them."""

    def __init__(self, tables, events):
        self.tables, self.happened = tables, json.loads(events)
        self.columns, self.states = tables["states"]

    def row(self, time):
        return self.states[np.abs(self.states[:, 0] - time).argmin()]

    def value(self, name, time):
        return self.row(time)[self.columns.index(name)]

    def pose(self, of, time):
        return ([self.value(f"{of}_{axis}_m", time) for axis in "xyz"],
                [self.value(f"{of}_q{part}", time) for part in "xyzw"])

    def joint(self, name, time):
        return self.value(name + "_rad", time)

    def forces(self):
        columns, table = self.tables["contacts"]
        force = columns.index("normal_force_n")
        return [(self.states[int(row), 0], table[table[:, 0] == row, force].sum(),
                 self.states[int(row), 1]) for row in np.unique(table[:, 0])]

    def events(self):
        return [(e["time_s"], e["kind"]) for e in self.happened]

    def taxels(self):
        columns, elements = self.tables["taxel_elements"]
        first = columns.index("p_x_m")
        return self.tables["taxels"][1], elements[:, first:first + 6]


def read_h5(demo):
    names = ("states", "contacts", "taxels", "taxel_elements")
    return Arrays({name: (list(demo[name].attrs["columns"]), demo[name][:]) for name in names},
                  demo.attrs["events"])


def read_npz(file):
    arrays = np.load(file)  # without pickle
    assert len(arrays["phases"]) == len(arrays["states"])
    names = ("states", "contacts", "taxels", "taxel_elements")
    return Arrays({name: ([column.decode() for column in arrays[name + "_columns"]], arrays[name])
                   for name in names}, arrays["events"][0])


class Mcap:
    def __init__(self, file):
        bytes_ = file.read_bytes()
        assert bytes_[:8] == bytes_[-8:] == b"\x89MCAP0\r\n"
        self.classes, self.channels, self.messages, self.metadata = {}, {}, [], {}
        self.read(bytes_[8:-8])
        self.poses = {}
        for topic, _, message in self.messages:
            if topic != "/tf":
                continue
            for frame in message.transforms:
                stamp = frame.timestamp.seconds + frame.timestamp.nanos * 1e-9
                self.poses.setdefault(frame.child_frame_id, []).append((stamp, frame))

    def read(self, bytes_):
        at = 0
        while at < len(bytes_):
            opcode, length = struct.unpack_from("<BQ", bytes_, at)
            self.take(opcode, bytes_[at + 9:at + 9 + length])
            at += 9 + length

    def take(self, opcode, content):
        if opcode == 3:
            number, = struct.unpack_from("<H", content)
            name, at = self.text(content, 2)
            _, at = self.text(content, at)
            size, = struct.unpack_from("<I", content, at)
            files = descriptor_pb2.FileDescriptorSet.FromString(content[at + 4:at + 4 + size])
            pool = descriptor_pool.DescriptorPool()
            for one in files.file:
                pool.Add(one)
            prototype = message_factory.MessageFactory(pool).GetPrototype
            self.classes[number] = prototype(pool.FindMessageTypeByName(name))
        elif opcode == 4:
            number, schema = struct.unpack_from("<HH", content)
            self.channels[number] = (self.text(content, 4)[0], schema)
        elif opcode == 5:
            channel, _, time, _ = struct.unpack_from("<HIQQ", content)
            topic, schema = self.channels[channel]
            self.messages.append((topic, time * 1e-9, self.classes[schema].FromString(content[22:])))
        elif opcode == 6:
            size, = struct.unpack_from("<Q", content, 16)
            compression, at = self.text(content, 28)
            assert compression == "zstd"
            self.read(zstandard.ZstdDecompressor().decompress(content[at + 8:], size))
        elif opcode == 12:
            name, at = self.text(content, 0)
            at += 4
            while at < len(content):
                key, at = self.text(content, at)
                self.metadata[key], at = self.text(content, at)

    @staticmethod
    def text(content, at):
        size, = struct.unpack_from("<I", content, at)
        return content[at + 4:at + 4 + size].decode(), at + 4 + size

    def pose(self, of, time):
        _, frame = min(self.poses[of], key=lambda one: abs(one[0] - time))
        p, q = frame.translation, frame.rotation
        return [p.x, p.y, p.z], [q.x, q.y, q.z, q.w]

    def joint(self, name, time):
        _, _, message = min((m for m in self.messages if m[0] == "/joints"),
                            key=lambda m: abs(m[1] - time))
        return next(j.position for j in message.joints if j.name == name)

    def forces(self):
        return [(time, sum(c.normal_force for c in m.contacts), m.grip_force)
                for topic, time, m in self.messages if topic == "/contacts"]

    def events(self):
        return [(time, m.kind) for topic, time, m in self.messages if topic == "/events"]

    def taxels(self):
        layout, = (m for topic, _, m in self.messages if topic == "/taxel_layout")
        places = [[e.position.x, e.position.y, e.position.z, e.normal.x, e.normal.y, e.normal.z] for e in layout.elements]
        return (np.array([list(m.forces) for topic, _, m in self.messages if topic == "/taxels"]),
                np.array(places))


# --- The comparison -------------------------------------------------------------------------------


def compare(record, joints, closure, read, form):
    result = record["result"]
    for snapshot in result["snapshots"]:
        time = snapshot["time_s"]
        for key, of in (("X_WH", "hand"), ("X_WO", "object")):
            expect_pose(snapshot[key], *read.pose(of, time), (form, of, time))
        for name, position in zip(joints, snapshot["q_rad"]):
            assert abs(read.joint(name, time) - position) < TOLERANCE, (form, name, time)
    forces = read.forces()
    assert len(forces) > 10, form
    for time, total, grip in forces:
        assert abs(total - grip) < TOLERANCE, (form, time)
    wanted = sorted(closure + e["time_s"] for e in result["contact_events"])
    found = sorted(time for time, kind in read.events() if kind != "phase")
    assert len(wanted) == len(found), (form, wanted, found)
    assert all(abs(a - b) < TOLERANCE for a, b in zip(wanted, found)), (form, wanted, found)


def check_arm(folder):
    """Every form has the arm's joints. The chain of its frames ends at the flange, which the hand follows at one pose."""
    session = folder / "arm"
    graspbench("run", "--hand", "tum", "--object", "golf_ball", "--trials", 1, "--arm", "puma560", "--out", session)
    for form in ("csv", "mcap", "h5", "npz"):
        graspbench("replay", session, "--all", "--trajectory", form, "--out", folder / ("arm_" + form))
    name, = (path.stem for path in (folder / "arm_mcap").glob("*.mcap"))
    mcap = Mcap(folder / "arm_mcap" / (name + ".mcap"))
    table = pandas.read_csv(folder / "arm_csv" / (name + ".csv"))
    arrays = read_npz(folder / "arm_npz" / (name + ".npz"))
    demo = read_h5(h5py.File(folder / "arm_h5" / "trajectories.h5", "r")["data/demo_0"])
    joints = ["arm/" + joint for joint in ("waist", "shoulder", "elbow", "wrist roll", "wrist bend", "flange")]
    places = []
    for time, row in table.iloc[::20].set_index("time_s").iterrows():
        for joint in joints:
            for read in (mcap, arrays, demo):
                assert abs(read.joint(joint, time) - row[joint + "_rad"]) < TOLERANCE, (joint, time)
        p, R = np.zeros(3), np.eye(3)
        for frame in ["arm"] + joints:
            step, turn = mcap.pose(frame, time)
            p, R = p + R @ step, R @ rotation(*turn)
        places.append(R.T @ (mcap.pose("hand", time)[0] - p))
    assert np.ptp(table[joints[1] + "_rad"]) > 0.1
    assert np.ptp(places, axis=0).max() < TOLERANCE, places


def main():
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        session = folder / "s"
        graspbench("run", "--hand", "tum,shadow", "--object", "golf_ball", "--trials", 2, "--out",
                   session)
        check_arm(folder)
        graspbench("export", session, "--records")
        records = [json.loads(line)
                   for line in (session / "export" / "records.jsonl").read_text().splitlines()]
        for form in ("csv", "mcap", "h5", "npz"):
            graspbench("replay", session, "--all", "--trajectory", form, "--out", folder / form)
        demos = h5py.File(folder / "h5" / "trajectories.h5", "r")
        assert demos["data"].attrs["total"] == sum(
            demo.attrs["num_samples"] for demo in demos["data"].values())
        for i, record in enumerate(records):
            name = f"{record['hand']}-{record['object']}-{record['grasp']}-{record['trial']}"
            demo = demos[f"data/demo_{i}"]
            assert demo.attrs["trial_id"] == record["trial_id"]
            states = list(demo["states"].attrs["columns"])[17:]
            joints = [column.rsplit("_", 1)[0] for column in states]
            mcap = Mcap(folder / "mcap" / (name + ".mcap"))
            assert mcap.metadata["trial_id"] == record["trial_id"]
            assert mcap.metadata["record_sha256"] == demo.attrs["record_sha256"]
            split = "success" if record["result"]["outcome"] == "success" else "failed"
            assert f"demo_{i}" in [text.decode() for text in demos[f"mask/{split}"][:]]
            forms = (("csv", Csv(folder / "csv" / (name + ".csv"))), ("mcap", mcap), ("h5", read_h5(demo)),
                     ("npz", read_npz(folder / "npz" / (name + ".npz"))))
            for form, read in forms:
                compare(record, joints, demo.attrs["closure_start_s"], read, form)
            forces, places = forms[0][1].taxels()
            assert forces.max() > 0.1, name
            for form, read in forms[1:]:
                assert np.abs(read.taxels()[0] - forces).max() < TOLERANCE, (form, "taxels")
                assert np.abs(read.taxels()[1] - places).max() < TOLERANCE, (form, "elements")
        print(f"{len(records)} trials in 4 forms: the same numbers")


main()
