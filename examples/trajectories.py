#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""One bag in, trajectories out: runs the bag tool and reads what it writes.

usage: trajectories.py FILE.bag [--bag-tool PROGRAM] [--output DIR] [--plot FILE.png] [-- OPTION...]

What follows -- goes to the bag tool, e.g. -- --input rgbd.
"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np


def read_tum(path):
    """Rows of (stamp, x, y, z, qx, qy, qz, qw): poses in the world, the camera's first pose."""
    return np.loadtxt(path, ndmin=2)


def read_run(folder):
    """The trajectories (id 0: the camera), the labelled points and the summary of a run."""
    folder = pathlib.Path(folder)
    trajectories = {0: read_tum(folder / "camera.tum")}
    for path in sorted(folder.glob("motion_*.tum")):
        trajectories[int(path.stem.split("_")[1])] = read_tum(path)
    with open(folder / "labels.csv", newline="") as rows:
        labels = [(float(row["stamp"]), int(row["tracklet_id"]), float(row["u"]), float(row["v"]),
                   int(row["motion_id"])) for row in csv.DictReader(rows)]
    return {"trajectories": trajectories, "labels": labels,
            "summary": json.loads((folder / "summary.json").read_text())}


def path_length(poses):
    return float(np.linalg.norm(np.diff(poses[:, 1:4], axis=0), axis=1).sum())


def plot(trajectories, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots()
    for motion, poses in trajectories.items():
        axes.plot(poses[:, 1], poses[:, 3], label="camera" if motion == 0 else "motion %d" % motion)
    axes.set(xlabel="x [m]", ylabel="z [m]", aspect="equal")
    axes.legend()
    figure.savefig(path)


def main():
    own, others = sys.argv[1:], []
    if "--" in own:
        own, others = own[:own.index("--")], own[own.index("--") + 1:]
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag")
    parser.add_argument("--bag-tool", help="default: rosrun mvo bag")
    parser.add_argument("--output", help="keep the bag tool's files in this folder")
    parser.add_argument("--plot", help="draw the paths from above")
    arguments = parser.parse_args(own)
    tool = [arguments.bag_tool] if arguments.bag_tool else ["rosrun", "mvo", "bag"]
    if not shutil.which(tool[0]):
        sys.exit("trajectories.py: there is no %s; source the workspace or name it by --bag-tool"
                 % tool[0])
    with tempfile.TemporaryDirectory() as scratch:
        output = arguments.output or scratch + "/run"
        status = subprocess.call(tool + [arguments.bag, "--output", output, "--quiet"] + others)
        if status != 0:
            sys.exit(status)
        run = read_run(output)
    for motion, poses in run["trajectories"].items():
        seen = len({tracklet for _, tracklet, _, _, label in run["labels"] if label == motion})
        print("%-9s %4d poses, path %.3f m, %d tracklets" % (
            "camera" if motion == 0 else "motion %d" % motion, len(poses), path_length(poses), seen))
    if arguments.plot:
        plot(run["trajectories"], arguments.plot)


if __name__ == "__main__":
    main()
