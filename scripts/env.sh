# SPDX-FileCopyrightText: 2026 the mvo authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sourced by the scripts beside it: an environment that does not depend on the caller's.
# Sets mvo_source and mvo_build; MVO_BUILD chooses another build folder (never inside the source:
# rosrun would find every program twice).

# The system's own python3 has ROS's modules, a pyenv's has not.
PATH=/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin:$PATH
unset PYTHONHOME PYENV_VERSION VIRTUAL_ENV
export LC_ALL=C.UTF-8

if [ -f /opt/ros/noetic/setup.bash ]; then
  if [ -z "${ROS_DISTRO:-}" ]; then
    nounset=$(set +o | grep nounset)
    set +u
    # shellcheck disable=SC1091
    . /opt/ros/noetic/setup.bash
    $nounset
  fi
else
  unset PYTHONPATH CMAKE_PREFIX_PATH ROS_PACKAGE_PATH
fi

mvo_source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
mvo_cache=${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/mvo
mvo_build=${MVO_BUILD:-$mvo_cache/build}

# Two compilations fit in 4 GB; more processors help only with more memory.
mvo_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/MemAvailable/ {print int($2 / 1500000)}' /proc/meminfo 2>/dev/null) || memory=$cores
  [ "$memory" -lt 1 ] && memory=1
  [ "$memory" -lt "$cores" ] && cores=$memory
  echo "$cores"
}

# mvo_configure FOLDER [CMake options]: Ninja where present; quiet unless it fails.
mvo_configure() {
  local folder=$1 generator="Unix Makefiles" log
  shift
  command -v ninja >/dev/null && generator=Ninja
  if [ -f "$folder/CMakeCache.txt" ] &&
    ! grep -qx "CMAKE_HOME_DIRECTORY:INTERNAL=$mvo_source" "$folder/CMakeCache.txt"; then
    echo "note: $folder belonged to another copy of the source; starting it anew" >&2
    rm -rf "$folder/CMakeCache.txt" "$folder/CMakeFiles"
  fi
  [ -f "$folder/CMakeCache.txt" ] && generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$folder/CMakeCache.txt")
  mkdir -p "$folder"
  log=$folder/configure.log
  if ! cmake -S "$mvo_source" -B "$folder" -G "$generator" "$@" >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
}

# mvo_compile FOLDER TARGET...
mvo_compile() {
  local folder=$1
  shift
  cmake --build "$folder" --parallel "$(mvo_jobs)" --target "$@"
}
