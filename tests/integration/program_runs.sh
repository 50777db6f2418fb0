#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The program at work: mesh, check, info, plot on a small grid, quiet and not, and Ctrl-C.
#   program_runs.sh PATH_OF_DELOS
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
cat >c.yaml <<'YAML'
title: a small sphere
sizing: {sources: [{type: constant, spacing: 500 km}]}
refine: {tile_vertices: 500}
output: {name: small}
YAML

must 'mesh' sh -c "'$delos' mesh c.yaml -o out >stdout.txt 2>stderr.txt"
for file in mpas.nc ugrid_triangles.nc ugrid_cells.nc graph.info report.json report.txt; do
  must "mesh writes small.$file" test -s "out/small.$file"
done
must 'nothing else is left in the folder' test "$(ls -A out | wc -l)" = 6
must 'the summary says where the files are' grep -q 'out/small.mpas.nc' stdout.txt
must 'each phase is one line when stderr is no terminal' test "$(grep -c '^refine$' stderr.txt)" = 1
must 'no bar is drawn when stderr is no terminal' sh -c "! grep -q '\[#' stderr.txt"

must 'quiet prints nothing' sh -c "'$delos' mesh c.yaml -o q --quiet >quiet.txt 2>&1 && test ! -s quiet.txt"
must 'two runs write the same triangles' sh -c "
  SOURCE_DATE_EPOCH=0 '$delos' mesh c.yaml -o a --quiet --threads 1 --set output.report=false &&
  mv a first &&
  SOURCE_DATE_EPOCH=0 '$delos' mesh c.yaml -o a --quiet --threads 1 --set output.report=false &&
  cmp first/small.ugrid_triangles.nc a/small.ugrid_triangles.nc && cmp first/small.mpas.nc a/small.mpas.nc"
must 'an override changes the grid' sh -c "
  '$delos' mesh c.yaml -o b --quiet --set 'sizing.sources.0.spacing=700 km' &&
  ! cmp -s out/small.graph.info b/small.graph.info"

must 'without -o the files go where the configuration says' sh -c "
  '$delos' mesh c.yaml --quiet --set output.directory=said && test -s said/small.mpas.nc"

must 'check finds the grids sound' sh -c "'$delos' check out >check.txt"
must 'check names every grid' test "$(grep -c ': sound' check.txt)" = 3
must 'info shows digest and configuration' sh -c "'$delos' info out/small.mpas.nc >info.txt &&
  grep -q '^digest *[0-9a-f]\{64\}$' info.txt && grep -q '500 km' info.txt"
must 'check refuses what is no grid' sh -c "! '$delos' check c.yaml 2>check_error.txt && grep -q '^delos: error' check_error.txt"

# Every kind of file into every other, none worse than its source.
must 'mesh writes the other kinds too' sh -c "
  '$delos' mesh c.yaml -o more --quiet --set 'output.formats=[scrip, esmf, vtu, gmsh, jigsaw, fesom]' &&
  test -s more/small.scrip.nc && test -s more/small.fesom/nod2d.out"
cp out/small.mpas.nc out/small.ugrid_cells.nc out/small.ugrid_triangles.nc more
for from in mpas.nc ugrid_triangles.nc ugrid_cells.nc scrip.nc esmf.nc vtu gmsh.msh jigsaw.msh fesom; do
  for to in mpas.nc ugrid_triangles.nc ugrid_cells.nc scrip.nc esmf.nc vtu gmsh.msh jigsaw.msh fesom; do
    must "convert makes $to from $from" sh -c "
      '$delos' convert more/small.$from converted.$to >/dev/null && '$delos' check converted.$to >converted.txt"
    rm -rf "converted.$to"
  done
done
# Parts for the processes of a model.
must 'mesh writes the partitions asked for' sh -c "
  '$delos' mesh c.yaml -o parts --set 'output.partitions=[4, 12]' >parts.txt 2>/dev/null &&
  grep -q '^parts  *4 (' parts.txt && grep -q 'parts/small.graph.info.part.12' parts.txt &&
  grep -q '\"heaviest\"' parts/small.report.json"
n_cells=$(head -1 out/small.graph.info | cut -d' ' -f1)
must 'a part file has a line for each cell and each part' sh -c "
  test \$(wc -l <parts/small.graph.info.part.12) = $n_cells &&
  test \"\$(sort -nu parts/small.graph.info.part.12 | tr '\n' ' ')\" = '0 1 2 3 4 5 6 7 8 9 10 11 '"
must 'partition makes the same parts of any file of the grid' sh -c "
  '$delos' partition parts/small.mpas.nc 4 >partition.txt && grep -q 'of the edges cut' partition.txt &&
  cp parts/small.graph.info.part.4 four &&
  '$delos' partition parts/small.ugrid_triangles.nc 4 12 -o . >/dev/null && cmp four small.graph.info.part.4 &&
  cmp parts/small.graph.info.part.12 small.graph.info.part.12"
must 'partition takes the curve when asked' sh -c "
  '$delos' partition out/small.mpas.nc 3 --method curve -o . | grep -q '3 parts (curve)'"
must 'partition refuses more parts than cells' sh -c "
  ! '$delos' partition out/small.mpas.nc 4 100000 -o q 2>few.txt && grep -q 'too few for 100000' few.txt &&
  test ! -e q/small.graph.info.part.4"
must 'mesh refuses more parts than cells before it begins' sh -c "
  ! '$delos' mesh c.yaml -o few --set 'output.partitions=[100000]' 2>few.txt && test ! -e few &&
  grep -q 'output.partitions asks for 100000 parts' few.txt && ! grep -q '^refine' few.txt"

# Layers, on the whole sphere and on the sea alone. Embedded bathymetry where there is no other.
# Coarser cells miss the data's coast by more than half a per cent of the sea.
cat >sea.yaml <<'YAML'
sizing: {sources: [{type: constant, spacing: 240 km}]}
refine: {tile_vertices: 500}
layers: {kind: z_level, levels: {shape: ocean_80}, minimum_depth: 50 m}
output: {name: sea, formats: [mpas], partitions: [4]}
YAML
cat >near_one.py <<'PY'
import json, sys
layers = json.load(open(sys.argv[1]))["layers"]
print(layers)
sys.exit(0 if abs(layers["volume_ratio"] - 1) < float(sys.argv[2]) and layers["levels"] == 80 else 1)
PY
must 'mesh makes layers' sh -c "
  '$delos' mesh sea.yaml -o sea >sea.txt 2>/dev/null && grep -q '^layers *80 to 6000 m' sea.txt"
must 'the volume of the sea is that of the data within 0.5 %' python3 near_one.py sea/sea.report.json 0.005
must 'a grid with layers is sound' sh -c "'$delos' check sea/sea.mpas.nc | grep -q ': sound'"
must 'partition takes the layers of the file as weights' sh -c "
  '$delos' partition sea/sea.mpas.nc 4 -o . >/dev/null && cmp sea.graph.info.part.4 sea/sea.graph.info.part.4"
must 'the culled sea has layers everywhere' sh -c "
  '$delos' mesh sea.yaml -o culled --quiet --set domain.bodies=largest && python3 near_one.py culled/sea.report.json 0.05 &&
  python3 -c 'import json; r = json.load(open(\"culled/sea.report.json\"));
assert r[\"layers\"][\"n_wet\"] == r[\"domain\"][\"n_cells\"]'"
must 'an atmosphere follows the ground' sh -c "
  sed 's/^layers.*/layers: {kind: terrain_following, n: 20}/' sea.yaml >air.yaml &&
  '$delos' mesh air.yaml -o air 2>/dev/null | grep -q '^layers *20 to 30000 m over ground' &&
  grep -a -q zgrid air/sea.mpas.nc"

must 'convert refuses an ending that says nothing' sh -c "
  ! '$delos' convert out/small.mpas.nc x.nc 2>convert_error.txt && grep -q -e '--to' convert_error.txt && test ! -e x.nc"

# What rounding makes of coordinates counts more the shorter the edges are.
cat >fine.yaml <<'YAML'
sizing:
  resolution: 0.25 deg
  sources: [{type: disc, centre: [10 deg, 85 deg], radius: 0.3 deg, spacing: 1 km, outside: 900 km}]
  gradient_limit: 0.15
output: {name: fine}
YAML
must 'a grid with edges of a kilometre is sound' sh -c "
  '$delos' mesh fine.yaml -o fine --quiet && '$delos' check fine >fine.txt &&
  test \$(grep -c ': sound' fine.txt) = 3"

# A damaged table must be noticed: the last bytes of the file belong to some array.
cp out/small.mpas.nc damaged.nc
python3 - <<'PY'
data = bytearray(open("damaged.nc", "rb").read())
middle = len(data) // 2
data[middle:middle + 4000] = bytes(4000)
open("damaged.nc", "wb").write(data)
PY
"$delos" check damaged.nc >damaged.txt 2>&1
status=$?
must 'check notices a damaged file' test "$status" = 1 -o "$status" = 4

if "$delos" plot out/small.mpas.nc -o pictures >plot.txt 2>plot_error.txt; then
  must 'plot writes three pictures' test "$(ls pictures/*.png | wc -l)" = 3
  printf '%s\n' 'sizing: {sources: [{type: constant, spacing: 150 km}]}' 'data_path: []' \
    'region: {disc: {centre: [179 deg, 86 deg], radius: 1200 km}}' \
    'output: {name: r, formats: [mpas], pictures: [globe, map]}' >region.yaml
  must 'a region over the pole is drawn and agrees with its file' sh -c "
    '$delos' mesh region.yaml -o region --quiet && '$delos' check region >region.txt &&
    test -s region/r.map.png -a -s region/r.globe.png && grep -q 'as certified' region.txt"
else
  must 'plot without cairo says so' grep -q 'Build it with cairo' plot_error.txt
fi

# Ctrl-C during a long run: soon over, status 130, no file and no folder.
"$delos" mesh c.yaml -o stopped --set 'sizing.sources.0.spacing=25 km' >/dev/null 2>stop.txt &
pid=$!
sleep 2
kill -INT "$pid"
begin=$(date +%s)
wait "$pid"
must 'Ctrl-C gives exit status 130' test $? = 130
must 'Ctrl-C is obeyed within 20 s' test $(($(date +%s) - begin)) -lt 20
must 'Ctrl-C leaves nothing' test ! -e stopped
must 'Ctrl-C is one clear line' test "$(grep -c '^delos: error: stopped' stop.txt)" = 1

echo "$failures failed"
[ "$failures" = 0 ]
