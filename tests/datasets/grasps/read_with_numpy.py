#!/usr/bin/env python3
"""numpy reads what `graspbench grasps convert` writes, with the numbers that it read itself from the
file before; where numpy is not installed, exit code 77."""

import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)

program, cases = sys.argv[1:]
for name in ("good_dexonomy.npy", "good_fortran.npy", "good_protocol_2.npy"):
    before = np.load(os.path.join(cases, name), allow_pickle=True)
    before = before.item() if isinstance(before, np.ndarray) else before
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "again.npy")
        subprocess.run([program, "grasps", "convert", os.path.join(cases, name), "--to",
                        "dexgraspbench", "--out", out], check=True, capture_output=True)
        after = np.load(out, allow_pickle=True).item()
    for key in ("pregrasp_qpos", "grasp_qpos", "squeeze_qpos"):
        a, b = (np.atleast_2d(np.asarray(d[key])) for d in (before, after))
        assert a.shape == b.shape and b.dtype == np.float64, (name, key, b.shape)
        sign = np.sign((a[:, 3:7] * b[:, 3:7]).sum(axis=1, keepdims=True))
        assert np.array_equal(a[:, :3], b[:, :3]) and np.array_equal(a[:, 7:], b[:, 7:]), (name, key)
        assert abs(sign * a[:, 3:7] - b[:, 3:7]).max() < 1e-13, (name, key)
print("numpy reads the same numbers")
