"""Demonstrations: trials as observations and actions, in the layout of robomimic's HDF5 files.

A demonstration is a dict: observations (name: array over time), actions (time x n), rewards, dones, attrs (outcome,
said_done, trial_id, seed, hand, object). Numbers become columns of one. Needs h5py for files."""

import json
import math
import os

import numpy as np


def collect(env, policy, num_trials, seed=1):
    """Trials of a controller in an Env, from a seed on: a list of demonstrations, failed ones, too (attrs: outcome)."""
    demonstrations = []
    for number in range(num_trials):
        observation, info = env.reset(seed if number == 0 else None)
        policy.reset(info["facts"])
        observations, actions, rewards = [], [], []
        terminated = False
        while not terminated:
            action = policy.act(observation)
            observations.append(observation)
            actions.append(_find_targets(action, observation))
            observation, reward, terminated, _, info = env.step(action)
            rewards.append(reward)
        facts = info["facts"]
        names = sorted(observations[0])
        demonstrations.append({
            "observations": {name: np.stack([np.atleast_1d(one[name]) for one in observations]) for name in names},
            "actions": np.stack(actions),
            "rewards": np.array(rewards),
            "dones": np.array([0] * (len(rewards) - 1) + [1]),
            "attrs": {"outcome": info["outcome"], "said_done": bool(action.get("done", False)),
                      **{name: facts[name] for name in ("trial_id", "seed", "hand", "object")}}})
    return demonstrations


def _find_targets(action, observation):
    """What the action asks for, in its first row."""
    last = np.asarray(observation["targets"], dtype=float)
    if "targets" in action:
        return np.atleast_2d(np.asarray(action["targets"], dtype=float))[0]
    if "increments" in action:
        return last + np.atleast_2d(np.asarray(action["increments"], dtype=float))[0]
    return last


def write_demonstrations(path, demonstrations):
    """As data/demo_0 .. with obs, next_obs, actions, rewards and dones; mask/successful names those that held."""
    import h5py

    with h5py.File(path, "w") as file:
        data = file.create_group("data")
        data.attrs["total"] = sum(len(one["actions"]) for one in demonstrations)
        data.attrs["env_args"] = json.dumps({"env_name": "graspbench", "env_type": 2, "env_kwargs": {}})
        for number, one in enumerate(demonstrations):
            group = data.create_group(f"demo_{number}")
            group.attrs["num_samples"] = len(one["actions"])
            for name, value in one["attrs"].items():
                group.attrs[name] = value
            for name in ("actions", "rewards", "dones"):
                group[name] = one[name]
            for name, values in one["observations"].items():
                group[f"obs/{name}"] = values
                group[f"next_obs/{name}"] = np.concatenate([values[1:], values[-1:]])
        held = [f"demo_{i}" for i, one in enumerate(demonstrations) if one["attrs"].get("outcome") == "success"]
        file["mask/successful"] = np.array(held, dtype="S")


def read_demonstrations(path):
    """Those of a file, in the order of their numbers; of robomimic's own files, too.

    ValueError where the file is damaged, lacks an array, has something else in the place of numbers, names another file,
    or unfolds to more than 0.9 GB and four times its size."""
    import h5py

    left = 900_000_000 + 4 * os.path.getsize(path)

    def find(group, name, kind):
        if group.get(name, getclass=True, getlink=True) is not h5py.HardLink or not isinstance(group[name], kind):
            raise ValueError(f"{group.name}/{name} is no {kind.__name__.lower()} of this file")
        return group[name]

    def read(group, name):
        nonlocal left
        data = find(group, name, h5py.Dataset)
        if data.shape is None or data.dtype.kind not in "biuf" or data.external or data.is_virtual:
            raise ValueError(f"{data.name} is no array of numbers of this file")
        left -= math.prod(data.shape) * data.dtype.itemsize
        if left < 0:
            raise ValueError(f"{data.name} and what comes before it unfold to more than 0.9 GB and four times the file")
        return np.asarray(data[()])

    try:
        with h5py.File(path) as file:
            data = find(file, "data", h5py.Group)
            demonstrations = []
            for name in sorted(data, key=lambda name: int(name.split("_")[-1])):
                group = find(data, name, h5py.Group)
                observations = find(group, "obs", h5py.Group)
                demonstrations.append({
                    "observations": {one: read(observations, one) for one in observations},
                    **{one: read(group, one) for one in ("actions", "rewards", "dones")},
                    "attrs": {one: _as_plain(value) for one, value in group.attrs.items() if one != "num_samples"}})
            return demonstrations
    except Exception as fault:  # of a damaged file the library raises errors of many kinds
        raise ValueError(f'"{path}" is no file of demonstrations: {fault}') from fault


def _as_plain(value):
    return value.item() if isinstance(value, np.generic) else value
