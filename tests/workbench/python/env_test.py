"""Trials step by step in Python, and demonstrations, with the built program.

    env_test.py PROGRAM SOURCE [TEST..]

The oracle of Env is the same controller on pipes; that of a file is h5py, by robomimic's description."""

import inspect
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
os.environ.update(GRASPBENCH=PROGRAM, PYTHONPATH=str(SOURCE / "workbench/python"), NO_COLOR="1")
sys.path.insert(0, os.environ["PYTHONPATH"])
import graspbench  # noqa: E402

SCENE = ("--hand", "tum", "--object", "golf_ball")


class Close:
    def reset(self, facts):
        self.targets = facts["open"]
        self.step = 0.02 * (facts["closed"] - facts["open"])

    def act(self, observation):
        self.targets = self.targets + self.step
        return {"targets": self.targets, "done": observation["time"] > 1}


class Again:
    """The actions of a demonstration."""

    def __init__(self, demonstration):
        self.rows, self.is_done = demonstration["actions"], demonstration["attrs"]["said_done"]

    def reset(self, facts):
        self.next = 0

    def act(self, observation):
        self.next += 1
        return {"targets": self.rows[self.next - 1], "done": self.is_done and self.next == len(self.rows)}


def roll(env, policy, seed=None):
    observation, info = env.reset(seed)
    policy.reset(info["facts"])
    terminated = False
    while not terminated:
        observation, reward, terminated, truncated, info = env.step(policy.act(observation))
        assert not truncated
    return reward, info


def find_children(folder):
    found = []
    for place in pathlib.Path("/proc").glob("[0-9]*/environ"):
        try:
            if f"GRASPBENCH_ENV={folder}".encode() in place.read_bytes():
                found.append(place.parent.name)
        except OSError:
            pass
    return found


class Envs(unittest.TestCase):
    def test_a_trial_is_that_of_the_same_controller_on_pipes(self):
        with tempfile.TemporaryDirectory() as place:
            script = pathlib.Path(place) / "close.py"
            script.write_text(f"import graspbench\n{inspect.getsource(Close)}\ngraspbench.serve(Close())\n")
            folder = graspbench.run(f"{place}/s", *SCENE, "--trials", "3", "--jobs", "1", "--seed", "5",
                                    "--policy", f"{sys.executable} {script}")
            results = {}
            for journal in (folder / "journal").glob("*.jsonl"):
                for line in journal.read_text().splitlines():
                    record = json.loads(line)
                    results[record["trial"]] = record["result"]
        with graspbench.Env(*SCENE, trials=2) as env:
            for trial in (0, 1):
                reward, info = roll(env, Close(), 5 if trial == 0 else None)
                self.assertEqual(info["result"], results[trial])
                self.assertEqual(reward, float(results[trial]["outcome"] == "success"))
            roll(env, Close())  # the session is over: that of the next seed
            self.assertEqual(env._seed, 6)
            self.assertEqual(roll(env, Close(), 5)[1]["result"], results[0])
            folder = env.folder
        time.sleep(0.5)
        self.assertFalse(folder.exists())
        self.assertEqual(find_children(folder), [])

    def test_a_trial_that_is_left_costs_nothing(self):
        with graspbench.Env(*SCENE) as env:
            _, info = env.reset(1)
            env.step(info["facts"]["open"])
            _, left = env.reset()
            self.assertNotEqual(info["facts"]["seed"], left["facts"]["seed"])
            _, again = env.reset(1)
            self.assertEqual(info["facts"]["trial_id"], again["facts"]["trial_id"])

    def test_spaces_have_the_names_of_the_table(self):
        with graspbench.Env(*SCENE) as env:
            observation, info = env.reset(1)
            self.assertEqual(set(env.observation_space), set(observation))
            for name, space in env.observation_space.items():
                self.assertTrue(space.contains(observation[name]), name)
            action = env.action_space.sample(np.random.default_rng(1))
            self.assertTrue(env.action_space.contains(action))
            self.assertFalse(env.action_space.contains(info["facts"]["upper"] + 1))
            page = (SOURCE / "workbench/manual/pages/controllers.md").read_text()
            for name in observation:
                self.assertIn(f"| `{name}` |", page)

    def test_faults_are_reported(self):
        with self.assertRaisesRegex(RuntimeError, "no_such_thing"):
            graspbench.Env("--object", "no_such_thing")
        with graspbench.Env(*SCENE) as env:
            env.reset()
            _, reward, terminated, _, info = env.step(np.zeros(2))
            self.assertEqual((reward, terminated, info["outcome"]), (0.0, True, "wrong answer"))
            self.assertIn("has the shape (2,)", info["reason"])
            with self.assertRaisesRegex(RuntimeError, "call reset"):
                env.step(np.zeros(2))
            self.assertEqual(roll(env, Close(), 1)[1]["outcome"], "success")

    def test_a_table_is_that_of_its_dictionary(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("Debian's package python3-pandas is not installed")
        with tempfile.TemporaryDirectory() as place:
            folder = graspbench.run(f"{place}/s", *SCENE, "--trials", "1")
            table = graspbench.load(folder)
            self.assertEqual(table.attrs["columns"]["grip_force_n"]["unit"], "N")
            path = folder / "export/trials.csv"
            path.write_text(path.read_text().replace("grip_force_n", "grip_force_lb", 1))
            with self.assertRaisesRegex(ValueError, "other columns than trials.schema.json"):
                graspbench.load(folder)

    def test_demonstrations_come_back_and_do_the_same_again(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("Debian's package python3-h5py is not installed")
        with tempfile.TemporaryDirectory() as place, graspbench.Env(*SCENE) as env:
            demonstrations = graspbench.collect(env, Close(), 3, seed=1)
            path = f"{place}/d.hdf5"
            graspbench.write_demonstrations(path, demonstrations)
            with h5py.File(path) as file:
                demo = file["data/demo_0"]
                num = int(demo.attrs["num_samples"])
                self.assertEqual(file["data"].attrs["total"], sum(len(one["actions"]) for one in demonstrations))
                self.assertIn("env_name", json.loads(file["data"].attrs["env_args"]))
                for name in ("actions", "rewards", "dones"):
                    self.assertEqual(len(demo[name]), num)
                for name, values in demo["obs"].items():
                    self.assertEqual(values.shape[0], num)
                    self.assertEqual(values.ndim, 2)
                    self.assertTrue(np.array_equal(values[1:], demo["next_obs"][name][:-1]))
                held = [name.decode() for name in file["mask/successful"]]
            found = graspbench.read_demonstrations(path)
            for number, (read, made) in enumerate(zip(found, demonstrations)):
                self.assertEqual(read["attrs"], made["attrs"])
                self.assertTrue(np.array_equal(read["actions"], made["actions"]))
                reward, info = roll(env, Again(read), 1 if number == 0 else None)
                self.assertEqual(info["outcome"], made["attrs"]["outcome"])
                self.assertEqual(info["facts"]["seed"], made["attrs"]["seed"])
                self.assertEqual(f"demo_{number}" in held, reward == 1.0)

    def test_damaged_demonstrations_are_refused_with_the_array(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("Debian's package python3-h5py is not installed")
        numbers = np.zeros(5)

        def link(group):
            group["actions"] = h5py.ExternalLink("d.hdf5", "/data/demo_0/actions")

        damages = {
            "demo_0/actions is no dataset": lambda group: None,
            "demo_0/actions is no dataset of this file": link,
            "no array of numbers": lambda group: group.create_dataset("actions", data=["text"] * 5, dtype=h5py.string_dtype()),
            "unfold to more than 0.9 GB": lambda group: group.create_dataset("actions", shape=(2**62,), chunks=(1000,), dtype="f8"),
        }
        with tempfile.TemporaryDirectory() as place:
            path = f"{place}/d.hdf5"
            for words, damage in damages.items():
                one = {"observations": {"q": numbers}, "actions": numbers, "rewards": numbers, "dones": numbers, "attrs": {}}
                graspbench.write_demonstrations(path, [one])
                self.assertEqual(len(graspbench.read_demonstrations(path)), 1)
                with h5py.File(path, "a") as file:
                    del file["data/demo_0/actions"]
                    damage(file["data/demo_0"])
                with self.assertRaisesRegex(ValueError, words):
                    graspbench.read_demonstrations(path)
            whole = pathlib.Path(path).read_bytes()
            pathlib.Path(path).write_bytes(whole[: len(whole) // 2])
            with self.assertRaisesRegex(ValueError, "no file of demonstrations"):
                graspbench.read_demonstrations(path)
            with self.assertRaises(FileNotFoundError):
                graspbench.read_demonstrations(f"{place}/none.hdf5")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
