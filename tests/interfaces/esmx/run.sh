#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds ESMX, ESMF's own driver, around the installed NUOPC cap and couples it to ESMX's data
# component for three days on 1 and 2 processes: the areas of all processes must sum to the
# sphere's. Once the grid stays (steady), once the ocean's energy has it made anew (remesh). Where the
# plug was built, it is loaded at run time, too.
#   run.sh BUILD_DIR ESMFMKFILE [CMAKE_BUILD_TYPE]     needs ESMF, mpiexec, python3 with yaml
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$1
makefile=$2
type=${3:-Release}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
of_esmf() { sed -n "s/^$1=//p" "$makefile"; }

cmake --install "$build" --prefix "$work/prefix" --config "$type" >/dev/null
export ESMFMKFILE=$makefile
cmake -S "$(of_esmf ESMF_ESMXDIR)" -B "$work/build" -DESMX_BUILD_FILE="$here/esmxBuild.yaml" \
  -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_FIND_PACKAGE_TARGETS_GLOBAL=ON \
  -DCMAKE_BUILD_TYPE=Release >"$work/configure.log" 2>&1 || { cat "$work/configure.log" >&2; exit 1; }
cmake --build "$work/build" -j 2 >"$work/build.log" 2>&1 || { tail -40 "$work/build.log" >&2; exit 1; }

# What the ocean gives, what the grid may tell it, and the grid's configuration.
declare -A energy=([steady]=0.02 [remesh]=0.125)
declare -A least=([steady]=599999.0 [remesh]=490000.0) largest=([steady]=600001.0 [remesh]=1200001.0)
declare -A generation=([steady]=1 [remesh]=2)
configuration() {
  printf '%s\n' "surface: {shape: sphere, radius: 6371.22 km}" "threads: 1"
  if [[ $1 == steady ]]; then
    echo "sizing: {sources: [{type: constant, spacing: 600 km}]}"
    return
  fi
  # The ocean's energy asks for 500 km; the alarm rings at the end of the second day.
  printf '%s\n' "sizing: {sources: [{type: constant, spacing: 1200 km}], gradient_limit: 0.3," \
    "         resolution: 4 deg, clamp: {min: 300 km, max: 2000 km}}" \
    "refine: {tile_vertices: 500}" "remesh: {interval: P2D, sources: [{type: eke, from: energy," \
    "         quiet: [0.05 m/s, 1200 km], energetic: [0.5 m/s, 500 km]}]}"
}

# run CASE MODEL N_PROCESSES FOLDER: the log lines of the cap, of all processes, go to FOLDER/said
run() {
  mkdir -p "$4"
  sed -e "s|@MODEL@|$2|" -e "s|@ENERGY@|${energy[$1]}|" -e "s|@LAST_GENERATION@|${generation[$1]}|" \
    -e "s|@LEAST_SPACING@|${least[$1]}|" -e "s|@LARGEST_SPACING@|${largest[$1]}|" \
    "$here/esmxRun.yaml" >"$4/esmxRun.yaml"
  cp "$work/prefix/share/delos/delos_fields.yaml" "$4"
  configuration "$1" >"$4/grid.yaml"
  if ! (cd "$4" && timeout 120 mpiexec -n "$3" "$work/build/esmx_app" >out 2>&1); then
    echo "ESMX failed: $1, $2 on $3 processes" >&2
    tail -20 "$4/out" >&2
    grep -h ERROR "$4"/*ESMF_LogFile >&2
    return 1
  fi
  grep -h 'delos: ' "$4"/*ESMF_LogFile | sed 's/.*delos: //' >"$4/said"
  check "$1" "$4/said" "$3"
}

# Lines are "export NAME: N elements, sum S, least L, largest G UNIT". Both runs of a case tell the
# same: area, mean spacing and generation at the end.
check() {
  awk -v name="$1" -v n="$3" -v energy="${energy[$1]}" -v last="${generation[$1]}" '
    function differs(a, b, share) { return a - b > share * b || b - a > share * b }
    $1 == "export" && $2 == "cell_area:" { sum += $6; lines++; cells += $3 }
    $1 == "export" && $2 == "cell_spacing:" { spacing[++spacings] = $6 + 0; elements[spacings] = $3 }
    $1 == "export" && $2 == "grid_generation:" {
      if ($8 + 0 != $10 + 0 || $8 + 0 < 1 || $8 + 0 > last) bad = 1
      if ($8 + 0 == last + 0) at_last++
    }
    $1 == "import" && $2 == "eddy_kinetic_energy:" && !differs($10, energy, 1e-5) { energies++ }
    END {
      steps = 4  # data-initialize, and three days
      pi = atan2(0, -1); wanted = 4 * pi * 6371220 ^ 2
      error = sum / steps / wanted - 1
      if (error < 0) error = -error
      for (i = steps; i <= spacings; i += steps) { total += spacing[i]; count += elements[i] }
      # The mesh stays: spacing is finer than it after the remesh, half as much at least.
      is_finer = total / count < 0.5 * 1200e3
      if (name == "remesh" && !is_finer) bad = 1
      # All steps of a steady run, the last two days of the other.
      if (at_last != n * (name == "remesh" ? 2 : steps)) bad = 1
      printf "%s, %d processes: %d elements, area %.16e m2, relative error %.1e, generation %d, " \
        "mean spacing %.0f m, %d imports of energy\n",
        name, n, cells / steps, sum / steps, error, last, total / count, energies
      exit !(lines == steps * n && spacings == steps * n && error < 1e-13 && energies == 3 * n && !bad)
    }' "$2"
}

for case in steady remesh; do
  run $case delos_nuopc 1 "$work/$case/one"
  run $case delos_nuopc 2 "$work/$case/two"
done
if [[ -e $work/prefix/lib/libdelos_nuopc_plug.so ]]; then
  run steady "$work/prefix/lib/libdelos_nuopc_plug.so" 2 "$work/plug"
  echo "the plug was loaded at run time"
fi
echo "ESMX $(of_esmf ESMF_VERSION_STRING): the cap ran on 1 and 2 processes"
