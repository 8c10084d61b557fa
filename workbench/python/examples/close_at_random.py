"""Closes each driven joint at a speed of its own, drawn anew in each trial from its seed."""

import numpy as np

import graspbench


class CloseAtRandom:
    def reset(self, facts):
        random = np.random.default_rng(facts["seed"])
        self.open, self.way = facts["open"], facts["closed"] - facts["open"]
        self.speeds = random.uniform(0.2, 1.5, self.way.size)  # shares of the way per second

    def act(self, observation):
        time = observation["time"]
        closed = np.minimum(self.speeds * time, 1.0)
        return {"targets": self.open + closed * self.way, "done": time > 3.0}


graspbench.serve(CloseAtRandom())
