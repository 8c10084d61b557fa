"""Controllers of others against the built program.

    controllers_test.py PROGRAM SOURCE [TEST..]

The oracle of a right controller is the program's own strategy; wrong ones have their outcome by hand."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
EXAMPLES = SOURCE / "workbench/python/examples"
PYTHON = sys.executable
MARK = f"CONTROLLERS_TEST={os.getpid()}"  # of all that this test starts
ENVIRONMENT = dict(os.environ, PYTHONPATH=str(SOURCE / "workbench/python"), NO_COLOR="1",
                   **dict([MARK.split("=")]))
SMALL = {"--hand": "tum", "--object": "golf_ball", "--trials": "2", "--jobs": "1"}

# What each wrong controller writes to an observation; `a` writes an answer of this dict, `raw` bytes.
HEAD = """
import os, struct, sys, time
import numpy as np
from graspbench.messages import pack, unpack
out = os.fdopen(1, "wb", buffering=0)
source = os.fdopen(0, "rb")
def raw(data): out.write(data)
def a(answer):
    data = pack(answer)
    raw(struct.pack("<I", len(data)) + data)
count = 0
while True:
    head = source.read(4)
    if len(head) < 4: break
    message = unpack(source.read(struct.unpack("<I", head)[0]))
    n = message["number"]
    if "reset" in message:
        facts = message["reset"]
        num = len(facts["driven"])
        count = 0
        RESET
        continue
    count += 1
    good = {"number": n, "targets": np.array(facts["open"], float)}
    BODY
"""

WRONG = {  # name: (body, part of the reason)
    "wrong shape": ("a({'number': n, 'targets': np.zeros(num + 1)})", "has the shape"),
    "matrix of the wrong width": ("a({'number': n, 'targets': np.zeros((2, 3, num))})", "has the shape"),
    "not a number": ("a({'number': n, 'targets': np.full(num, np.nan)})", "holds NaN"),
    "infinite": ("a({'number': n, 'increments': np.full(num, np.inf)})", "infinite number"),
    "huge chunk": ("a({'number': n, 'targets': np.zeros((5000, num))})", "5000 rows"),
    "texts": ("a({'number': n, 'targets': 'closed'})", "no array of numbers"),
    "nothing": ("a({'number': n})", "no targets"),
    "unknown key": ("a({**good, 'grip': 1})", 'has the key "grip"'),
    "refuses": ("a({'number': n, 'error': 'I am lost'})", 'gave up: "I am lost"'),
    "no number": ("a({'targets': np.zeros(num)})", "lacks the number"),
    "garbage": ("raw(b'hello, world')", "Does it print to its standard output"),
    "flood": ("raw(b'y\\n' * 5000000)", "Does it print to its standard output"),
    "answers twice": ("a(good); a(good)", "when it was asked question"),
    "wrong number": ("a({**good, 'number': n + 1})", "when it was asked question"),
    "no MessagePack": ("raw(struct.pack('<I', 1) + b'\\xc1')", "no MessagePack"),
    "a flood of errors": ("os.write(2, b'x' * 1000000); a({'number': n, 'error': 'enough'})", 'gave up: "enough"'),
    "ragged rows": ("a({'number': n, 'targets': np.zeros((2, num)), 'stiffness': np.ones((3, num))})", "stiffness has 3 rows"),
    "moves a hand that is placed": ("a({'number': n, 'hand_pose': [0, 0, 1, 1, 0, 0, 0]})", "expected hand-and-digits"),
    "no unit quaternion": ("a({'number': n, 'hand_pose': np.zeros(7)})", "has the length 0"),
    "hands over what is its own": ("a({'number': n, 'hold': 'margin'})", "expected digits-until-touch"),
    "an unknown grip": ("a({'number': n, 'hold': 'tight'})", "expected force or margin"),
    "wrong after a while": ("a(good) if count < 20 else a({'number': n, 'done': 'yes'})", "neither true nor false"),
}
LOST = {  # name: (body, part of the message)
    "exits mid-trial": ("a(good) if count < 20 else sys.exit(7)", "exit status 7"),
    "closed pipe": ("os.close(1); time.sleep(60)", "closed its standard output|has not answered"),
    "never answers": ("time.sleep(60)", "has not answered"),
    "half an answer": ("raw(struct.pack('<I', 100) + b'x'); time.sleep(60)", "has not answered"),
    "killed": ("os.kill(os.getpid(), 9)", "signal 9|exit status 137"),
    # Its child keeps the output open.
    "forks and leaves": ("os.fork() or (os.setsid(), time.sleep(600)); sys.exit(0)", "exit status 0"),
    "killed below a shell": ("os.fork() or time.sleep(600); os.kill(os.getpid(), 9)", "signal 9|exit status 137"),
}


def make_command(folder, *options):
    """A small session, but for what the options say."""
    small = [word for pair in SMALL.items() if pair[0] not in options for word in pair]
    return [PROGRAM, "run", *small, "--out", str(folder), *options]


def run(folder, *options, policy=None, expect=0, timeout=600):
    command = make_command(folder, *options)
    if policy is not None:
        command += ["--policy", policy]
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=timeout)
    assert done.returncode == expect, (done.returncode, done.stdout, done.stderr)
    return done.stdout + done.stderr


def records(folder):
    """By draw, as the journals have them."""
    found = {}
    for journal in sorted((pathlib.Path(folder) / "journal").glob("*.jsonl")):
        for line in journal.read_text().splitlines():
            record = json.loads(line)
            found[record["hand"], record["object"], record["grasp"], record["trial"]] = record
    return found


def without(record, *keys):
    if isinstance(record, dict):
        return {key: without(value, *keys) for key, value in record.items() if key not in keys}
    return record


def find_marked():
    """Controllers of this test, and what they started, that still run."""
    found = []
    for place in pathlib.Path("/proc").glob("[0-9]*/environ"):
        try:
            environment = place.read_bytes().split(b"\0")
            is_controller = any(text.startswith(b"GRASPBENCH_CONTROLLER=") for text in environment)
            if is_controller and MARK.encode() in environment:
                found.append(place.parent.name)
        except OSError:
            pass
    return found


class Controllers(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory(prefix="graspbench_controllers_")
        self.folder = pathlib.Path(self.place.name)

    def tearDown(self):
        self.place.cleanup()

    def example(self, name):
        return f"{PYTHON} {EXAMPLES / name}"

    def write(self, body, reset="a({'number': n})"):
        path = self.folder / "controller.py"
        path.write_text(HEAD.replace("RESET", reset).replace("BODY", body))
        return f"{PYTHON} {path}"

    def test_the_strategy_as_a_controller_has_the_strategys_records(self):
        more = ["--hand", "tum,shadow", "--object", "golf_ball,can"]
        run(self.folder / "own", *more, "--set", "strategy.grip=posture", "--set", "strategy.touch_speed=1")
        run(self.folder / "policy", *more, "--set", "policy.period_s=0.002",
            policy=self.example("strategy_policy.py"))
        own, policy = records(self.folder / "own"), records(self.folder / "policy")
        self.assertEqual(len(own), 8)
        for draw, record in own.items():
            self.assertEqual(without(record, "trial_id", "xxh64"), without(policy[draw], "trial_id", "xxh64", "policy"), draw)

    def test_examples_run(self):
        for name in ("do_nothing.py", "close_at_random.py", "grip_by_force.py"):
            run(self.folder / name, policy=self.example(name))
            for record in records(self.folder / name).values():
                self.assertNotEqual(record["result"]["outcome"], "wrong answer", name)
                self.assertIn("policy", record["result"])
        outcomes = [r["result"]["outcome"] for r in records(self.folder / "do_nothing.py").values()]
        self.assertEqual(outcomes, ["no contact"] * 2)

    def test_the_example_that_learns_runs(self):
        script = self.folder / "learn.py"
        text = (EXAMPLES / "learn_closing.py").read_text()
        counts = "GENERATIONS, CANDIDATES, ELITE = 4, 8, 3"
        self.assertIn(counts, text)
        script.write_text(text.replace(counts, "GENERATIONS, CANDIDATES, ELITE = 1, 2, 1"))
        done = subprocess.run([PYTHON, script, self.folder / "learned", "--hand", "tum", "--object", "golf_ball", "--trials", "1"],
                              env=dict(ENVIRONMENT, GRASPBENCH=PROGRAM), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("generation 0: best score", done.stdout)

    def test_the_manuals_controller_runs(self):
        page = (SOURCE / "workbench/manual/pages/controllers.md").read_text()
        script = self.folder / "close.py"
        script.write_text(page.split("(`close.py`):\n\n```text\n")[1].split("```")[0])
        run(self.folder / "s", "--hand", "tum,shadow", "--object", "golf_ball", policy=f"{PYTHON} {script}")
        for record in records(self.folder / "s").values():
            self.assertNotEqual(record["result"]["outcome"], "wrong answer", record["result"]["reason"])
            self.assertGreater(record["result"]["policy"]["num_questions"], 20)

    def resume(self, folder, *options, expect=0):
        done = subprocess.run([PROGRAM, "run", "--resume", "--out", str(folder), *options], env=ENVIRONMENT,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_a_controller_that_has_changed_does_not_go_on(self):
        stop = self.folder / "stop"
        stop.touch()
        # The first trial is finished, the second one lost as long as `stop` exists.
        policy = self.write(f"sys.exit(1) if facts['trial_id'] != first and os.path.exists({str(stop)!r}) else a({{**good, 'done': True}})",
                            "first = facts['trial_id'] if 'first' not in globals() else first; a({'number': n})")
        folder = self.folder / "s"
        run(folder, policy=policy, expect=5)
        script = self.folder / "controller.py"
        text = script.read_text()
        stop.unlink()
        script.write_text(text + "# changed\n")
        refused = self.resume(folder, expect=2)
        self.assertIn(f"{script}: SHA-256", refused)
        self.assertIn("has changed since it was started", refused)
        refused = self.resume(folder, "--policy", "python3 other.py", expect=2)
        self.assertIn("policy.command", refused)
        self.assertIn("or start another session with --out", refused)
        for other in ("hands", "objects", "trials"):  # nobody gave them
            self.assertNotIn(other, refused.split("(there and now):")[1].split("resume it")[0])
        script.write_text(text)
        self.resume(folder, "--policy", policy)
        self.assertEqual(len(records(folder)), 2)

    def test_another_controller_gets_another_folder(self):
        script = self.folder / "close.py"
        script.write_text((EXAMPLES / "do_nothing.py").read_text())
        command = [PROGRAM, "run", *(word for pair in SMALL.items() for word in pair), "--policy", f"{PYTHON} {script}"]
        for _ in range(2):
            subprocess.run(command, env=ENVIRONMENT, cwd=self.folder, check=True, capture_output=True)
        self.assertEqual(len(list((self.folder / "results").iterdir())), 1)
        script.write_text(script.read_text() + "# changed\n")
        subprocess.run(command, env=ENVIRONMENT, cwd=self.folder, check=True, capture_output=True)
        self.assertEqual(len(list((self.folder / "results").iterdir())), 2)

    def test_thresholds_of_a_controller_that_hands_the_grip_over(self):
        body = ("t = np.array(facts['open']) + min(1.0, 0.02 * count) * (np.array(facts['closed']) - np.array(facts['open'])); "
                "touches = any(message['observation']['digit_touches']); "
                "a({'number': n, 'targets': t, **({'hold': 'margin'} if touches else {})})")
        folder = self.folder / "until"
        policy = self.write(body)
        run(folder, "--hand", "shadow", "--object", "can", "--set", "policy.moves=digits-until-touch", policy=policy)
        def search(folder):
            return subprocess.run([PROGRAM, "threshold", str(folder), "--jobs", "1"], env=ENVIRONMENT, capture_output=True, text=True)
        done = search(folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("can", done.stdout)
        run(self.folder / "own", "--hand", "shadow", "--object", "can")
        self.assertEqual(search(self.folder / "own").returncode, 0)
        done = subprocess.run([PROGRAM, "compare", str(self.folder / "own"), str(folder)], env=ENVIRONMENT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("thresholds", done.stdout)
        run(self.folder / "digits", policy=self.example("close_at_random.py"))
        self.assertIn("expected digits-until-touch", search(self.folder / "digits").stderr)

    def test_wrong_answers_are_outcomes(self):
        for name, (body, reason) in WRONG.items():
            with self.subTest(name):
                folder = self.folder / name.replace(" ", "_")
                run(folder, policy=self.write(body))
                found = records(folder)
                self.assertEqual(len(found), 2)
                for record in found.values():
                    self.assertEqual(record["result"]["outcome"], "wrong answer")
                    self.assertIn(reason, record["result"]["reason"])
        self.assertEqual(find_marked(), [])

    def test_lost_controllers_leave_trials_unfinished(self):
        for name, (body, reason) in LOST.items():
            with self.subTest(name):
                folder = self.folder / name.replace(" ", "_")
                patience = 5 if "has not answered" in reason else 60
                text = run(folder, "--set", f"policy.timeout_s={patience}", policy=self.write(body), expect=5)
                self.assertRegex(text, reason)
                self.assertIn("lost in 2 trials", text)
                self.assertEqual(records(folder), {})
                self.assertEqual(find_marked(), [])

    def test_a_controller_that_ended_is_found_at_once_whatever_it_started(self):
        policy = self.write("os.fork() or time.sleep(600); sys.exit(3)")
        begun = time.monotonic()
        text = run(self.folder / "s", "--set", "policy.timeout_s=300", policy=policy + "; exit 4", expect=5)
        self.assertIn("exit status 4", text)
        self.assertLess(time.monotonic() - begun, 100)
        self.assertEqual(find_marked(), [])

    def test_the_hand_moves_and_is_told_what_the_record_says(self):
        body = """
    o = message["observation"]
    if count == 1:
        goal = np.concatenate([facts["grasp_position"], facts["grasp_rotation"]])
    way = facts["closed"]
    answer = {"number": n, "hand_pose": goal, "done": count > 90}
    if count > 15: answer["targets"] = np.array(facts["open"]) + min(1.0, 0.02 * (count - 15)) * (np.array(way) - np.array(facts["open"]))
    a(answer)
"""
        folder = self.folder / "moves"
        run(folder, "--hand", "shadow", "--object", "can", "--set", "policy.moves=hand-and-digits", "--set", "policy.object_pose=camera",
            policy=self.write(body.strip("\n").lstrip()))
        for record in records(folder).values():
            self.assertNotEqual(record["result"]["outcome"], "wrong answer", record["result"]["reason"])
            self.assertIn("X_WH", record["result"]["policy"]["rows"][0])
            self.assertEqual(record["result"]["policy"]["object_pose"], "camera")
            self.assertIn("told_X_WO", record["result"]["policy"])
        done = subprocess.run([PROGRAM, "replay", str(folder), "--all", "--verify"], env=ENVIRONMENT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_program_takes_the_grip_over(self):
        folder = self.folder / "until"
        body = ("t = np.array(facts['open']) + min(1.0, 0.02 * count) * (np.array(facts['closed']) - np.array(facts['open'])); "
                "touches = any(message['observation']['digit_touches']); "
                "a({'number': n, 'targets': t, **({'hold': 'margin'} if touches else {})})")
        run(folder, "--hand", "shadow", "--object", "can", "--set", "policy.moves=digits-until-touch", policy=self.write(body))
        for record in records(folder).values():
            self.assertEqual(record["result"]["outcome"], "success", record["result"]["reason"])
            self.assertIn("grip", record["result"])
            self.assertEqual(record["result"]["policy"]["rows"][-1]["hold"], "margin")

    def test_pictures_are_bytes_of_their_size(self):
        folder = self.folder / "pictures"
        body = ("p = message['observation']['picture']; "
                "a({**good, 'done': True} if p.dtype == np.uint8 and p.shape == (96, 96, 3) and p.std() > 5 else {'number': n, 'error': str(p.shape)})")
        run(folder, "--set", "policy.picture_px=96", policy=self.write(body))
        for record in records(folder).values():
            self.assertEqual(record["result"]["outcome"], "no contact", record["result"]["reason"])

    def test_a_trial_after_a_lost_one_gets_a_new_process(self):
        once = self.folder / "once"
        body = f"open({str(once)!r}, 'x').close() or sys.exit(1) if not os.path.exists({str(once)!r}) else a({{**good, 'done': True}})"
        policy = self.write(body)
        text = run(self.folder / "s", policy=policy, expect=5)
        self.assertIn("lost in 1 trial,", text)
        self.assertEqual(len(records(self.folder / "s")), 1)
        done = subprocess.run([PROGRAM, "run", "--resume", "--out", str(self.folder / "s")], env=ENVIRONMENT,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(records(self.folder / "s")), 2)

    def test_a_controller_may_take_longer_to_start_than_to_answer(self):
        policy = self.write("a({**good, 'done': True})", "time.sleep(2); a({'number': n})")
        run(self.folder / "s", "--set", "policy.timeout_s=1", policy=policy)

    def test_late_answers_change_nothing(self):
        run(self.folder / "prompt", policy=self.write("a({**good, 'done': count > 5})"))
        run(self.folder / "late", policy=self.write("time.sleep(0.05); a({**good, 'done': count > 5})"))
        self.assertEqual([without(r, "trial_id", "xxh64") for r in records(self.folder / "prompt").values()],
                         [without(r, "trial_id", "xxh64") for r in records(self.folder / "late").values()])

    def test_records_need_no_controller(self):
        script = self.folder / "gone.py"
        script.write_text((EXAMPLES / "close_at_random.py").read_text())
        folder = self.folder / "s"
        run(folder, policy=f"{PYTHON} {script}")
        script.unlink()
        first = next(iter(records(folder).values()))["trial_id"]
        for command in (["replay", str(folder), "--all", "--verify"], ["trial", str(folder), first],
                        ["judge", str(folder)], ["report", str(folder), "--out", str(self.folder / "r")],
                        ["verify", str(folder)]):
            done = subprocess.run([PROGRAM, *command], env=ENVIRONMENT, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, (command, done.stdout, done.stderr))

    def test_killed_and_resumed_the_same_bytes(self):
        policy = self.example("close_at_random.py")
        num_kills = int(os.environ.get("GRASPBENCH_NUM_KILLS", "2"))
        more = ["--trials", str(2 + num_kills * num_kills // 8)]  # so that there is something left to kill
        run(self.folder / "whole", *more, policy=policy)
        whole = records(self.folder / "whole")
        folder = self.folder / "killed"
        for kill in range(num_kills):
            command = make_command(folder, *more, "--policy", policy)
            if kill:
                command = [PROGRAM, "run", "--resume", "--out", str(folder), "--jobs", "1"]
            process = subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            time.sleep(0.3 + 0.1 * (kill % 5))
            process.send_signal(signal.SIGKILL)
            process.wait()
        if not (folder / "session.json").exists():
            run(folder, *more, policy=policy)
        else:
            subprocess.run([PROGRAM, "run", "--resume", "--out", str(folder)], env=ENVIRONMENT, check=True,
                           capture_output=True)
        self.assertEqual(records(folder), whole)

    def test_results_in_python(self):
        sys.path.insert(0, ENVIRONMENT["PYTHONPATH"])
        os.environ["GRASPBENCH"] = PROGRAM
        import graspbench
        try:
            import h5py
            import pandas
        except ImportError as missing:
            self.skipTest(f"Debian's package of {missing.name} is not installed")
        folder = graspbench.run(self.folder / "s", *make_command("")[2:-2])
        self.assertEqual(graspbench.run(folder), folder)
        table = graspbench.load(folder)
        whole = records(folder)
        self.assertEqual(list(table["trial_id"]), [record["trial_id"] for record in whole.values()])
        self.assertEqual(table.attrs["columns"]["weight_n"]["unit"], "N")
        first = next(iter(whole.values()))
        self.assertEqual(table["weight_n"][0], first["result"]["weight_n"])
        trial = graspbench.trial(folder, first["trial_id"])
        self.assertEqual(trial["attrs"]["outcome"], first["result"]["outcome"])
        time_s = trial["states"]["time_s"]
        self.assertAlmostEqual(time_s[-1], first["result"]["simulated_time_s"], places=9)
        self.assertEqual(len(trial["actions"]["FFq1_rad"]), len(time_s))
        with self.assertRaisesRegex(RuntimeError, "graspbench trial ended with"):
            graspbench.trial(folder, "nothing")

    def test_a_setting_without_a_controller_is_refused(self):
        text = run(self.folder / "s", "--set", "policy.period_s=0.01", expect=3)
        self.assertIn("policy.command is empty", text)
        for setting, part in (("policy.moves=feet", 'no moves "feet"'),
                              ("policy.hand_speed_m_per_s=0.2", "has no effect while policy.moves is digits"),
                              ("policy.object_pose=far", 'no object pose "far"')):
            self.assertIn(part, run(self.folder / "s", "--set", setting, policy="true", expect=3))
        text = run(self.folder / "s", "--hand", "tum-original", "--set", "policy.picture_px=64", policy="true", expect=2)
        self.assertIn("has no camera to show to the controller", text)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
