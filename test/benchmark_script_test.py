#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/benchmark: exponents, limits, the comparison with an earlier run, and the script as its
users meet it, with programs that only say what they measured."""
import copy
import json
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "scripts")
sys.path.insert(0, SCRIPTS)
import benchmark_tables as tables  # noqa: E402


def times(median, p99=None):
    return {"median": median, "p99": p99 or 1.5 * median}


def size(name, warm, cold, y=10.0):
    """Steps of so many Y, on two threads half as many."""
    def run(of):
        return {"one_thread": {"cpu_ms": times(of * y), "wall_ms": times(1.1 * of * y)},
                "two_threads": {"cpu_ms": times(of * y), "wall_ms": times(0.5 * of * y)}}

    out = {"size": name, "window_frames": 48, "warm": run(warm), "cold": run(cold), "Y_ms": y,
           "Y_median_ms": 1.1 * y}
    for threads in out["warm"]:
        out["warm"][threads].update(motions=5, points=500, memory_mib=60,
                                    stages_ms={"track": 0.6 * warm * y, "total": warm * y})
    for threads in out["cold"]:
        out["cold"][threads].update(tracklets=1000, observations=17000, motions=5)
    return out


def results():
    return {
        "step": [size("640x480", 1.2, 4.5), size("1280x960", 2.0, 4.9)],
        "stages": {"Y_ms": 10.0, "best_ms": {"graph buildGraph/1000": 1.4}},
        "growth": {
            "Y_ms": 10.0,
            "tracklets": {"engine": [{"tracklets": n, "ms": 0.01 * n} for n in (250, 1000, 4000)]},
            "frames": {"engine": [{"ms": 0.1 * n} for n in (12, 48, 96)]},
            "motions": {"step": [{"ms": 5 + n} for n in (1, 5, 10)]},
        },
    }


class Tables(unittest.TestCase):
    def test_exponent_of_a_power_law(self):
        slope, factor = tables.exponent([(n, 3 * n**1.7) for n in (250, 1000, 4000)])
        self.assertAlmostEqual(slope, 1.7)
        self.assertAlmostEqual(factor, 3)
        self.assertEqual(tables.exponent([(5, 2.0), (5, 2.0)])[0], 0)

    def test_limits(self):
        self.assertEqual(tables.verdict(1.3, 1.3), "1.30")
        self.assertIn("> 1.3", tables.verdict(1.31, 1.3))
        rows = {row[0]: row for row in tables.step_rows(results()["step"])}
        self.assertEqual(rows["640x480 warm step"], ("640x480 warm step", "1.20", "1.3", "0.60",
                                                     "0.8"))
        self.assertEqual(rows["640x480 p99 / median of CPU time, warm"][1], "1.50")

    def test_growth_is_scaled_to_the_nominal_factor(self):
        growth = results()["growth"]
        row = tables.growth_rows(growth)[1]
        self.assertEqual((row[3], row[5]), ("4.00", "1.00"))
        growth["tracklets"]["engine"][2] = {"tracklets": 3000, "ms": 30}  # fewer came, less time
        self.assertEqual(tables.growth_rows(growth)[1][3], "4.00")

    def test_the_same_run_has_no_regression(self):
        self.assertEqual(tables.compare(results(), results(), 0), [])

    def test_a_faster_machine_is_no_regression(self):
        other = results()
        other["stages"] = {"Y_ms": 5.0, "best_ms": {"graph buildGraph/1000": 0.7}}
        self.assertEqual(tables.compare(results(), other, 0.01), [])

    def test_a_tampered_table_is_a_regression(self):
        then = results()
        then["step"][0]["warm"]["one_thread"]["cpu_ms"]["median"] /= 2
        then["stages"]["best_ms"]["graph buildGraph/1000"] /= 3
        worse = tables.compare(results(), then, 0.25)
        self.assertEqual([row[0] for row in worse],
                         ["stage graph buildGraph/1000", "step 640x480 warm one thread"])
        self.assertAlmostEqual(worse[0][3], 3)
        self.assertEqual(tables.compare(then, results(), 0.25), [])

    def test_the_tolerance_counts(self):
        then = results()
        then["growth"]["frames"]["engine"][1]["ms"] /= 1.2
        self.assertEqual(tables.compare(results(), then, 0.25), [])
        self.assertEqual(len(tables.compare(results(), then, 0.15)), 1)

    def test_what_only_one_run_has_is_not_compared(self):
        then = results()
        del then["step"]
        then["stages"]["best_ms"] = {"gone": 1.0}
        self.assertEqual(tables.compare(results(), then, 0), [])


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.programs = os.path.join(self.folder, "build-benchmark", "devel", "lib", "mvo")
        os.makedirs(self.programs)
        self.prints("step_benchmark", json.dumps({"step": results()["step"]}))
        self.prints("growth_benchmark", json.dumps({"growth": results()["growth"]}))
        self.output = os.path.join(self.folder, "output")

    def prints(self, name, text, status=0):
        path = os.path.join(self.programs, "mvo_" + name)
        with open(path, "w") as file:
            file.write("#!/bin/sh\ncat <<'END'\n%s\nEND\nexit %d\n" % (text, status))
        os.chmod(path, 0o755)

    def run_script(self, *arguments):
        environment = {**os.environ, "MVO_BUILD": os.path.join(self.folder, "build")}
        return subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "benchmark"), "--no-build", "--output",
             self.output, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            universal_newlines=True, check=False, env=environment, timeout=120)

    def earlier(self, change):
        path = os.path.join(self.folder, "earlier.json")
        then = copy.deepcopy(results())
        change(then)
        with open(path, "w") as file:
            json.dump(then, file)
        return path

    def test_tables_and_figures_are_left(self):
        done = self.run_script("--only", "step", "--only", "growth", "--against",
                               self.earlier(lambda _: None), "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("nothing is more than 25 % slower", done.stdout)
        with open(os.path.join(self.output, "benchmark.json")) as file:
            self.assertEqual(json.load(file)["step"], results()["step"])
        with open(os.path.join(self.output, "benchmark.md")) as file:
            self.assertIn("| 640x480 warm step ", file.read())
        self.assertFalse([name for name in os.listdir(self.output) if name.endswith(".part")])

    def test_a_regression_ends_the_check(self):
        def tamper(then):
            then["step"][1]["cold"]["two_threads"]["wall_ms"]["median"] /= 2

        arguments = ("--only", "step", "--against", self.earlier(tamper))
        done = self.run_script(*arguments, "--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("step 1280x960 cold two threads", done.stdout)
        self.assertEqual(self.run_script(*arguments).returncode, 0)

    def test_a_program_that_fails_leaves_nothing(self):
        for text, status, problem in (("", 3, "failed with status 3"), ("{", 0, "no JSON")):
            self.prints("step_benchmark", text, status)
            done = self.run_script("--only", "step")
            self.assertEqual(done.returncode, 1)
            self.assertIn("benchmark: step_benchmark", done.stderr)
            self.assertIn(problem, done.stderr)
            self.assertFalse(os.path.exists(self.output))

    def test_what_is_missing_is_named(self):
        os.remove(os.path.join(self.programs, "mvo_step_benchmark"))
        done = self.run_script("--only", "step")
        self.assertEqual(done.returncode, 1)
        self.assertIn("mvo_step_benchmark is missing", done.stderr)
        self.assertEqual(self.run_script("--only", "nothing").returncode, 2)
        self.assertEqual(self.run_script("--quick", "--record").returncode, 2)


if __name__ == "__main__":
    unittest.main()
