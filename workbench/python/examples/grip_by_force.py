"""Each grasping digit closes until it presses with its share of the grip, and then holds that force.

Set forces: twice the object's weight over a friction of 0.4 for the digits that stand against
each other, divided evenly on each side; a digit that alone stands against several gets their sum.
"""

import numpy as np

import graspbench

FRICTION = 0.4
MARGIN = 2.0
LEAST_FORCE = 0.7  # N, of a digit that does not oppose the others


class GripByForce:
    def reset(self, facts):
        self.open, self.way = facts["open"], facts["closed"] - facts["open"]
        self.period, self.speed = facts["period"], 1.0 / facts["strategy"]["closure_time_s"]
        self.digits = facts["digits"]
        self.grasping = list(facts["grasping"])
        others = max(1, len(self.grasping) - 1)
        side = MARGIN * facts["weight"] / (2.0 * FRICTION)
        force = max(LEAST_FORCE, side / others)
        self.asked = {digit: force * (others if digit == "TH" else 1) for digit in self.grasping}
        self.closing = {digit: 0.0 for digit in [*self.grasping, ""]}
        self.driven = [digit if digit in self.asked else "" for digit in facts["driven_digits"]]
        self.touched = set()
        self.steady = 0.0

    def act(self, observation):
        forces = dict(zip(self.digits, observation["digit_forces"]))
        errors = []
        for digit in self.grasping:
            if forces[digit] > 0.0:
                self.touched.add(digit)
            error = (self.asked[digit] - forces[digit]) / self.asked[digit]
            errors.append(error)
            # Freely at the strategy's speed; after the touch slower, and by the force that is missing.
            speed = self.speed if digit not in self.touched else 0.25 * self.speed * np.clip(2.0 * error, -1.0, 1.0)
            self.closing[digit] = float(np.clip(self.closing[digit] + speed * self.period, 0.0, 1.5))
        self.closing[""] = min(1.0, self.closing[""] + self.speed * self.period)
        self.steady = self.steady + self.period if np.max(np.abs(errors)) < 0.1 else 0.0
        closed = np.array([self.closing[digit] for digit in self.driven])
        is_done = (self.steady > 0.3 and observation["time"] > 0.5) or observation["time"] > 4.0
        return {"targets": self.open + closed * self.way, "done": is_done}


graspbench.serve(GripByForce())
