"""Policy servers against the built program.

    policy_servers_test.py PROGRAM SOURCE [TEST..]

The server is written from public descriptions (policy_server.py). The oracle of a right server is the same controller
on pipes; wrong ones have their outcome by hand."""

import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

from policy_server import BINARY, CLOSE, PING, TEXT, Decoder, Server, encode

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
ENVIRONMENT = dict(os.environ, PYTHONPATH=str(SOURCE / "workbench/python"), NO_COLOR="1")

CLOSING = """
import graspbench
class Close:
    def reset(self, facts):
        self.targets = facts["open"]
        self.step = 0.02 * (facts["closed"] - facts["open"])
    def act(self, observation):
        self.targets = self.targets + self.step
        return {"targets": self.targets, "done": observation["time"] > 1}
graspbench.serve(Close())
"""


class Close:
    """The same, as a server with the program's own names."""

    def __call__(self, observation):
        if "reset" in observation:
            facts = {name: np.array(observation["reset"][name]) for name in ("open", "closed")}
            self.targets, self.step = facts["open"], 0.02 * (facts["closed"] - facts["open"])
        self.targets = self.targets + self.step
        return {"actions": self.targets, "done": observation["time"] > 1}


def run(folder, policy, *options, expect=0):
    hand = [] if "--hand" in options else ["--hand", "tum"]
    command = [PROGRAM, "run", *hand, "--object", "golf_ball", "--trials", "2", "--jobs", "1",
               "--out", str(folder), "--policy", policy, *options]
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=300)
    assert done.returncode == expect, (done.returncode, done.stdout, done.stderr)
    return done.stdout + done.stderr


def records(folder):
    """Without what names the policy."""
    found = []
    for journal in sorted((pathlib.Path(folder) / "journal").glob("*.jsonl")):
        for line in journal.read_text().splitlines():
            record = json.loads(line)
            found.append({key: value for key, value in record.items() if key not in ("trial_id", "xxh64")})
    return sorted(found, key=lambda record: record["trial"])


def greet_and(act):
    """A server that greets as it should and then does `act` for each question."""
    def talk(connection):
        connection.send(encode({"robot": "hand"}))
        while True:
            act(connection, Decoder(connection.receive()).value())
    return talk


class PolicyServers(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory(prefix="graspbench_servers_")
        self.folder = pathlib.Path(self.place.name)
        self.servers = []

    def tearDown(self):
        for server in self.servers:
            server.close()
            self.assertEqual(server.errors, [])
        self.place.cleanup()

    def start(self, *arguments, **named):
        self.servers.append(Server(*arguments, **named))
        return self.servers[-1]

    def write(self, text):
        path = self.folder / "policy.yaml"
        path.write_text(text)
        return str(path)

    def test_the_same_controller_has_the_same_records_on_both_wires(self):
        script = self.folder / "close.py"
        script.write_text(CLOSING)
        run(self.folder / "pipe", f"{sys.executable} {script}")
        server = self.start(Close())
        run(self.folder / "wire", server.address)
        self.assertEqual(records(self.folder / "pipe"), records(self.folder / "wire"))
        self.assertEqual(server.num_connections, 2)  # one per trial

    def test_a_file_maps_observations_and_actions(self):
        def infer(observation):
            self.assertEqual(observation["prompt"], "grasp the golf_ball with the tum")
            state = observation["observation/state"]
            self.assertEqual((state.dtype, state.shape), (np.dtype("<f4"), (3,)))
            self.assertEqual(observation["joints"].shape, (2,))
            self.assertEqual(observation["extra"]["touch"].dtype, np.dtype("<f8"))
            rows = np.zeros((10, 3), np.float32)
            rows[:, 1] = 0.02
            rows[:, 2] = observation["observation/state"][2] > 0.3
            return {"actions": rows, "state": state, "policy_timing": {"infer_ms": np.float64(3.5)}}

        server = self.start(infer)
        first, second = self.find_facts()["driven"][:2]
        policy = self.write(f"""
server: {server.address}
observation:
  observation/state: {{from: [palm_force, grip_force, time]}}
  joints: {{from: joint_positions, joints: [{second}, {first}]}}
  prompt: {{text: "grasp the {{object}} with the {{hand}}"}}
  touch: {{from: digit_forces, dtype: float64, under: extra}}
actions: {{as: increments, columns: [{first}, {second}, done]}}
""")
        run(self.folder / "s", policy, "--set", "policy.execute_steps=5")
        for record in records(self.folder / "s"):
            taken = record["result"]["policy"]
            self.assertTrue(taken["said_done"])
            rows = np.array([row["targets_rad"] for row in taken["rows"]])
            moved = np.abs(rows - rows[0]).max(axis=0) > 0
            self.assertEqual(list(np.flatnonzero(moved)), [1])
            self.assertEqual(taken["num_questions"], -(-len(rows) // 5))

    def test_the_example_of_openpi_serves_both_hands(self):
        def infer(observation):
            self.assertEqual(set(observation), {"observation/state", "prompt"})
            num_joints = observation["observation/state"].size - 5
            return {"actions": np.zeros((10, 20 if num_joints == 24 else num_driven), np.float32)}

        num_driven = len(self.find_facts()["driven"])
        server = self.start(infer)
        text = (SOURCE / "workbench/python/examples/openpi.yaml").read_text()
        policy = self.write(text.replace("ws://127.0.0.1:8000", server.address))
        run(self.folder / "s", policy, "--hand", "tum,shadow", "--set", "policy.execute_steps=10", "--set", "policy.time_s=0.4")
        found = records(self.folder / "s")
        self.assertEqual([record["result"]["outcome"] for record in found], ["no contact"] * 4)

    def test_a_file_that_names_joints_serves_one_hand(self):
        policy = self.write("server: ws://127.0.0.1:1\nobservation: {a: {from: time}}\nactions: {columns: [FFJ3]}\n")
        text = run(self.folder / "s", policy, "--hand", "shadow,tum", expect=3)
        self.assertIn('the hand tum has no joint "FFJ3" (a file that names joints serves one hand', text)

    def test_a_file_that_has_changed_does_not_go_on(self):
        server = self.start(lambda o: {"actions": np.zeros(9)})
        text = f"server: {server.address}\nobservation: {{a: {{from: taxels}}}}\nactions: {{as: increments}}\n"
        policy = self.write(text)
        run(self.folder / "s", policy, expect=5)
        self.write(text.replace("taxels", "time"))
        done = subprocess.run([PROGRAM, "run", "--resume", "--out", str(self.folder / "s")], env=ENVIRONMENT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(f"{policy}: SHA-256", done.stderr)
        self.assertIn("Restore the files", done.stderr)

    def test_a_picture_has_the_size_of_the_file(self):
        def infer(observation):
            picture = observation["observation/wrist_image"]
            self.assertEqual((picture.dtype, picture.shape), (np.dtype("u1"), (48, 64, 3)))
            self.assertTrue((picture[:, :8] == 0).all() and (picture[:, 56:] == 0).all())  # a square in the middle
            self.assertGreater(int(picture[:, 8:56].max()) - int(picture[:, 8:56].min()), 50)
            return {"actions": np.zeros((20, 9), np.float32)}

        server = self.start(infer)
        policy = self.write(f"server: {server.address}\n"
                            "observation: {observation/wrist_image: {from: picture, size: [48, 64]}}\n"
                            "actions: {as: increments}\n")
        run(self.folder / "s", policy, "--set", "policy.picture_px=96", "--set", "policy.execute_steps=20",
            "--set", "policy.time_s=0.5")
        self.assertGreater(len(server.observations), 0)
        for record in records(self.folder / "s"):
            self.assertNotEqual(record["result"]["outcome"], "wrong answer", record["result"].get("reason"))

    def find_facts(self):
        found = {}

        def infer(observation):
            found.update(observation["reset"])
            return {"actions": np.array(found["open"]), "done": True}
        run(self.folder / "facts", self.start(infer).address)
        return found

    def test_wrong_answers_are_outcomes(self):
        def raises(observation):
            raise KeyError("observation/image")
        cases = {
            "shape": (lambda o: {"actions": np.zeros((10, 3))}, "has the shape"),
            "not a number": (lambda o: {"actions": np.full(len(o["targets"]), np.nan)}, "holds NaN"),
            "no actions": (lambda o: {"state": np.zeros(3)}, "no targets"),
            "text": (raises, "KeyError"),
        }
        for name, (infer, reason) in cases.items():
            with self.subTest(name):
                run(self.folder / name, self.start(infer).address)
                for record in records(self.folder / name):
                    self.assertEqual(record["result"]["outcome"], "wrong answer")
                    self.assertIn(reason, record["result"]["reason"])
        talks = {
            "garbage": (lambda c, o: c.send(b"\xc1\xc1"), "MessagePack"),
            "flood": (lambda c, o: c.send(b"\x00" * (3 << 20)), "more than 1048576 bytes"),
            "twice": (lambda c, o: [c.send(encode({"actions": o["targets"]})) for _ in (1, 2)], "unexpected extra answer"),
        }
        for name, (act, reason) in talks.items():
            with self.subTest(name):
                run(self.folder / name, self.start(talk=greet_and(act)).address)
                for record in records(self.folder / name):
                    self.assertEqual(record["result"]["outcome"], "wrong answer")
                    self.assertIn(reason, record["result"]["reason"])

    def test_lost_servers_leave_trials_unfinished(self):
        def half(connection, observation):
            connection.send(b"\x00" * 10, last=False)
            time.sleep(30)
        talks = {
            "closes": (greet_and(lambda c, o: c.send(struct.pack(">H", 1001) + b"going away", CLOSE)), "going away"),
            "breaks": (greet_and(lambda c, o: c.plug.close()), "closed the connection"),
            "silent": (greet_and(lambda c, o: time.sleep(30)), "has not answered for 1 s"),
            "half a message": (greet_and(half), "has not answered for 1 s"),
            "never greets": (lambda c: time.sleep(30), "has not answered for 1 s"),
            "greets with text": (lambda c: c.send(b"no weights", TEXT), "no weights"),
            "greets with a list": (lambda c: c.send(encode([1])), "not a map"),
        }
        for name, (talk, reason) in talks.items():
            with self.subTest(name):
                text = run(self.folder / name, self.start(talk=talk).address, "--set", "policy.timeout_s=1", expect=5)
                self.assertIn(reason, text)
                self.assertIn("lost in 2 trials", text)
                self.assertEqual(records(self.folder / name), [])
        refuses = self.start(accept=False)
        self.assertIn("no websocket", run(self.folder / "refuses", refuses.address, expect=5))
        closed = Server()
        closed.close()
        self.assertIn("no connection", run(self.folder / "closed", closed.address, expect=5))

    def test_pings_and_split_messages_are_met(self):
        close = Close()

        def act(connection, observation):
            connection.send(b"alive?", PING)
            answer = encode(close(observation))
            connection.send(answer[:7], BINARY, last=False)
            connection.send(answer[7:], first=False)
        run(self.folder / "split", self.start(talk=greet_and(act)).address)
        run(self.folder / "whole", self.start(Close()).address)
        self.assertEqual(records(self.folder / "split"), records(self.folder / "whole"))

    def test_killed_and_resumed_the_same_records(self):
        server = self.start(Close())
        run(self.folder / "whole", server.address)
        folder = self.folder / "killed"
        process = subprocess.Popen([PROGRAM, "run", "--hand", "tum", "--object", "golf_ball", "--trials", "2", "--jobs", "1",
                                    "--out", str(folder), "--policy", server.address], env=ENVIRONMENT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and server.num_connections < 4:  # two of the first run
            time.sleep(0.002)
        process.kill()
        process.wait()
        subprocess.run([PROGRAM, "run", "--resume", "--out", str(folder)], env=ENVIRONMENT, check=True, capture_output=True)
        self.assertEqual(records(folder), records(self.folder / "whole"))

    def test_only_this_machine_is_asked(self):
        text = run(self.folder / "far", "ws://192.0.2.1:8000", expect=2)
        self.assertIn("--allow-remote", text)
        text = run(self.folder / "asked", "ws://192.0.2.1:8000", "--allow-remote", "--set", "policy.timeout_s=0.2",
                   expect=5)
        self.assertNotIn("is on another machine", text)

    def test_a_wrong_file_is_reported(self):
        policy = self.write("server: ws://127.0.0.1:1\nobservation: {a: {from: joint_position}}\n")
        self.assertIn('did you mean "joint_positions"', run(self.folder / "s", policy, expect=3))
        server = self.start(lambda o: {"actions": np.zeros(1)})
        policy = self.write(f"server: {server.address}\nobservation: {{a: {{from: taxels}}}}\n")
        self.assertIn('"taxels" is not available', run(self.folder / "t", policy, expect=5))
        self.assertEqual(records(self.folder / "t"), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
