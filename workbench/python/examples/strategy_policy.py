"""The thesis's strategy as a controller.

With the grip "posture", asked at every step of the physics (policy.period_s: that of sim.step_s), it asks for what the
program's own strategy asks for, to the last bit: each digit closes by its schedule, and the hand is lifted when its
force has settled.

    strategy_policy.py --grip margin

closes by the forces that it feels, at any period: each digit until it has its share of four times the force that would
bear the weight between opposed sides, the thumb until it has what balances the others. Then all of them are shifted
together until the sum is right. The program's own grip asks for twice the force that the contacts themselves need; the
controller does not know their directions and takes more.
"""

import sys

import numpy as np

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


MARGIN = 4.0
LEAST_FORCE = 0.7  # N, of a digit that does not oppose the others
TOUCH_SPEED = 0.25  # after the first touch, share of the speed before
SHIFT_TIME = 0.1  # s, in which an error of the sum falls to 1/e
DEAD_SHARE, BAND_SHARE, BAND_TIME = 0.02, 0.1, 0.2
MOST_CLOSING = 3.0  # of a digit that presses
LEAST_STIFFNESS = 1.0  # N per s


class FeltGrip(Strategy):
    def reset(self, facts):
        super().reset(facts)
        self.joint_of = [facts["joints"].index(name) for name in facts["driven"]]
        others = [digit for digit in self.schedules if digit != "TH"] or list(self.schedules)
        force = max(LEAST_FORCE, MARGIN * facts["weight"] / (2.0 * facts["friction"] * len(others)))
        self.asked = {digit: force for digit in self.schedules}
        if "TH" in self.asked:
            self.asked["TH"] = force * len(others)
        self.most = 1.0 if facts["grasp_type"] == "power" else MOST_CLOSING
        self.touched_at = {}
        self.regulates = False
        self.in_band = 0.0
        self.closed_since = 0.0

    def find_closing(self, digit, positions):
        """The part of its way that a digit has come."""
        mine = np.array([of == digit for of in self.driven])
        way = self.way[mine]
        moved = positions[self.joint_of][mine] - self.open[mine]
        return float(way @ moved / (way @ way)) if way.any() else 0.0

    def shift(self, forces, error):
        total = sum(self.asked.values())
        for digit in self.touched_at:
            risen = forces[digit] / max(self.closing[digit] - self.touched_at[digit], 1e-3)
            stiffness = max(LEAST_STIFFNESS, risen)
            step = self.asked[digit] / stiffness * error / total * self.period / SHIFT_TIME
            most = self.period / self.strategy["closure_time_s"]
            self.closing[digit] = float(np.clip(self.closing[digit] + np.clip(step, -most, most), 0.0, self.most))

    def act(self, observation):
        forces = dict(zip(self.digits, observation["digit_forces"]))
        for digit, touches in zip(self.digits, observation["digit_touches"]):
            if touches and digit in self.schedules and digit not in self.touched_at:
                here = self.find_closing(digit, observation["joint_positions"])
                self.closing[digit] = min(self.closing[digit], max(0.0, here))
                self.touched_at[digit] = self.closing[digit]
        total = sum(self.asked.values())
        felt = sum(forces[digit] for digit in self.schedules)
        self.num_steps += 1
        self.closing[""] = min(1.0, self.closing[""] + self.period / self.strategy["closure_time_s"])
        is_closing = False
        if not self.regulates:
            for digit, (delay, speed) in self.schedules.items():
                has_force = digit in self.touched_at and forces[digit] >= self.asked[digit]
                if has_force or self.num_steps <= round(delay / self.period) or self.closing[digit] >= 1.0:
                    continue
                share = TOUCH_SPEED if digit in self.touched_at else 1.0
                self.closing[digit] = min(1.0, self.closing[digit] + share * speed * self.period
                                          / self.strategy["closure_time_s"])
                is_closing = True
            self.regulates = observation["phase"] == 1.0 and felt > 0.0 and (felt >= total or not is_closing)
        elif abs(total - felt) > DEAD_SHARE * total:
            self.shift(forces, total - felt)
        is_in_band = self.regulates and abs(felt - total) <= BAND_SHARE * total
        self.in_band = self.in_band + self.period if is_in_band else 0.0
        time = observation["time_in_phase"]
        if is_closing:
            self.closed_since = time
        targets = self.open + np.array([self.closing[digit] for digit in self.driven]) * self.way
        done = observation["phase"] == 1.0 and (
            (self.in_band >= BAND_TIME and time >= self.strategy["stabilisation_min_time_s"])
            or time - self.closed_since >= self.strategy["stabilisation_max_time_s"])
        return {"targets": targets, "done": bool(done)}


graspbench.serve(FeltGrip() if sys.argv[1:] == ["--grip", "margin"] else Strategy())
