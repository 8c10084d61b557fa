"""Learns a closing schedule by the cross-entropy method: the gentlest that still lifts.

    python3 learn_closing.py FOLDER OPTIONS..     as for graspbench run: --hand tum --object golf_ball --trials 4

Three numbers: how far the digits close (share of the way to the target posture), how long that takes, and by how much
the thumb is ahead. The score of a schedule is its success rate less 0.02 per newton of grip force before the lift.
Each candidate is a session in FOLDER. Run with --parameters it is the controller of a candidate.
"""

import pathlib
import shlex
import sys

import numpy as np

import graspbench

START = np.array([0.8, 1.0, 0.0])
SPREAD = np.array([0.3, 0.4, 0.2])
LEAST, MOST = np.array([0.1, 0.3, -0.5]), np.array([1.5, 3.0, 0.5])
GENERATIONS, CANDIDATES, ELITE = 4, 8, 3


class Schedule:
    def __init__(self, parameters):
        self.share, self.time, self.ahead = parameters

    def reset(self, facts):
        self.open, self.way = facts["open"], facts["closed"] - facts["open"]
        self.is_thumb = np.array([digit == "TH" for digit in facts["driven_digits"]])

    def act(self, observation):
        begun = observation["time"] + np.where(self.is_thumb, self.ahead, -self.ahead) / 2
        closed = self.share * np.clip(begun / self.time, 0.0, 1.0)
        return {"targets": self.open + closed * self.way,
                "done": observation["time"] > self.time + abs(self.ahead) + 0.5}


def score(folder):
    table = graspbench.load(folder)
    return float((table["success"] - 0.02 * table["grip_force_n"]).mean())


def learn(folder, options):
    random = np.random.default_rng(1)
    mean, spread = START, SPREAD
    for generation in range(GENERATIONS):
        candidates = np.clip(random.normal(mean, spread, (CANDIDATES, mean.size)), LEAST, MOST).round(3)
        if generation == 0:
            candidates[0] = START
        scores = []
        for number, candidate in enumerate(candidates):
            text = ",".join(str(value) for value in candidate)
            command = f"{shlex.quote(sys.executable)} {shlex.quote(__file__)} --parameters={text}"
            place = pathlib.Path(folder) / f"{generation}-{number}"
            scores.append(score(graspbench.run(place, *options, "--policy", command)))
        best = candidates[np.argsort(scores)[::-1][:ELITE]]
        mean, spread = best.mean(axis=0), best.std(axis=0) + 0.02
        print(f"generation {generation}: best score {max(scores):.3f}, mean {np.mean(scores):.3f}; schedule {mean.round(2)}")


if sys.argv[1].startswith("--parameters="):
    graspbench.serve(Schedule([float(value) for value in sys.argv[1].split("=")[1].split(",")]))
else:
    learn(sys.argv[1], sys.argv[2:])
