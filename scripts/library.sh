# shellcheck shell=bash
# Functions that the scripts of this folder share; sourced, never run. Needs bash.

# The checkout this file lies in, so that every script works from any directory.
# shellcheck disable=SC2034  # used by the scripts that source this file
burin_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*"; }

# die MESSAGE [LINE…]: says what went wrong and, line by line, what to do; ends the script.
die() {
  printf '%s: %s\n' "$(basename "$0")" "$1" >&2
  shift
  (($# == 0)) || printf '  %s\n' "$@" >&2
  exit 1
}

# The comment at the head of the calling script: the one place where its use is described.
usage() { sed -n '2,/^[^#]/{s/^# \{0,1\}//p}' "$0"; }

# run COMMAND…: shows it, runs it, and names it if it fails.
run() {
  printf '+ %s\n' "$*"
  local status=0
  "$@" || status=$?
  ((status == 0)) || die "this command failed with exit code $status: $*" "in the folder $PWD"
}

# build_preset PRESET [TARGET…]: configures and builds it (without TARGET: everything).
build_preset() {
  local preset=$1 jobs for_ci=()
  shift
  # CI lets no warning pass; a user's newer compiler may have some we have not seen. And it compiles
  # everything, once.
  [[ ${CI:-} != true || $preset != release ]] || for_ci=(-DBURIN_WARNINGS_AS_ERRORS=ON -DBURIN_UNITY=ON)
  jobs=$(build_jobs)
  cd "$burin_root" || exit
  say "configure, preset $preset"
  run cmake --preset "$preset" ${for_ci[@]+"${for_ci[@]}"}
  say "build, preset $preset, $jobs jobs"
  run cmake --build --preset "$preset" --parallel "$jobs" ${1:+--target "$@"}
}

# As many compilers as there are cores, but no more than fit in memory at 1.5 GB each.
build_jobs() {
  local cores by_memory
  cores=$(nproc)
  by_memory=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null || true)
  by_memory=${by_memory:-$cores}
  ((by_memory >= 1)) || by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}

# Compiling again is faster through ccache, for those who have it.
if [[ -z ${CMAKE_CXX_COMPILER_LAUNCHER+set} ]] && command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros}  # for precompiled headers
  # Clones in other folders find what this one has compiled.
  export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$burin_root} CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR:-true}
fi

# Open MPI in containers: root is the usual user, the kernel may refuse one process to read another
# one's memory, and hwloc complains on every rank where /sys is missing.
if ((EUID == 0)); then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
export OMPI_MCA_btl_vader_single_copy_mechanism=none HWLOC_HIDE_ERRORS=2

# sources [FOLDER…]: the files git tracks and the new ones it does not ignore, each ended by a NUL.
sources() {
  git -C "$burin_root" ls-files -z --cached --others --exclude-standard --deduplicate -- "$@" |
    while IFS= read -r -d '' file; do [[ ! -f $burin_root/$file ]] || printf '%s\0' "$file"; done
}

cpp_sources() { sources '*.cpp' '*.hpp'; }
