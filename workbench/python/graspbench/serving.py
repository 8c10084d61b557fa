"""A controller as a child process of graspbench: messages on standard input, answers on standard output."""

import os
import struct
import sys

import numpy as np

from .messages import pack, unpack


def _as_arrays(facts):
    """Lists of numbers become arrays."""
    def convert(value):
        if not isinstance(value, list) or not value:
            return value
        flat = value[0] if isinstance(value[0], list) else value
        is_numbers = all(isinstance(item, (int, float)) for item in flat)
        return np.array(value, dtype=float) if is_numbers else value
    return {name: convert(value) for name, value in facts.items()}


def _read(stream, count):
    data = stream.read(count)
    if len(data) < count:
        raise EOFError
    return data


def serve(policy):
    """Answers graspbench until it closes the connection. What the controller prints goes to standard error.

    policy: an object with reset(facts) and act(observation), see the package's text.
    """
    answers = os.fdopen(os.dup(1), "wb", buffering=0)
    os.dup2(2, 1)  # print() must not come between the answers
    questions = os.fdopen(os.dup(0), "rb")
    try:
        while True:
            length = struct.unpack("<I", _read(questions, 4))[0]
            message = unpack(_read(questions, length))
            answer = {"number": message["number"]}
            if "reset" in message:
                policy.reset(_as_arrays(message["reset"]))
            else:
                answer.update(policy.act(message["observation"]))
            data = pack(answer)
            answers.write(struct.pack("<I", len(data)) + data)
    except (EOFError, BrokenPipeError):
        sys.stderr.flush()
