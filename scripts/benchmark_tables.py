# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""What scripts/benchmark makes of its programs' times: tables in units of the yardstick Y, fitted
exponents, and the comparison with an earlier run.

Results are a dictionary with the sections that were run:
  step    per image size: warm and cold steps on one thread and on two [ms], and Y_ms
  stages  {"Y_ms": ms, "best_ms": {case of Google Benchmark: ms}}
  growth  {axis: {"engine" or "step": [{"ms": ms, ...}, ...]}}, and Y_ms
"""
import math

SECTIONS = ("step", "stages", "growth")
THREADS = (("one_thread", "cpu_ms"), ("two_threads", "wall_ms"))  # and the time that counts

# At most so many Y: warm by image size, cold at every size; and the tail of warm steps.
REQUIRED_WARM = {"640x480": (1.3, 0.8), "1241x376": (1.3, 0.8), "1280x960": (2.2, 1.4)}
REQUIRED_COLD = (5, 3)
REQUIRED_TAIL = (2, 2)
# Axis of growth: what is varied, in steps of; the pair that counts, its factor in time.
AXES = {
    "tracklets": ((250, 1000, 4000), (1, 2), 5),
    "frames": ((12, 48, 96), (1, 2), 2.2),
    "motions": ((1, 5, 10), (1, 2), 1.5),
}

# Y below which a stage's share of a step is noise.
STEP_SLACK = 0.02


def flat(results):
    """{name: time in Y} of everything that a later run is compared by."""
    out = {}
    for size in results.get("step", []):
        y = size["Y_ms"]
        for kind in ("warm", "cold"):
            for threads, part in THREADS:
                run = size[kind][threads]
                name = "step %s %s %s" % (size["size"], kind, threads.replace("_", " "))
                out[name] = run[part]["median"] / y
                for stage, ms in run.get("stages_ms", {}).items():
                    out[name + ", " + stage] = ms / y
    stages = results.get("stages", {})
    for name, ms in stages.get("best_ms", {}).items():
        out["stage " + name] = ms / stages["Y_ms"]
    growth = results.get("growth", {})
    for axis, (settings, _, _) in AXES.items():
        for part, rows in growth.get(axis, {}).items():
            for setting, row in zip(settings, rows):
                out["growth %s %d, %s" % (axis, setting, part)] = row["ms"] / growth["Y_ms"]
    return out


def compare(now, then, tolerance):
    """(name, then, now, ratio) of all times that both runs have and that grew by more than the
    tolerance (a share), the worst first."""
    now, then = flat(now), flat(then)
    worse = []
    for name in now:
        if name not in then or then[name] <= 0:
            continue
        slack = STEP_SLACK if name.startswith("step") else 0
        if now[name] > (1 + tolerance) * then[name] + slack:
            worse.append((name, then[name], now[name], now[name] / then[name]))
    return sorted(worse, key=lambda row: -row[3])


def exponent(points):
    """Slope of log time over log count by least squares, and the factor: t = factor * n^slope."""
    x = [math.log(n) for n, _ in points]
    y = [math.log(t) for _, t in points]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    spread = sum((a - mean_x)**2 for a in x)
    slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / spread if spread else 0.0
    return slope, math.exp(mean_y - slope * mean_x)


def growth_points(axis, part, rows):
    """(count, ms) as they were found, where they can differ from what was asked for."""
    settings = AXES[axis][0]
    if axis != "tracklets":
        return [(setting, row["ms"]) for setting, row in zip(settings, rows)]
    count = "tracklets" if part == "engine" else "points"
    return [(row[count], row["ms"]) for row in rows]


def verdict(value, limit):
    return "%.2f" % value + ("" if value <= limit else " **> %g**" % limit)


def step_rows(sizes):
    rows = [("[Y]", "one thread", "at most", "two threads", "at most")]

    def add(name, values, limits):
        rows.append((name, verdict(values[0], limits[0]), "%g" % limits[0],
                     verdict(values[1], limits[1]), "%g" % limits[1]))

    def median(size, kind):
        return [size[kind][threads][part]["median"] / size["Y_ms"] for threads, part in THREADS]

    none = (math.inf, math.inf)
    for size in sizes:
        add(size["size"] + " warm step", median(size, "warm"),
            REQUIRED_WARM.get(size["size"], none))
    for size in sizes:
        add(size["size"] + " cold step", median(size, "cold"), REQUIRED_COLD)
    for size in sizes:
        cpu = [size["warm"][threads]["cpu_ms"] for threads, _ in THREADS]
        add(size["size"] + " p99 / median of CPU time, warm",
            [c["p99"] / c["median"] for c in cpu], REQUIRED_TAIL)
    for size in sizes:
        wall = [size["warm"][threads]["wall_ms"]["p99"] / size["Y_ms"] for threads, _ in THREADS]
        rows.append((size["size"] + " p99 of wall time, warm", "%.2f" % wall[0], "", "%.2f" %
                     wall[1], ""))
    return rows


def window_rows(sizes):
    rows = [("", "Y [ms]", "Y, median [ms]", "frames", "tracklets", "observations", "points in view",
             "motions", "memory [MiB]")]
    for size in sizes:
        cold, warm = size["cold"]["one_thread"], size["warm"]["one_thread"]
        rows.append((size["size"], "%.2f" % size["Y_ms"], "%.2f" % size["Y_median_ms"],
                     size["window_frames"], "%.0f" % cold["tracklets"],
                     "%.0f" % cold["observations"], "%.0f" % warm["points"],
                     "%.0f" % warm["motions"], "%.0f" % warm["memory_mib"]))
    return rows


def stage_of_step_rows(sizes):
    columns = [(size, threads) for size in sizes for threads, _ in THREADS]
    rows = [["stage [Y]"] + ["%s, %s" % (size["size"], threads.replace("_", " "))
                             for size, threads in columns]]
    stages = []
    for size, threads in columns:
        stages += [s for s in size["warm"][threads]["stages_ms"] if s not in stages]
    for stage in sorted(stages, key=lambda s: s == "total"):
        rows.append([stage] + [
            "%.3f" % (size["warm"][threads]["stages_ms"].get(stage, 0) / size["Y_ms"])
            for size, threads in columns])
    return rows


def stage_rows(stages):
    rows = [("case", "best [ms]", "[Y]")]
    for name, ms in stages["best_ms"].items():
        rows.append((name, "%.4g" % ms, "%.4f" % (ms / stages["Y_ms"])))
    return rows


def growth_rows(growth):
    """Times between the counts that were found follow a power of the count, so that a factor is
    that for the count's nominal factor."""
    rows = [("", "times [Y]", "counts", "factor in time", "at most", "exponent")]
    for axis, (settings, (a, b), limit) in AXES.items():
        for part, found in growth.get(axis, {}).items():
            points = growth_points(axis, part, found)
            times = settings[b] / settings[a]
            power = math.log(points[b][1] / points[a][1]) / math.log(points[b][0] / points[a][0])
            rows.append(("%g times the %s, %s" % (times, axis, part),
                         " / ".join("%.2f" % (ms / growth["Y_ms"]) for _, ms in points),
                         " / ".join("%.0f" % n for n, _ in points),
                         verdict(times**power, limit) if part == "step" else
                         "%.2f" % times**power,
                         "%g" % limit, "%.2f" % exponent(points)[0]))
    return rows


def regression_rows(worse):
    rows = [("slower than recorded", "then [Y]", "now [Y]", "ratio")]
    return rows + [(name, "%.4f" % then, "%.4f" % now, "%.2f" % ratio)
                   for name, then, now, ratio in worse]
