#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds ESMX, ESMF's own driver, around the installed NUOPC cap and couples it to ESMX's data
# component for three days on 1 and 2 processes: the areas of all processes must sum to the
# sphere's, and both runs must tell the same. Where the plug was built, it is loaded at run time, too.
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

# run MODEL N_PROCESSES FOLDER: the log lines of the cap, of all processes, go to FOLDER/said
run() {
  mkdir -p "$3"
  sed "s|model: MODEL|model: $1|" "$here/esmxRun.yaml" >"$3/esmxRun.yaml"
  cp "$work/prefix/share/delos/delos_fields.yaml" "$3"
  printf '%s\n' "surface: {shape: sphere, radius: 6371.22 km}" \
    "sizing: {sources: [{type: constant, spacing: 600 km}]}" "threads: 1" >"$3/grid.yaml"
  if ! (cd "$3" && timeout 120 mpiexec -n "$2" "$work/build/esmx_app" >out 2>&1); then
    echo "ESMX failed: $1 on $2 processes" >&2
    tail -20 "$3/out" >&2
    grep -h ERROR "$3"/*ESMF_LogFile >&2
    return 1
  fi
  grep -h 'delos: ' "$3"/*ESMF_LogFile | sed 's/.*delos: //' >"$3/said"
  check "$3/said" "$2"
}

# Lines are "export NAME: N elements, sum S, least L, largest G UNIT".
check() {
  awk -v n="$2" '
    $1 == "export" && $2 == "cell_area:" { sum += $6; lines++; cells += $3 }
    $1 == "export" && $2 == "grid_generation:" && ($8 + 0 != 1 || $10 != 1) { bad = 1 }
    $1 == "import" && $2 == "eddy_kinetic_energy:" && $10 > 0.0199999 && $10 < 0.0200001 { energy++ }
    END {
      steps = 4  # data-initialize, and three days
      pi = atan2(0, -1); wanted = 4 * pi * 6371220 ^ 2
      error = sum / steps / wanted - 1
      if (error < 0) error = -error
      printf "%d processes: %d cells, area %.16e m2, relative error %.1e, %d imports of energy\n",
        n, cells / steps, sum / steps, error, energy
      exit !(lines == steps * n && error < 1e-13 && energy == 3 * n && !bad)
    }' "$1"
}

run delos_nuopc 1 "$work/one"
run delos_nuopc 2 "$work/two"
if [[ -e $work/prefix/lib/libdelos_nuopc_plug.so ]]; then
  run "$work/prefix/lib/libdelos_nuopc_plug.so" 2 "$work/plug"
  echo "the plug was loaded at run time"
fi
echo "ESMX $(of_esmf ESMF_VERSION_STRING): the cap ran on 1 and 2 processes"
