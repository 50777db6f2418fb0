#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The certificate through the program: a grid that meets what is required, one that misses it on
# purpose, what is written then, and `check` as judge of files that were changed.
#   program_certificate.sh PATH_OF_DELOS
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
# ends NAME STATUS COMMAND...: the command ends with that status; output in out.txt, err.txt
ends() {
  local name=$1 status=$2
  shift 2
  "$@" >out.txt 2>err.txt
  local got=$?
  must "$name" test "$got" = "$status"
  [ "$got" = "$status" ] || sed 's/^/    /' out.txt err.txt | tail -20
}
says() { must "$1" grep -qF -- "$3" "$2"; }
lists() { must "$1" test "$(ls "$2" | tr '\n' ' ')" = "$3"; }
# change FILE ATTRIBUTE DELTA: adds to the first double of a global attribute of a CDF-5 file
change() {
  python3 - "$@" <<'PY'
import struct, sys
path, name, delta = sys.argv[1], sys.argv[2].encode(), float(sys.argv[3])
data = bytearray(open(path, "rb").read())
# name length and name (padded), type, number of values, values
head = struct.pack(">q", len(name)) + name + b"\0" * (-len(name) % 4)
at = data.index(head + struct.pack(">i", 6)) + len(head) + 4 + 8
data[at:at + 8] = struct.pack(">d", struct.unpack(">d", data[at:at + 8])[0] + delta)
open(path, "wb").write(data)
PY
}

cat >good.yaml <<'YAML'
sizing:
  sources:
    - {type: disc, centre: [-40 deg, 35 deg], radius: 20 deg, spacing: 200 km, outside: 600 km,
       transition: gaussian, width: 10 deg}
  gradient_limit: 0.15
refine: {tile_vertices: 500}
require:
  well_centred: true
  relative_edge_min: 0.65
  relative_edge_max: 1.5
  dual_ratio_min: 0.1
  stagger_max: 0.25
  area_length_min: 0.85
  angle_min: 35 deg
  angle_max: 88 deg
  radius_edge_max: 1
  grading_max: 2.5
  degree_6_min: 0.8
  degree_min: 5
  degree_max: 8
YAML
sed 's/^refine.*/&\nrelax: {spring_rounds: 0, polish_rounds: 0}/' good.yaml >bad.yaml

# --- met
ends 'a grid that meets every requirement is written' 0 "$delos" mesh good.yaml -o good
says 'the report says well centred' good/grid.report.txt 'certificate well centred: every triangle'
says 'the report says spacing kept' good/grid.report.txt 'spacing kept: every edge at least'
must 'the JSON report has every worst element with id and place' python3 - <<'PY'
import json
report = json.load(open("good/grid.report.json"))
certificate = report["certificate"]
assert report["index_base"] == 1 and report["requirements_missed"] == []
assert certificate["well_centred"] is True and certificate["well_centred_fraction"] == 1.0
assert certificate["spacing_kept"] is True and certificate["relative_edge_bound"] == 0.65
for name, count in (("angle_max_deg", None), ("relative_edge_min", 2), ("dual_ratio_min", 2),
                    ("stagger_max", 2)):
    worst = certificate[name]
    assert -180 <= worst["lon_deg"] <= 180 and -90 <= worst["lat_deg"] <= 90, name
    ids = worst["cells"] if count else [worst["triangle"]]
    assert len(set(ids)) == (count or 1) and min(ids) >= 1, name
PY
ends 'check finds every file as certified' 0 "$delos" check good
must 'check says so of each' test "$(grep -c ', as certified)' out.txt)" = 3
must 'check and report use the same words' test \
  "$(grep -c "$(grep '^certificate' good/grid.report.txt)" out.txt)" = 3
for file in mpas ugrid_triangles ugrid_cells; do
  ends "info reads $file" 0 "$delos" info good/grid.$file.nc
  says "info of $file names the base of the ids" out.txt '(from 1), lon '
  must "info of $file shows the five measures" test \
    "$(grep -cE '^(well centred|largest angle|least edge/wanted|least dual/edge|largest stagger) ' out.txt)" = 5
done

# --- missed
cp -r good before
ends 'a grid that misses what is required ends with status 7' 7 "$delos" mesh bad.yaml -o good
must 'as one error line' test "$(grep -c '^delos: error: ' err.txt)" = 1
for part in 'well_centred: ' 'triangles are obtuse' 'dual_ratio_min: 0.0' 'instead of at least 0.1' \
  'at the edge of cells' '(from 1), lon ' 'Raise relax.polish_rounds' 'require.keep' \
  'its report is good/grid.rejected.report.txt'; do
  says "the error says '$part'" err.txt "$part"
done
must 'the files of the good grid stay as they were' sh -c \
  'for f in before/*; do cmp "$f" "good/${f#before/}" || exit 1; done'
ends 'nothing but the report goes to a new folder' 7 "$delos" mesh bad.yaml -o new/deep --quiet
lists 'the report has a name of its own' new/deep 'grid.rejected.report.json grid.rejected.report.txt '
says 'the rejected report says what is missed' new/deep/grid.rejected.report.txt \
  'required    but missed: well_centred '
says 'the rejected report is no certificate' new/deep/grid.rejected.report.txt \
  'certificate NOT well centred: '
must 'the JSON report lists what is missed' python3 -c \
  'import json; assert len(json.load(open("new/deep/grid.rejected.report.json"))["requirements_missed"]) >= 3'
ends 'without a report nothing is written' 7 "$delos" mesh bad.yaml -o none --set output.report=false
must 'not even the folder' test ! -e none
ends 'a good grid later removes the rejected report' 0 "$delos" mesh good.yaml -o new/deep --quiet
must 'so that it is not taken for its own' sh -c '! ls new/deep/*rejected* 2>/dev/null'

# --- kept, and judged later
ends 'keep writes the grid with a warning' 0 "$delos" mesh good.yaml -o kept \
  --set 'require.angle_max=61 deg' --set require.keep=true
says 'the warning says what is missed' err.txt 'warning: the grid misses 1 requirement. angle_max: '
sentence=$(grep -o 'angle_max: .* deg\.' err.txt | sed 's/ deg\. .*/ deg./')
ends 'check judges a file by what its configuration required' 7 "$delos" check kept/grid.mpas.nc
says 'in the same words' out.txt "missed: $sentence"
says 'and says that the file itself is sound' out.txt 'sound, misses 1 requirement (MPAS'
ends 'check takes requirements' 0 "$delos" check good/grid.mpas.nc --require 'angle_max=89 deg'
ends 'and ends with 7 when one is missed' 7 "$delos" check good --require 'stagger_max=0.001'
ends 'an unknown requirement is a configuration error' 3 "$delos" check good --require 'angle_mix=9 deg'
says 'which names it' err.txt 'override require.angle_mix: unknown key'
ends 'a requirement without value is a usage error' 2 "$delos" check good --require angle_max
ends 'a grid that is not well centred is no sound C-grid' 0 "$delos" mesh bad.yaml -o obtuse \
  --quiet --set require.keep=true
ends 'check finds defects before it judges' 1 "$delos" check obtuse/grid.mpas.nc
says 'the verdict is that of the report' out.txt "$(grep '^certificate' obtuse/grid.report.txt)"

# --- a certificate that is not the grid's own
for attribute in delos_well_centred:-0.1 delos_angle_max_deg:-1 delos_dual_ratio_min:0.001 \
  delos_stagger_max:-0.001 delos_relative_edge_min:0.01 delos_dual_ratio_min_lon_lat:0.001; do
  name=${attribute%:*}
  for file in mpas ugrid_triangles ugrid_cells; do
    cp good/grid.$file.nc changed.nc
    change changed.nc "$name" "${attribute#*:}"
    ends "a changed $name is found in $file" 1 "$delos" check changed.nc
    short=${name#delos_}
    short=${short%_lon_lat}
    says 'and named' out.txt "defect: recorded certificate: ${short%_deg} is "
  done
done
sed 's/delos_n_obtuse/delos_n_ubtose/' good/grid.mpas.nc >changed.nc
ends 'a certificate in part is an error of the file' 4 "$delos" check changed.nc
says 'which names the attribute' err.txt 'attribute delos_n_obtuse is missing'

echo "$failures failed"
[ "$failures" = 0 ]
