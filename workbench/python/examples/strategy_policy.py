"""The thesis's strategy with the grip "posture" as a controller.

Asked at every step of the physics (policy.period_s: that of sim.step_s) it asks for what the program's own strategy
asks for, to the last bit: each digit closes by its schedule, and the hand is lifted when its force has settled.
"""

import graspbench

STEADY_SHARE = 0.02  # the force has settled when it stays within this share
STEADY_TIME = 0.1  # s, for so long


class Strategy:
    def reset(self, facts):
        self.open = facts["open"]
        self.way = facts["closed"] - facts["open"]
        self.period = facts["period"]
        self.strategy = facts["strategy"]
        self.schedules = facts["grasping"]
        self.digits = facts["digits"]
        self.driven = [digit if digit in self.schedules else "" for digit in facts["driven_digits"]]
        self.closing = {digit: 0.0 for digit in [*self.schedules, ""]}
        self.touched = set()
        self.num_steps = 0
        self.settled_force = self.settled_since = 0.0
        self.phase = 0.0

    def close(self):
        """s of each digit, and of what does not grasp, after another period."""
        time = self.strategy["closure_time_s"]
        self.num_steps += 1
        for digit, (delay, speed) in self.schedules.items():
            if self.num_steps <= round(delay / self.period):
                continue
            share = self.strategy["touch_speed"] if digit in self.touched else 1.0
            self.closing[digit] = min(1.0, self.closing[digit] + share * speed * self.period / time)
        self.closing[""] = min(1.0, self.closing[""] + self.period / time)

    def is_steady(self, time, force):
        change = abs(force - self.settled_force)
        if self.closing[""] < 1.0 or change > STEADY_SHARE * self.settled_force:
            self.settled_since, self.settled_force = time, force
        return time - self.settled_since >= STEADY_TIME

    def act(self, observation):
        for digit, touches in zip(self.digits, observation["digit_touches"]):
            if touches:
                self.touched.add(digit)
        if observation["phase"] != self.phase:
            self.phase, self.settled_force, self.settled_since = observation["phase"], 0.0, 0.0
        self.close()
        targets = [start + self.closing[digit] * way
                   for start, digit, way in zip(self.open, self.driven, self.way)]
        done = False
        if self.phase == 1.0:
            time = observation["time_in_phase"] + self.period
            is_steady = self.is_steady(time, observation["grip_force"])
            done = (is_steady and time >= self.strategy["stabilisation_min_time_s"]
                    ) or time >= self.strategy["stabilisation_max_time_s"]
        return {"targets": targets, "done": bool(done)}


graspbench.serve(Strategy())
