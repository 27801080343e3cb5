# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
"""Where mvo's programs are, for the scripts beside this file: in a source tree they are built
first, in an installed package they lie beside the scripts."""
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
IN_SOURCE_TREE = os.path.exists(os.path.join(HERE, "env.sh"))


def build():
    """Builds the programs if this is a source tree."""
    if IN_SOURCE_TREE:
        subprocess.run([os.path.join(HERE, "build")], check=True)


def program(name):
    """The path of `rosrun mvo <name>`."""
    if IN_SOURCE_TREE:
        cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
        folder = os.environ.get("MVO_BUILD") or os.path.join(cache, "mvo", "build")
        folder = os.path.join(folder, "devel", "lib", "mvo")
    else:
        folder = HERE
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        sys.exit("%s is missing; scripts/build makes it" % path)
    return path


def run(name, *arguments, quiet=False):
    """Runs a program; raises subprocess.CalledProcessError if it fails."""
    output = subprocess.DEVNULL if quiet else None
    subprocess.run([program(name)] + [str(argument) for argument in arguments], check=True,
                   stdout=output)


def evaluate(estimate, truth, json_path, *options):
    """The figures of `rosrun mvo evaluate`, also left in a file."""
    run("evaluate", estimate, truth, "--json", json_path, "--quiet", *options)
    with open(json_path) as file:
        return json.load(file)


def table(rows):
    """Rows of cells as a Markdown table; the first row is the head."""
    rows = [[str(cell) for cell in row] for row in rows]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |"
             for row in rows]
    lines.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(lines)
