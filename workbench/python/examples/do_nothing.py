"""Does nothing: the hand is lifted as it came."""

import graspbench


class DoNothing:
    def reset(self, facts):
        pass

    def act(self, observation):
        return {"done": True}


graspbench.serve(DoNothing())
