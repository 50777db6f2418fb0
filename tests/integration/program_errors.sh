#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Everything that can be wrong with what `delos mesh` is given: each case must end with one clear
# message on stderr, the exit status of its kind, and no file written.
#   program_errors.sh PATH_OF_DELOS
set -uo pipefail
delos=$(realpath "$1")
work=$(mktemp -d)
disk=
cleanup() {
  [ -n "$disk" ] && umount "$disk" 2>/dev/null
  rm -rf "$work"
}
trap cleanup EXIT
cd "$work"
failures=0

# expect NAME STATUS MESSAGE_PART [arguments of delos mesh...]   (out/ must not appear)
expect() {
  local name=$1 status=$2 part=$3
  shift 3
  timeout 120 "$delos" mesh "$@" >stdout.txt 2>stderr.txt
  local got=$? problem=
  [ "$got" = "$status" ] || problem="exit status $got instead of $status"
  grep -qF -- "$part" stderr.txt || problem="$problem; the message lacks '$part'"
  [ "$(grep -c '^delos: error: ' stderr.txt)" = 1 ] || problem="$problem; not exactly one error line"
  grep -qE 'terminate called|core dumped|what\(\)' stderr.txt && problem="$problem; a crash"
  [ -e out ] && problem="$problem; out/ was written"
  if [ -n "$problem" ]; then
    failures=$((failures + 1))
    echo "FAILED $name: ${problem#; }"
    sed 's/^/    /' stderr.txt
  else
    echo "ok     $name"
  fi
  rm -rf out
}

# config SOURCE [MORE]: a configuration with that source
config() { printf 'sizing:\n  resolution: 2 deg\n  sources:\n    - %s\n%s\n' "$1" "${2:-}" >c.yaml; }
uniform='{type: constant, spacing: 500 km}'

# A netCDF classic file of `h` (19 x 36) with the given value everywhere; python3 alone, no library.
field() {
  python3 - "$1" "$2" <<'PY'
import struct, sys
path, value = sys.argv[1], float(sys.argv[2])
def name(s): return struct.pack(">i", len(s)) + s.encode() + b"\0" * (-len(s) % 4)
def text(key, s): return name(key) + struct.pack(">ii", 2, len(s)) + s.encode() + b"\0" * (-len(s) % 4)
lat, lon = [-90.0 + 10 * i for i in range(19)], [10.0 * i for i in range(36)]
data = [lat, lon, [value] * (19 * 36)]
def var(key, dims, units, size, begin):
    return (name(key) + struct.pack(">i", len(dims)) + b"".join(struct.pack(">i", d) for d in dims)
            + struct.pack(">ii", 12, 1) + text("units", units) + struct.pack(">iii", 6, size, begin))
def header(b):
    return (b"CDF\1" + struct.pack(">i", 0) + struct.pack(">ii", 10, 2) + name("lat") + struct.pack(">i", 19)
            + name("lon") + struct.pack(">i", 36) + struct.pack(">ii", 0, 0) + struct.pack(">ii", 11, 3)
            + var("lat", [0], "degrees_north", 152, b[0]) + var("lon", [1], "degrees_east", 288, b[1])
            + var("h", [0, 1], "km", 5472, b[2]))
start = len(header([0, 0, 0]))
begins = [start, start + 152, start + 440]
open(path, "wb").write(header(begins) + b"".join(struct.pack(">%dd" % len(d), *d) for d in data))
PY
}
raster='{type: raster, file: h.nc, variable: h}'

expect 'no such configuration' 4 "can't be opened" nowhere.yaml -o out
config "$raster"
expect 'missing file' 4 "h.nc" c.yaml -o out
field h.nc 500
config '{type: raster, file: h.nc, variable: hh}'
expect 'unknown variable' 4 "hh" c.yaml -o out
config "$raster"
echo 'just a text' >h.nc
expect 'text file given as netCDF' 4 "h.nc" c.yaml -o out
field whole.nc 500
head -c 3000 whole.nc >h.nc
expect 'truncated netCDF' 4 "h.nc" c.yaml -o out
field h.nc nan
expect 'all values NaN' 4 "h.nc" c.yaml -o out
field h.nc 0
expect 'h = 0' 4 "h" c.yaml -o out
field h.nc -5
expect 'h < 0' 4 "h" c.yaml -o out
config '{type: constant, spacing: -5 km}'
expect 'negative spacing' 3 "c.yaml:4 sizing.sources.0.spacing: -5 km: must be > 0 m" c.yaml -o out
config "$uniform" 'surfaces: {shape: sphere}'
expect 'unknown key' 3 "c.yaml:5 surfaces: unknown key. Did you mean 'surface'?" c.yaml -o out
config "$uniform" 'threads: many'
expect 'wrong type' 3 "c.yaml:5 threads: 'many' is not a whole number" c.yaml -o out
config '{type: constant, spacing: 500}'
expect 'missing unit' 3 "'500' has no unit" c.yaml -o out
config "$uniform" 'surface: {shape: ellipsoid, radii: [1 km, 0 km, 1 km]}'
expect 'radii <= 0' 3 "surface.radii: 0 km: must be > 0 m" c.yaml -o out
disc() { config "$uniform" "region: {disc: {centre: [10 deg, 50 deg], radius: $1}}"; }
disc 900
expect 'a distance without unit' 3 "region.disc.radius: '900' is no distance along the surface. Give it in km" c.yaml -o out
disc '900 miles'
expect 'a distance in miles' 3 "or as an angle in deg, e.g. '500 km'" c.yaml -o out
disc '5 km'
expect 'a region below the spacing' 4 "the region (key \`region\`) is smaller than a few cells: of the" c.yaml -o out
config '{type: constant, spacing: 200000 km}'
expect 'a spacing larger than the body' 4 "less than one. Check the units of \`sizing\`" c.yaml -o out
printf 'sizing:\n  sources:\n\t- {type: constant, spacing: 500 km}\n' >c.yaml
expect 'tabs' 3 "Put spaces in place of the tabs" c.yaml -o out
config "$uniform" 'output: {view_radius: 10 deg}'
expect 'a view without its centre' 3 "output.view_radius: is the radius of a disc around" c.yaml -o out
config '{type: constant, spacing: 1 m}'
expect '1 m spacing on the globe' 6 "cells" c.yaml -o out
config "$uniform"
expect 'an override that is wrong' 3 "override threads" c.yaml -o out --set threads=many
expect 'an output folder under a file' 5 "c.yaml" c.yaml -o c.yaml/out
expect 'an output folder that can not be written' 5 "/proc" c.yaml -o /proc/out
config "$uniform" 'require: {angle_max: 60.1 deg}
output: {report: false}'
expect 'a requirement that is not met' 7 "instead of at most 60.1 deg, at triangle" c.yaml -o out
config "$uniform" 'require: {dual_ratio: 0.1}'
expect 'an unknown requirement' 3 "c.yaml:5 require.dual_ratio: unknown key. Did you mean 'dual_ratio_min'?" c.yaml -o out
config "$uniform" 'require: {dual_ratio_min: 0.7}'
expect 'a requirement that no grid meets' 3 "0.7: must be between 0 and 0.577" c.yaml -o out
config "$uniform" 'require: {angle_max: 85 km}'
expect 'a requirement in a wrong unit' 3 "is a length, but an angle is needed" c.yaml -o out

config "$uniform"
disk=$work/disk
mkdir "$disk"
if [ "$(id -u)" = 0 ] && mount -t tmpfs -o size=200k none "$disk" 2>/dev/null; then
  expect 'full disk' 5 "disk" c.yaml -o "$disk/out"
  config "$uniform" 'output: {compress: true}'
  expect 'full disk, compressed files' 5 "Free some space" c.yaml -o "$disk/out"
  if [ -n "$(ls -A "$disk")" ]; then
    failures=$((failures + 1))
    echo "FAILED full disk: left $(ls -AR "$disk" | tr '\n' ' ')"
  fi
else
  disk=
  echo "skipped full disk: only root can mount a small one"
fi

# Every kind of file under `ulimit -f` (KiB): an error, not a signal, and nothing left.
config "$uniform" 'output: {report: false, graph: false, formats: [mpas]}'
"$delos" mesh c.yaml -o from --quiet
mkdir limited
for kind in gmsh.msh jigsaw.msh vtu scrip.nc fesom ugrid_triangles.nc; do
  (ulimit -f 20; "$delos" convert from/grid.mpas.nc "limited/x.$kind" >/dev/null 2>stderr.txt)
  if [ $? != 5 ] || [ -n "$(ls -A limited)" ] || [ "$(grep -c '^delos: error: ' stderr.txt)" != 1 ]; then
    failures=$((failures + 1))
    echo "FAILED $kind beyond ulimit -f: left '$(ls -A limited)'"
    cat stderr.txt
  else
    echo "ok     $kind beyond ulimit -f"
  fi
done

"$delos" mesh >/dev/null 2>&1
[ $? = 2 ] || { failures=$((failures + 1)); echo "FAILED no argument: exit status not 2"; }
"$delos" mesh c.yaml --set threads >/dev/null 2>&1
[ $? = 2 ] || { failures=$((failures + 1)); echo "FAILED --set without '=': exit status not 2"; }

echo "$failures failed"
[ "$failures" = 0 ]
