#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the benchmark of two commits in turns on this machine and prints the ratios of their times.
#   compare.sh BASE [HEAD] [-- arguments of delos_benchmark]     HEAD: what is checked out now
set -euo pipefail
cd "$(dirname "$0")/../.."
base=${1:?usage: compare.sh BASE [HEAD] [-- ARGUMENTS]}
shift
head=""
if (($#)) && [[ $1 != -- ]]; then
  head=$1
  shift
fi
if (($#)); then shift; fi
rounds=3

work=$(mktemp -d)
cleanup() {
  for side in base head; do
    if [[ -d $work/$side/src ]]; then git worktree remove --force "$work/$side/src"; fi
  done
  rm -rf "$work"
}
trap cleanup EXIT

prepare() {  # side commit
  local source=$PWD
  if [[ -n $2 ]]; then
    source=$work/$1/src
    git worktree add --detach --quiet "$source" "$2"
  fi
  cmake -S "$source" -B "$work/$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DDELOS_BUILD_TESTS=OFF \
    -DDELOS_BUILD_BENCHMARKS=ON >/dev/null
  cmake --build "$work/$1/build" --target benchmark -j "$(nproc)" >/dev/null
}
prepare base "$base"
prepare head "$head"
for ((round = 0; round < rounds; ++round)); do
  for side in base head; do
    "$work/$side/build/bin/delos_benchmark" "$@" >>"$work/$side.jsonl"
  done
done
python3 - "$work/base.jsonl" "$work/head.jsonl" <<'PYTHON'
import json
import sys

def best(path):
    """Least time of the rounds for each case and phase."""
    cases = {}
    for line in open(path):
        row = json.loads(line)
        case = cases.setdefault(row["case"], {})
        for key, value in row.items():
            if key.endswith("_s") and "per_s" not in key:
                case[key[:-2]] = min(value, case.get(key[:-2], value))
        case["digest"] = row["digest"]
    return cases

base, head = best(sys.argv[1]), best(sys.argv[2])
print(f"{'case':6} {'phase':12} {'base s':>9} {'head s':>9} {'head/base':>9}")
for name in base:
    for phase, seconds in base[name].items():
        if phase == "digest" or phase not in head.get(name, {}) or seconds < 1e-3:
            continue
        other = head[name][phase]
        print(f"{name:6} {phase:12} {seconds:9.3f} {other:9.3f} {other / seconds:9.3f}")
    if name in head and base[name]["digest"] != head[name]["digest"]:
        print(f"{name:6} the grids differ")
PYTHON
