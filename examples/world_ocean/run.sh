#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The world ocean, from a fresh Debian 12 to a grid: installs what is missing, builds the release,
# makes the grid of config/world_ocean.yaml and says where everything is.
#   examples/world_ocean/run.sh [OUTPUT_DIR]     default: out/world_ocean
# Further words are passed on to `delos mesh`, e.g. --set 'sizing.clamp.min=60 km'.
set -euo pipefail
cd "$(dirname "$0")/../.."
source tests/support/packages.sh
out=${1:-out/world_ocean}
(($#)) && shift

need_packages "${delos_build_packages[@]}"
need_packages "${delos_data_packages[@]}" ||
  echo "ETOPO5 and Levitus (package ${delos_data_packages[*]}) can't be had: the embedded bathymetry serves"

mapfile -t cache < <(compiler_cache)
cmake --preset release "${cache[@]}" -DDELOS_BUILD_TESTS=OFF -B build/run >/dev/null
cmake --build build/run --target delos_app -j "$(nproc)"

build/run/bin/delos mesh config/world_ocean.yaml -o "$out" "$@"

echo
echo "grids:    $(ls "$out"/*.nc | tr '\n' ' ')"
echo "pictures: $(ls "$out"/*.png 2>/dev/null | tr '\n' ' ')"
echo "report:   $(ls "$out"/*report.json)"
