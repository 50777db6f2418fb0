#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the given build into a fresh prefix, checks what is there, builds the consumer project
# against it and runs that.
#   install.sh BUILD_DIR [CMAKE_BUILD_TYPE]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$1
type=${2:-Release}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" --config "$type" >/dev/null
# Only public headers: a header of the engine in the prefix would be a promise nobody made.
strays=$(find "$work/prefix/include" -name '*.h*' -not -path '*/include/delos/*')
if [[ -n $strays ]]; then
  echo "installed, but not public: $strays" >&2
  exit 1
fi
# Nothing may point back into the build or source tree.
if grep -rlF -e "$build" -e "$(dirname "$(dirname "$here")")" "$work/prefix" --include='*.cmake' --include='*.hpp' --include='*.h'; then
  echo "the files above name the build or source tree" >&2
  exit 1
fi
echo "sizing: {sources: [{type: constant, spacing: 600 km}]}" >"$work/grid.yaml"
cmake -S "$here/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE="$type" >/dev/null
cmake --build "$work/build" -j 2 >/dev/null
"$work/build/consumer"
"$work/build/c_consumer"
"$work/build/bmi_consumer" "$work/grid.yaml"
if [[ -e $work/prefix/include/delos/mpi.hpp ]]; then
  "$work/build/mpi_consumer"  # a job of one process needs no mpiexec
fi
if compgen -G "$work/prefix/include/delos/fortran/delos.mod" >/dev/null; then
  "$work/build/fortran_consumer"
fi
# The same without CMake.
export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name delos.pc)")
pkg-config --print-errors --exists delos
by_pkg_config() {  # compiler source package: builds and runs
  local flags
  mapfile -t flags < <(pkg-config --cflags --libs "$3" | xargs -n 1)
  "$1" "$2" "${flags[@]}" -Wl,-rpath,"$(pkg-config --variable=libdir "$3")" -o "$work/by_pkg_config"
  "$work/by_pkg_config"
}
by_pkg_config "${CC:-cc}" "$here/consumer/main.c" delos
if compgen -G "$work/prefix/include/delos/fortran/delos.mod" >/dev/null; then
  by_pkg_config "${FC:-gfortran}" "$here/consumer/main.F90" delos_fortran
fi
# The library must show nothing but its own names.
library=$(find "$work/prefix" -name 'libdelos.so' | head -1)
if [[ -n $library ]]; then
  "$here/../interfaces/symbols.sh" "$library" "$work/prefix/include/delos/"{delos,component}.h
fi
echo "install: headers, package and library serve a consumer"
