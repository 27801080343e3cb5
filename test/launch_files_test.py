#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""What roslaunch makes of the launch files, without starting anything."""
import os
import subprocess
import unittest

LAUNCH = os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "launch")


def roslaunch(*arguments):
    return subprocess.run(["roslaunch", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=60, check=False)


def nodes(file, *arguments):
    result = roslaunch("--nodes", os.path.join(LAUNCH, file), *arguments)
    assert result.returncode == 0, result.stderr
    return sorted(result.stdout.split())


def arguments_of(file, node, *arguments):
    """The command line that roslaunch would start a node with."""
    result = roslaunch("--args=" + node, os.path.join(LAUNCH, file), *arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout


def parameters(file, *arguments):
    result = roslaunch("--dump-params", os.path.join(LAUNCH, file), *arguments)
    assert result.returncode == 0, result.stderr
    return dict(line.split(": ", 1) for line in result.stdout.splitlines() if ": " in line)


class LaunchFiles(unittest.TestCase):
    def test_all_files_are_tried_here(self):
        found = sorted(os.path.relpath(os.path.join(folder, name), LAUNCH)
                       for folder, _, names in os.walk(LAUNCH) for name in names)
        self.assertEqual(found, ["bag.launch", "cameras/realsense.launch", "cameras/stereo.launch",
                                 "cameras/zed.launch", "demo.launch", "mvo.launch"])

    def test_nodes(self):
        self.assertEqual(nodes("mvo.launch"), ["/mvo"])
        self.assertEqual(nodes("mvo.launch", "ns:=/robot", "name:=eyes", "rviz:=true"),
                         ["/robot/eyes", "/rviz"])
        self.assertEqual(nodes("demo.launch"), ["/mvo", "/rviz", "/stereo/simulator"])
        self.assertEqual(nodes("demo.launch", "rviz:=false", "input:=rgbd"),
                         ["/camera/simulator", "/mvo"])
        self.assertEqual(nodes("bag.launch", "bag:=x.bag", "rviz:=false"), ["/mvo", "/play"])
        for camera in ("realsense", "stereo", "zed"):
            self.assertEqual(nodes("cameras/%s.launch" % camera), ["/mvo"])

    def test_every_argument_is_explained(self):
        for file, needed in (("mvo.launch", ()), ("demo.launch", ()), ("bag.launch", ("bag:=x",)),
                             ("cameras/realsense.launch", ()), ("cameras/stereo.launch", ()),
                             ("cameras/zed.launch", ())):
            text = roslaunch("--ros-args", os.path.join(LAUNCH, file), *needed).stdout
            lines = [line for line in text.splitlines() if line.startswith("  ")]
            self.assertGreaterEqual(len(lines), 5, file)
            for line in lines:
                self.assertRegex(line, r": \S", file)

    def test_input_chooses_the_node(self):
        for kind, nodelet in (("stereo", "mvo/StereoNodelet"), ("rgbd", "mvo/RgbdNodelet")):
            self.assertIn(" %s " % kind, arguments_of("mvo.launch", "/mvo", "input:=" + kind))
            self.assertIn("load %s /camera/manager" % nodelet,
                          arguments_of("mvo.launch", "/mvo", "input:=" + kind,
                                       "manager:=/camera/manager"))

    def test_namespaces_of_cameras_give_topics(self):
        line = arguments_of("mvo.launch", "/mvo", "left:=/my/left", "right:=/my/right")
        self.assertIn("left/image_rect:=/my/left/image_rect", line)
        self.assertIn("left/camera_info:=/my/left/camera_info", line)
        self.assertIn("right/image_rect:=/my/right/image_rect", line)
        self.assertIn("right/camera_info:=/my/right/camera_info", line)
        line = arguments_of("mvo.launch", "/mvo", "left:=/my/left", "rectify:=true")
        self.assertIn("left/image_raw:=/my/left/image_raw", line)
        line = arguments_of("mvo.launch", "/mvo", "input:=rgbd", "rgb_image:=/a", "rgb_info:=/b",
                            "depth_image:=/c")
        self.assertIn("rgb/image_rect_color:=/a", line)
        self.assertIn("rgb/camera_info:=/b", line)
        self.assertIn("depth_registered/image_rect:=/c", line)
        line = arguments_of("mvo.launch", "/mvo", "mask_image:=/hood")
        self.assertIn("mask:=/hood", line)

    def test_presets_name_the_topics_of_their_drivers(self):
        line = arguments_of("cameras/realsense.launch", "/mvo")
        self.assertIn("rgb/image_rect_color:=/camera/color/image_raw", line)
        self.assertIn("depth_registered/image_rect:=/camera/aligned_depth_to_color/image_raw",
                      line)
        line = arguments_of("cameras/zed.launch", "/mvo", "camera:=/zed/zed_node")
        self.assertIn("right/image_rect:=/zed/zed_node/right/image_rect_color", line)
        line = arguments_of("cameras/stereo.launch", "/mvo")
        self.assertIn("right/image_raw:=/stereo/right/image_raw", line)
        self.assertEqual(parameters("cameras/stereo.launch")["/mvo/rectify"], "true")

    def test_arguments_replace_the_configuration_where_given(self):
        self.assertEqual(parameters("mvo.launch")["/mvo/queue"], "newest")
        given = parameters("mvo.launch", "queue:=all", "base_frame:=base_link", "max_interval:=0.1",
                           "mask:=/a/hood.png", "camera_errors:=/a/pair.json")
        self.assertEqual(given["/mvo/camera_errors"], "/a/pair.json")
        self.assertEqual(given["/mvo/mask"], "/a/hood.png")
        self.assertEqual(given["/mvo/queue"], "all")
        self.assertEqual(given["/mvo/base_frame"], "base_link")
        self.assertEqual(given["/mvo/max_interval"], "0.1")
        self.assertEqual(parameters("bag.launch", "bag:=x")["/mvo/queue"], "all")
        self.assertEqual(parameters("bag.launch", "bag:=x")["/use_sim_time"], "true")
        large = parameters("demo.launch", "width:=1280", "height:=960")
        self.assertEqual(large["/stereo/simulator/width"], "1280")
        self.assertEqual(large["/stereo/simulator/height"], "960")

    def test_recordings_play_what_is_listened_to(self):
        line = arguments_of("bag.launch", "/play", "bag:=x.bag", "image_transport:=compressed",
                            "loop:=true", "play_rate:=0.5")
        for part in ("--clock", "--loop", "--rate=0.5", "--bags=x.bag", "--wait-for-subscribers",
                     "/stereo/left/image_rect/compressed", "/stereo/right/camera_info",
                     "/tf_static"):
            self.assertIn(part, line)

    def test_mistakes_are_named(self):
        kinds = ("input:=stereo", "input:=rgbd")
        for arguments, words in ((("bag.launch",), ("requires the 'bag' arg",)),
                                 (("mvo.launch", "input:=lidar"), kinds),
                                 (("demo.launch", "input:=lidar"), kinds),
                                 (("mvo.launch", "config:=/no/such.yaml"), ("/no/such.yaml",))):
            result = roslaunch("--nodes", os.path.join(LAUNCH, arguments[0]), *arguments[1:])
            self.assertNotEqual(result.returncode, 0, arguments)
            for word in words:
                self.assertIn(word, result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
