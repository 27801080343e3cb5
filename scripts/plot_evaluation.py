#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of one or more evaluations (JSON files of `rosrun mvo evaluate`).

camera.png        translation and rotation error of the camera (Fig. 6)
body_<id>.png     the same of each body (Fig. 7)
motion_count.png  motions found, line and cumulative histogram (Fig. 4)
timing.png        time per stage

Several evaluations, e.g. of two engines, share the motion count; the other figures are drawn for
the first.
"""
import argparse
import json
import os
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    sys.exit("plot_evaluation: the figures need matplotlib: apt install python3-matplotlib")

COUNT_COLORS = ("tab:blue", "tab:red", "tab:green", "tab:purple")


def save(figure, path):
    """A figure that is there or not, never half of it."""
    part = path + ".part"
    figure.savefig(part, format="png", dpi=120, bbox_inches="tight")
    os.replace(part, path)
    pyplot.close(figure)
    print(path)


def with_gaps(frames, values, ids):
    """Breaks the line where frames are missing or the id changes."""
    x, y = [], []
    for i, (frame, value) in enumerate(zip(frames, values)):
        if i and (frame != frames[i - 1] + 1 or ids[i] != ids[i - 1]):
            x.append(frame - 0.5)
            y.append(float("nan"))
        x.append(frame)
        y.append(value)
    return x, y


def draw_errors(curve, title, path):
    figure, (upper, lower) = pyplot.subplots(2, 1, sharex=True, figsize=(8, 5))
    for axes, key, names, unit in ((upper, "xyz_m", ("x", "y", "z"), "Tran. error [m]"),
                                   (lower, "rpy_deg", ("roll", "pitch", "yaw"), "Rot. error [deg]")):
        for axis, name in enumerate(names):
            values = [value[axis] for value in curve[key]]
            # A lone frame is no line, hence the small points.
            axes.plot(*with_gaps(curve["frame"], values, curve["id"]), marker=".", markersize=2,
                      linewidth=1, label=name)
        axes.axhline(0, color="0.7", linewidth=0.5, zorder=0)
        axes.set_ylabel(unit)
        axes.legend(ncol=3, fontsize="small", loc="upper left")
    upper.set_title(title)
    lower.set_xlabel("Frame")
    save(figure, path)


def draw_counts(evaluations, labels, path):
    figure, (line, histogram) = pyplot.subplots(1, 2, figsize=(11, 3.5),
                                                gridspec_kw={"width_ratios": (2, 1)})
    counts = [evaluation["curves"]["motion_count"] for evaluation in evaluations]
    frames = range(len(counts[0]["found"]))
    line.fill_between(frames, [least - 0.2 for least in counts[0]["least"]],
                      [most + 0.2 for most in counts[0]["most"]], step="mid", color="0.85",
                      label="true range")
    numbers = range(max(max(count["found"] + count["most"]) for count in counts) + 1)
    width = 0.8 / len(counts)
    for i, (evaluation, count, label) in enumerate(zip(evaluations, counts, labels)):
        color = COUNT_COLORS[i % len(COUNT_COLORS)]
        right = evaluation["motion_count"]["right_number_pct"]
        line.step(range(len(count["found"])), count["found"], where="mid", color=color,
                  linewidth=1.2, label="%s (%.1f %% right)" % (label, right))
        histogram.bar([number + (i - (len(counts) - 1) / 2) * width for number in numbers],
                      [count["found"].count(number) for number in numbers], width, color=color,
                      label=label)
    line.set_xlabel("Frame")
    line.set_ylabel("Motions")
    line.set_ylim(0, numbers[-1] + 1)
    line.yaxis.get_major_locator().set_params(integer=True)
    line.legend(fontsize="small")
    histogram.set_xlabel("Motions found")
    histogram.set_ylabel("Frames")
    histogram.set_xticks(list(numbers))
    save(figure, path)


def draw_timing(timing, path):
    stages = [stage for stage in timing if stage != "step"]
    figure, axes = pyplot.subplots(figsize=(7, 0.9 + 0.3 * len(stages)))
    axes.barh(stages, [timing[stage]["median"] for stage in stages], color="tab:blue",
              label="median")
    axes.plot([timing[stage]["p95"] for stage in stages], stages, "k|", label="95 %")
    axes.invert_yaxis()
    axes.set_xlabel("ms")
    axes.set_title("step: median %.1f ms" % timing["step"]["median"])
    axes.legend(fontsize="small")
    save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("evaluation", nargs="+", help="JSON file of rosrun mvo evaluate")
    parser.add_argument("--output", required=True, help="folder for the figures")
    parser.add_argument("--label", action="append", default=[],
                        help="name of an evaluation in the legend, once per evaluation")
    options = parser.parse_args()

    evaluations = []
    for path in options.evaluation:
        with open(path) as file:
            evaluations.append(json.load(file))
    names = [os.path.basename(os.path.normpath(evaluation.get("estimate", path)))
             for evaluation, path in zip(evaluations, options.evaluation)]
    labels = options.label + names[len(options.label):]
    os.makedirs(options.output, exist_ok=True)

    first = evaluations[0]
    curves = first["curves"]
    if "camera" in curves:
        draw_errors(curves["camera"], "Camera", os.path.join(options.output, "camera.png"))
    for body, curve in curves.get("bodies", {}).items():
        if curve["frame"]:
            draw_errors(curve, "Body " + body, os.path.join(options.output, "body_%s.png" % body))
    if all("motion_count" in evaluation["curves"] for evaluation in evaluations):
        draw_counts(evaluations, labels, os.path.join(options.output, "motion_count.png"))
    if "timing_ms" in first:
        draw_timing(first["timing_ms"], os.path.join(options.output, "timing.png"))


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, KeyError) as error:
        sys.exit("plot_evaluation: %s: %s" % (type(error).__name__, error))
