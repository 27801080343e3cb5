#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files include what is on lower floors or in their own folder (CONTRIBUTING.md, "Where things live")."""
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent

# From the ground up. "mvo" is include/mvo, "" is src itself.
FLOORS = [
    ["mvo"],
    [""],
    ["kernels"],
    ["frontend", "engine", "trajectories"],
    ["odometry.cpp"],
    ["sim", "io"],
    ["eval"],
    ["edges"],
    ["ros", "rviz_plugin"],
    ["tools"],
]


def floor_of(folder):
    for number, folders in enumerate(FLOORS):
        if folder in folders:
            return number
    sys.exit(f"test/floors_test.py: folder {folder} has no floor")


def folder_of(path):
    """The folder that a file of include or src, or an included path, belongs to."""
    if str(path) == "odometry.cpp":  # a step puts the stages together
        return "odometry.cpp"
    return path.parts[0] if len(path.parts) > 1 else ""


def faults():
    for root in ("include", "src"):
        files = [f for f in (SOURCE / root).rglob("*") if f.suffix in (".cpp", ".hpp")]
        for file in sorted(files):
            folder = folder_of(file.relative_to(SOURCE / root))
            for number, line in enumerate(file.read_text().splitlines(), 1):
                included = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
                if not included:
                    continue
                target = pathlib.PurePosixPath(included.group(1))
                if not any((SOURCE / base / target).exists() for base in ("include", "src")):
                    continue  # generated
                other = folder_of(target)
                if other != folder and floor_of(other) >= floor_of(folder):
                    yield f"{file.relative_to(SOURCE)}:{number}: {target} is not on a lower floor"


found = list(faults())
for fault in found:
    print(fault)
sys.exit(1 if found else 0)
