#!/usr/bin/env python3
"""Figures of rehearsal_bars.sh: rehearsal_figures.py OUT [--left HAND FOLDERS]. Robust: held in 9 of 10
fresh draws. --left: folders of the objects whose rehearsed grasp is not. Intervals are bootstrapped over
objects."""
import collections
import csv
import os
import random
import sys


def interval(values):
    """95 % percentile interval of the mean over resampled objects."""
    rng = random.Random("rehearsal figures")
    means = sorted(sum(rng.choice(values) for _ in values) / len(values) for _ in range(4000))
    return means[100], means[3899]


def load(out, name):
    """Shares held by hand, object and kind of grasp."""
    held = collections.defaultdict(list)
    path = os.path.join(out, name, "export", "trials.csv")
    if os.path.exists(path):
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                kind = "rehearsed" if row["grasp"].startswith("rehearsed") else "predicted"
                held[row["hand"], row["object"], kind].append(row["outcome"] == "success")
    return {key: sum(trials) / len(trials) for key, trials in held.items()}


def list_objects(shares, hand):
    return sorted({key[1] for key in shares if key[0] == hand})


def main():
    out = sys.argv[1]
    fresh, wrong = load(out, "fresh"), load(out, "wrong")
    if "--left" in sys.argv:
        hand, folders = sys.argv[3], sys.argv[4].split(",")
        paths = [os.path.join(folder, o) for o in list_objects(fresh, hand)
                 if fresh[hand, o, "rehearsed"] < 0.9 for folder in folders
                 if os.path.isdir(os.path.join(folder, o))]
        print(",".join(paths))
        return
    for hand in ("tum", "shadow"):
        objects = list_objects(fresh, hand)
        print("%s, %d objects" % (hand, len(objects)))
        for name, shares in (("fresh draws", fresh), ("wrong model", wrong)):
            predicted = [shares[hand, o, "predicted"] for o in objects]
            rehearsed = [shares[hand, o, "rehearsed"] for o in objects]
            gain = [b - a for a, b in zip(predicted, rehearsed)]
            low, high = interval(gain)
            mean = [100 * sum(values) / len(values) for values in (predicted, rehearsed, gain)]
            print("  %s: predicted %.1f %%, rehearsed %.1f %%, gain %.1f points (%.1f to %.1f)" %
                  (name, mean[0], mean[1], mean[2], 100 * low, 100 * high))
        robust = [o for o in objects if fresh[hand, o, "rehearsed"] >= 0.9]
        predicted = [o for o in objects if fresh[hand, o, "predicted"] >= 0.9]
        oracle = load(out, "oracle-" + hand)
        more = [o for o in objects if o not in robust and
                (o in predicted or oracle.get((hand, o, "rehearsed"), 0) >= 0.9)]
        print("  robust: predicted %d, rehearsed %d, by any candidate %d" %
              (len(predicted), len(robust), len(robust) + len(more)))
        for o in objects:
            if fresh[hand, o, "rehearsed"] < 0.9:
                print("    %s: rehearsed %.1f, predicted %.1f, by 10 draws %.1f" %
                      (o, fresh[hand, o, "rehearsed"], fresh[hand, o, "predicted"],
                       oracle.get((hand, o, "rehearsed"), float("nan"))))


main()
