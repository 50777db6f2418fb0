#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The grid that follows the eddies of eleven years of winds: installs what is missing, builds the
# release, runs and draws every grid.
#   examples/eke_adaptive/run.sh [OUT]                                  default: out/eke_adaptive
#   examples/eke_adaptive/run.sh OUT SNAPSHOTS.nc [KEY=VALUE]...   two days of altimeters instead;
# the mean energy of snapshots.yaml is looked for in the folder of SNAPSHOTS.nc, too.
set -euo pipefail
cd "$(dirname "$0")/../.."
source tests/support/packages.sh
out=${1:-out/eke_adaptive}
(($#)) && shift
snapshots=${1:-}
(($#)) && shift

need_packages "${delos_build_packages[@]}"
mapfile -t cache < <(compiler_cache)
cmake --preset release "${cache[@]}" -B build/release >/dev/null
cmake --build build/release --target delos_app eke_adaptive -j "$(nproc)"
host=build/release/examples/eke_adaptive/eke_adaptive
here=examples/eke_adaptive

if [[ -n $snapshots ]]; then
  export DELOS_DATA_PATH=$(dirname "$snapshots"):${DELOS_DATA_PATH:-}
  "$host" snapshots "$here/snapshots.yaml" "$snapshots" "$out" "$@"
else
  need_packages "${delos_data_packages[@]}"
  "$host" winds "$here/winds.yaml" /usr/share/ferret-vis/data/monthly_navy_winds.cdf "$out"
fi
for grid in "$out"/grid*.nc; do build/release/bin/delos plot "$grid" -o "$out" >/dev/null; done
echo "grids and pictures: $out"
