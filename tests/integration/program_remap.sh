#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# `delos remap`: fields and weights between two small grids, and what it refuses.
#   program_remap.sh PATH_OF_DELOS
set -uo pipefail
delos=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failures=0
# must NAME COMMAND...: the command succeeds
must() {
  local name=$1
  shift
  if "$@"; then echo "ok     $name"; else failures=$((failures + 1)); echo "FAILED $name"; fi
}
# refuses NAME STATUS WORDS ARGUMENTS...: this status, these words, no file out.nc or w.nc
refuses() {
  local name=$1 status=$2 words=$3
  shift 3
  "$delos" remap "$@" >refused.txt 2>&1
  local got=$?
  must "$name" test "$got" = "$status"
  must "$name, and says so" grep -q -e "$words" refused.txt
  must "$name, and writes nothing" test ! -e out.nc -a ! -e w.nc
}
cat >c.yaml <<'YAML'
sizing: {sources: [{type: constant, spacing: 900 km}]}
refine: {tile_vertices: 500}
output: {name: coarse, report: false}
YAML
export SOURCE_DATE_EPOCH=0
must 'two grids' sh -c "'$delos' mesh c.yaml -o . --quiet &&
  '$delos' mesh c.yaml -o . --quiet --set output.name=fine --set 'sizing.sources.0.spacing=700 km'"

refuses 'nothing to do' 3 'nothing to do' coarse.mpas.nc fine.mpas.nc
refuses 'fields without a new file' 2 'requires OUT' coarse.mpas.nc fine.mpas.nc coarse.mpas.nc
refuses 'fields of another grid' 4 'Give the grid that the fields are on' \
  fine.mpas.nc coarse.mpas.nc coarse.mpas.nc out.nc --weights w.nc
refuses 'a dimension that is not there' 4 'no dimension nFaces' \
  coarse.mpas.nc fine.mpas.nc coarse.mpas.nc out.nc --dimension nFaces
refuses 'a third order' 2 'order' coarse.mpas.nc fine.mpas.nc --weights w.nc --order 3
refuses 'no grid' 4 'c.yaml' c.yaml fine.mpas.nc --weights w.nc
refuses 'a folder that is not there' 5 'nowhere' \
  coarse.mpas.nc fine.mpas.nc coarse.mpas.nc out.nc --weights nowhere/w.nc

must 'fields and weights' sh -c "
  '$delos' remap coarse.mpas.nc fine.mpas.nc coarse.mpas.nc out.nc --weights w.nc >stdout.txt"
must 'it says what it carried' grep -q '^carried .*delos_spacing' stdout.txt
must 'it says what it left out' grep -q '^left out .*cellsOnCell (int32' stdout.txt
must 'it says what it wrote' test "$(grep -c '^wrote' stdout.txt)" = 2
must 'nothing else is left in the folder' sh -c "! ls -A | grep -q '^\\.'"
must 'the values do not depend on the threads' sh -c "
  mv out.nc first.nc && mv w.nc first_w.nc &&
  '$delos' remap coarse.mpas.nc fine.mpas.nc coarse.mpas.nc out.nc --weights w.nc --threads 1 >/dev/null &&
  tail -c 20000 out.nc >a && tail -c 20000 first.nc >b && cmp a b"
rm -f out.nc w.nc
must 'weights alone' sh -c "'$delos' remap coarse.mpas.nc fine.mpas.nc --weights w.nc --order 1 >/dev/null &&
  test -s w.nc && test ! -e out.nc"
must 'every kind of grid serves' sh -c "
  '$delos' remap coarse.ugrid_triangles.nc fine.ugrid_cells.nc coarse.mpas.nc out.nc --limiter none >/dev/null"
must 'a grid of a part' sh -c "'$delos' mesh c.yaml -o . --quiet --set output.name=part \
  --set 'region.disc.centre=[10 deg, 50 deg]' --set 'region.disc.radius=5000 km'"
must 'a part and a whole, and the other way round' sh -c "
  '$delos' remap part.mpas.nc fine.mpas.nc part.mpas.nc out.nc --weights w.nc >stdout.txt &&
  grep -q '^unmapped  [1-9][0-9]* cells, which no cell of part.mpas.nc covers' stdout.txt &&
  '$delos' remap fine.mpas.nc part.mpas.nc fine.mpas.nc whole.nc --normalize destarea >stdout.txt &&
  ! grep -q unmapped stdout.txt"
rm -f out.nc w.nc
refuses 'an assured sum on a part' 4 'take the limiter of gradients' \
  part.mpas.nc fine.mpas.nc part.mpas.nc out.nc --limiter assured_sum
refuses 'a normalization of no name' 2 'normalize' \
  part.mpas.nc fine.mpas.nc --weights w.nc --normalize none

echo "$failures failed"
[ "$failures" = 0 ]
