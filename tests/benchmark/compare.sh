#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the benchmark of two commits in turns on this machine and prints the ratios of their times.
#   compare.sh BASE [HEAD] [-- arguments of delos_benchmark]     HEAD: what is checked out now
# Without arguments: a few cases on one thread.
set -euo pipefail
cd "$(dirname "$0")/../.."
source tests/support/packages.sh
base=${1:?usage: compare.sh BASE [HEAD] [-- ARGUMENTS]}
shift
head=""
if (($#)) && [[ $1 != -- ]]; then
  head=$1
  shift
fi
if (($#)); then shift; fi
if ((!$#)); then set -- U120 U60 E60 T60 V1; fi
rounds=3

work=$(mktemp -d)
cleanup() {
  for side in base head; do
    if [[ -d $work/$side/src ]]; then git worktree remove --force "$work/$side/src"; fi
  done
  rm -rf "$work"
}
trap cleanup EXIT

mapfile -t cache < <(compiler_cache)
prepare() {  # side commit
  local source=$PWD
  if [[ -n $2 ]]; then
    source=$work/$1/src
    git worktree add --detach --quiet "$source" "$2"
  fi
  cmake -S "$source" -B "$work/$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DDELOS_BUILD_TESTS=OFF \
    -DDELOS_BUILD_BENCHMARKS=ON "${cache[@]}" >/dev/null
  # Every run has a folder of its own: without its name, the compiler cache knows the files again.
  CCACHE_BASEDIR=$source CCACHE_NOHASHDIR=1 \
    cmake --build "$work/$1/build" --target benchmark -j "$(nproc)" >/dev/null
}
prepare base "$base"
prepare head "$head"
for ((round = 0; round < rounds; ++round)); do
  for side in base head; do
    "$work/$side/build/bin/delos_benchmark" --threads 1 "$@" >>"$work/$side.jsonl"
  done
done
python3 tests/benchmark/compare.py "$work/base.jsonl" "$work/head.jsonl"
