"""Trials step by step, for those who learn: reset(seed), step(action), as reinforcement learning has it.

The program runs as a child; its controller hands questions and answers on through two named pipes. What facts,
observations and actions are stands in the manual, page "Controllers"."""

import dataclasses
import json
import os
import pathlib
import select
import shutil
import struct
import subprocess
import tempfile

import numpy as np

from .messages import pack, unpack
from .results import find_program
from .serving import _as_arrays

# The same text for every Env: the ids of trials depend on it.
RELAY = 'cat "$GRASPBENCH_ENV/answers" & exec cat > "$GRASPBENCH_ENV/questions"'


@dataclasses.dataclass(frozen=True)
class Space:
    """Arrays of a shape between limits; a number has the shape ()."""

    shape: tuple
    low: np.ndarray = -np.inf
    high: np.ndarray = np.inf

    def contains(self, value):
        value = np.asarray(value, dtype=float)
        return value.shape == self.shape and bool(np.all((value >= self.low) & (value <= self.high)))

    def sample(self, random):
        """Between the limits, evenly. random: a numpy Generator."""
        return random.uniform(self.low, self.high, self.shape)


class Env:
    """Trials of one session after the other.

        env = graspbench.Env("--hand", "tum", "--object", "golf_ball")
        observation, info = env.reset(seed=1)
        observation, reward, terminated, truncated, info = env.step({"targets": info["facts"]["closed"]})

    options       as for `graspbench run`, without --policy, --jobs, --seed, --out and --resume
    trials        of each hand, object and grasp, in a session; then the next seed follows
    action_space  of `targets`; observation_space: a dict with a Space for each observation

    An action is a dict as controllers give it, or an array: targets of the driven joints. The reward is 1 at the end
    of a trial that succeeded, else 0; `terminated` comes after done, policy.time_s or a wrong answer, when the hand
    was lifted and the trial judged. Then info has outcome, reason and result, the trial's record.
    """

    def __init__(self, *options, trials=1000, folder=None):
        self._options, self._trials = [str(option) for option in options], trials
        self._own_folder = folder is None
        self.folder = pathlib.Path(folder or tempfile.mkdtemp(prefix="graspbench_env_"))
        self._process, self._last, self._num_sessions, self._seed = None, None, 0, None
        self._questions = self._answers = None
        self._reset_message = None  # of the trial that waits to begin
        self._fresh = None  # first observation of the trial that has begun and nobody has stepped
        try:
            self._start(1)
            self._begin()
        except BaseException:
            self.close()
            raise
        facts, first = self.facts, self._fresh
        self.action_space = Space((len(facts["driven"]),), facts["lower"], facts["upper"])
        self.observation_space = {name: Space(np.shape(value)) for name, value in first.items()}

    def reset(self, seed=None):
        """The next draw, or the first one of a seed; returns observation, info."""
        if seed is not None and (self._fresh is None or seed != self._seed or self._num_begun > 1):
            self._start(seed)
            self._begin()
        elif self._fresh is None:
            if self._reset_message is None:
                self._abandon()
            self._begin()
        observation, self._fresh = self._fresh, None
        return observation, {"facts": self.facts}

    def step(self, action):
        """Returns observation, reward, terminated, truncated, info. At the end the observation is the last one."""
        if self._last is None or self._fresh is not None:
            raise RuntimeError("the trial is over; call reset() first")
        answer = action if isinstance(action, dict) else {"targets": np.asarray(action, dtype=float)}
        self._write({"number": self._number, **answer})
        message = self._read()
        if message is not None and "observation" in message:
            self._number = message["number"]
            self._last = message["observation"]
            return self._last, 0.0, False, False, {"facts": self.facts}
        self._reset_message = message
        record = self._find_record()
        result = record["result"]
        info = {"facts": self.facts, "outcome": result["outcome"], "reason": result.get("reason", ""), "result": result}
        last, self._last = self._last, None
        return last, float(result["outcome"] == "success"), True, False, info

    def close(self):
        """Ends the program; the folder goes, unless it was given."""
        self._stop()
        if self._own_folder:
            shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _start(self, seed):
        self._stop()
        self._num_sessions += 1
        self._seed, self._num_begun = seed, 0
        self._place = self.folder / f"{self._num_sessions:05d}"
        self._place.mkdir(parents=True)
        for name in ("questions", "answers"):
            os.mkfifo(self._place / name)
        self._questions = os.open(self._place / "questions", os.O_RDWR)  # both: no end before the program's
        self._answers = os.open(self._place / "answers", os.O_RDWR)
        self._errors = open(self._place / "errors.txt", "w+")
        self._process = subprocess.Popen(
            [find_program(), "run", "--out", str(self._place / "session"), "--jobs", "1", "--seed", str(seed),
             "--trials", str(self._trials), "--set", "policy.timeout_s=3600", "--policy", RELAY, *self._options],
            env=dict(os.environ, GRASPBENCH_ENV=str(self._place)), stdout=subprocess.DEVNULL, stderr=self._errors)
        self._reset_message = self._read()
        if self._reset_message is None:
            raise RuntimeError(f"graspbench run ended with {self._process.returncode}: {self._read_errors()}")

    def _stop(self):
        if self._process is None:
            return
        self._process.kill()
        self._process.wait()
        os.close(self._questions)
        os.close(self._answers)
        self._errors.close()
        self._process = self._last = self._fresh = self._reset_message = None

    def _begin(self):
        """The trial that waits, or the first one of the next seed."""
        if self._reset_message is None:
            self._start(self._seed + 1)
        self.facts = _as_arrays(self._reset_message["reset"])
        self._write({"number": self._reset_message["number"]})
        self._reset_message = None
        self._num_begun += 1
        message = self._read()
        if message is None:
            raise RuntimeError(f"graspbench run ended: {self._read_errors()}")
        self._number, self._last = message["number"], message["observation"]
        self._fresh = self._last

    def _abandon(self):
        """Ends the trial that runs, as a wrong answer; the next one waits then."""
        self._write({"number": self._number, "error": "left"})
        self._reset_message = self._read()

    def _find_record(self):
        for journal in (self._place / "session/journal").glob("*.jsonl"):
            for line in reversed(journal.read_text().splitlines()):
                record = json.loads(line)
                if record["trial_id"] == self.facts["trial_id"]:
                    return record
        raise RuntimeError(f"the trial has no record: {self._read_errors()}")

    def _read_errors(self):
        self._errors.seek(0)
        return self._errors.read().strip()

    def _write(self, message):
        data = pack(message)
        data = struct.pack("<I", len(data)) + data
        while data:
            data = data[os.write(self._answers, data):]

    def _take(self, count):
        data = b""
        while len(data) < count:
            if select.select([self._questions], [], [], 0.1)[0]:
                data += os.read(self._questions, count - len(data))
            elif self._process.poll() is not None:
                return None
        return data

    def _read(self):
        """The program's next message; None: it has ended."""
        head = self._take(4)
        data = head and self._take(struct.unpack("<I", head)[0])
        return data and unpack(data)
