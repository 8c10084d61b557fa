"""Controllers of robot hands for graspbench's trials, and their results: run, load, trial; Env for those who learn.

A controller is a class with two methods. `reset(facts)` is called when a trial begins; `act(observation)`
is called every control period, and returns a dict: targets or increments of the driven joints, done.

    import graspbench

    class Close:
        def reset(self, facts):
            self.targets = facts["open"]

        def act(self, observation):
            self.targets = self.targets + 0.01
            return {"targets": self.targets, "done": observation["time"] > 3}

    graspbench.serve(Close())

Run it with `graspbench run --policy 'python3 close.py'`. What facts, observations and actions are
stands in the manual, page "Controllers".
"""

from .demonstrations import collect, read_demonstrations, write_demonstrations
from .env import Env
from .results import load, run, trial
from .serving import serve

__all__ = ["Env", "collect", "load", "read_demonstrations", "run", "serve", "trial", "write_demonstrations"]
