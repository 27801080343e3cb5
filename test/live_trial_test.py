#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""What scripts/live_trial makes of the messages that it saw."""
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import unittest

PATH = os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "scripts",
                    "live_trial")
sys.dont_write_bytecode = True
LOADER = importlib.machinery.SourceFileLoader("live_trial", PATH)
live_trial = importlib.util.module_from_spec(importlib.util.spec_from_loader("live_trial", LOADER))
LOADER.exec_module(live_trial)

PERIOD = 1 / 15


def run(count, latency=0.02, dropped=(), growth=0.0):
    """Frames and the motions that answer them."""
    frames = [{"kind": "frame", "at": 100 + k * PERIOD, "stamp": 10**9 * (100 + k)}
              for k in range(count)]
    motions = [{"kind": "motions", "done": f["at"] + latency, "at": f["at"] + latency,
                "stamp": f["stamp"], "lost": False, "resets": 0, "motions": 5,
                "mib": 100 + growth * k}
               for k, f in enumerate(frames) if k not in dropped]
    return frames, motions


class Figures(unittest.TestCase):
    def test_all_is_well(self):
        result = live_trial.figures(*run(148), PERIOD)
        self.assertEqual((result["frames"], result["dropped"]), (100, 0))
        self.assertAlmostEqual(result["latency_p99_ms"], 20)
        self.assertEqual(live_trial.complaints(result), [])

    def test_a_dropped_frame_counts_after_the_first_window(self):
        result = live_trial.figures(*run(149, dropped=(5, 90)), PERIOD)
        self.assertEqual((result["frames"], result["dropped"]), (100, 1))
        self.assertEqual(live_trial.complaints(result), ["1 frames dropped"])

    def test_frames_that_wait_for_an_answer_at_the_end(self):
        frames, motions = run(148)
        self.assertEqual(live_trial.figures(frames, motions[:-1], PERIOD)["dropped"], 0)
        self.assertGreater(live_trial.figures(frames, motions[:-40], PERIOD)["dropped"], 20)

    def test_latency_and_memory(self):
        late = live_trial.figures(*run(148, latency=0.07), PERIOD)
        self.assertEqual(live_trial.complaints(late), ["latency above the frame period"])
        grows = live_trial.figures(*run(148, growth=0.5), PERIOD)
        self.assertEqual(live_trial.complaints(grows), ["memory grows"])
        large = live_trial.figures(*run(148, growth=2), PERIOD)
        self.assertEqual(live_trial.complaints(large), ["more than 300 MiB", "memory grows"])

    def test_too_few_motions_are_an_error(self):
        with self.assertRaises(RuntimeError):
            live_trial.figures(*run(48), PERIOD)

    def test_quantile(self):
        self.assertEqual(live_trial.quantile(range(1, 101), 0.99), 99)
        self.assertEqual(live_trial.quantile([3, 1, 2], 0.5), 2)

    def test_period(self):
        frames, _ = run(10)
        self.assertAlmostEqual(live_trial.frame_period(frames, 2), 0.5)

    def test_wrong_arguments(self):
        for arguments in (["--size", "big"], ["--bag", "/nonexistent"]):
            done = subprocess.run([sys.executable, PATH, *arguments], stderr=subprocess.PIPE,
                                  check=False)
            self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main()
