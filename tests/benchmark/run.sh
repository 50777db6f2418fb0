#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the benchmark (preset release) and measures every case; page.py makes the page of it.
#   run.sh [RESULTS]           all: some 20 minutes on a quiet machine with two cores and 16 GiB
#   run.sh --quick [RESULTS]   three small cases, in seconds
# RESULTS: tests/benchmark/results.jsonl when left out.
set -euo pipefail
cd "$(dirname "$0")/../.."
source tests/support/packages.sh
is_quick=no
if [[ ${1:-} == --quick ]]; then
  is_quick=yes
  shift
fi
results=${1:-tests/benchmark/results.jsonl}

mapfile -t cache < <(compiler_cache)
cmake --preset release -DDELOS_BUILD_BENCHMARKS=ON "${cache[@]}" >/dev/null
cmake --build --preset release --target benchmark -j "$(nproc)" >&2

commit=$(git describe --always --dirty 2>/dev/null || echo "unknown commit")
status=0
# A case that fails (too little memory, say) does not take the others with it.
measure() {
  echo "delos_benchmark $*" >&2
  build/release/bin/delos_benchmark --label "$commit" "$@" || status=$?
}
# Small cases are repeated, since a disturbance of a second is all of them. The growth of times is
# a matter of one thread.
everything() {
  if [[ $is_quick == yes ]]; then
    measure --repeat 3 U240 U120 V1
    return
  fi
  measure --repeat 3 U240 U120 U60 E60 T60 V1 Rossby EKE Slope
  measure --repeat 2 U30 E30 T30 V1fine
  measure U15
  measure --sizing --repeat 5
  measure --remesh --threads 1 --repeat 2
  measure --remap --repeat 4
  measure --threads 1 --repeat 3 G100k G300k G1M
  measure --threads 1 --repeat 2 G3M G10M U7.5
}
lines=$(mktemp)
trap 'rm -f "$lines"' EXIT
everything >"$lines"
mkdir -p "$(dirname "$results")"
# One line on the machine is enough: all of them are the same.
awk '!/^\{"machine"/ || !seen++' "$lines" >"$results"
echo "wrote $results; now: /usr/bin/python3 tests/benchmark/page.py $results" >&2
exit "$status"
