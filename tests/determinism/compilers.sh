#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The same grid from every compiler: builds the delos program with g++ and clang++, -O2 and -O3,
# makes each small grid below with 1, 2, 5 and 8 threads and compares the digests of the reports.
# Prints a table; exit status 1 when a digest differs.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
source tests/support/packages.sh
builds=(gcc-o2 gcc-o3 clang-o2 clang-o3)
threads=(1 2 5 8)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# name|YAML; small, but of several tiles each.
config() { cat >"$work/$1.yaml"; }
config sphere <<'YAML'
surface: {shape: sphere}
sizing: {sources: [{type: constant, spacing: 150 km}]}
refine: {tile_vertices: 2000}
YAML
config wgs84 <<'YAML'
surface: {shape: wgs84}
sizing: {sources: [{type: constant, spacing: 150 km}]}
refine: {tile_vertices: 2000}
YAML
config triaxial <<'YAML'
surface: {shape: ellipsoid, radii: [7645.464 km, 6371.22 km, 5096.976 km]}
sizing: {sources: [{type: constant, spacing: 180 km}]}
refine: {tile_vertices: 2000}
YAML
config patch <<'YAML'
surface: {shape: sphere}
sizing:
  sources:
    - {type: disc, centre: [-40 deg, 35 deg], radius: 15 deg, spacing: 40 km, outside: 300 km, transition: gaussian, width: 8 deg}
  gradient_limit: 0.15
refine: {tile_vertices: 2000}
YAML
config data <<'YAML'
surface: {shape: sphere}
bathymetry: {file: auto}
sizing:
  resolution: 1 deg
  sources:
    - {type: coast, spacing: 80 km, rate: 0.1, max: 300 km}
    - {type: slope, cells: 20, smooth: 100 km}
  combine: min
  clamp: {min: 80 km, max: 300 km}
  land: {spacing: 300 km}
  gradient_limit: 0.15
refine: {tile_vertices: 2000}
YAML
config flat <<'YAML'
surface: {shape: ellipsoid, radii: [6371.22 km, 4459.854 km, 2548.488 km]}
sizing: {sources: [{type: constant, spacing: 200 km}]}
YAML
config contrast <<'YAML'
sizing:
  resolution: 0.25 deg
  gradient_limit: 0.15
  sources:
    - {type: disc, centre: [30 deg, 10 deg], radius: 0.5 deg, spacing: 1 km, outside: 1000 km, transition: linear, width: 0.3 deg}
YAML
config step <<'YAML'
sizing:
  resolution: 1 deg
  sources:
    - {type: box, west: 0 deg, east: 60 deg, south: -20 deg, north: 30 deg, spacing: 100 km, outside: 600 km, transition: linear, width: 0 deg}
YAML
config pole <<'YAML'
sizing:
  resolution: 1 deg
  gradient_limit: 0.15
  sources:
    - {type: disc, centre: [77 deg, -90 deg], radius: 4 deg, spacing: 80 km, outside: 700 km, transition: gaussian, width: 12 deg}
YAML
cases=(sphere wgs84 triaxial patch data flat contrast step pole)

mapfile -t cache < <(compiler_cache)
for build in "${builds[@]}"; do
  cmake --preset "$build" "${cache[@]}" >/dev/null
  cmake --build "build/$build" --target delos_app -j "$(nproc)" >/dev/null
done

digest() {  # build case threads
  local out=$work/$1-$2-$3
  "$root/build/$1/bin/delos" mesh "$work/$2.yaml" -o "$out" --threads "$3" \
    --set 'output.formats=[]' --set 'output.pictures=[]' --set output.graph=true >"$out.log" 2>&1 ||
    { cat "$out.log" >&2; return 1; }
  # Of the triangulation and of all arrays of the C-grid, which the graph's writer needs.
  grep -ho '"digest": *"[0-9a-f]*"' "$out"/*report.json | grep -o '[0-9a-f]\{64\}' | paste -sd+
}

failures=0
printf '%-10s %-10s %s\n' case build "digest for ${threads[*]} threads"
for case in "${cases[@]}"; do
  wanted=""
  for build in "${builds[@]}"; do
    row=""
    for count in "${threads[@]}"; do
      if ! got=$(digest "$build" "$case" "$count"); then got=failed; fi
      : "${wanted:=$got}"
      mark=""
      if [[ $got != "$wanted" || $got == failed ]]; then
        mark=" DIFFERS"
        failures=$((failures + 1))
      fi
      row+=" ${got:0:8}${got:64:9}$mark"
    done
    printf '%-10s %-10s%s\n' "$case" "$build" "$row"
  done
done
n_runs=$((${#cases[@]} * ${#builds[@]} * ${#threads[@]}))
echo "determinism: $((n_runs - failures)) of $n_runs runs agree"
((failures == 0))
