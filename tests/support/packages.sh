# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts that must run on a fresh Debian 12.
#   need_packages NAME...   installs those that are missing (as root, or with sudo); says what to do
#                           by hand where it can't
# The lists:
delos_build_packages=(g++ cmake ninja-build pkg-config libeigen3-dev libtbb-dev libssl-dev
  libyaml-cpp-dev nlohmann-json3-dev libcli11-dev libnetcdf-dev libcairo2-dev fonts-dejavu-core
  libmetis-dev libshp-dev)
delos_data_packages=(ferret-datasets)
delos_test_packages=(doctest-dev python3 gfortran udunits-bin mpich libmpich-dev)
delos_ci_packages=(clang clang-tidy-14 clang-format-14 libclang-rt-14-dev ccache git)
# Not python3-vtk9: it brings Open MPI's mpiexec and mpicc, which take the place of MPICH's.
delos_referee_packages=(valgrind cdo gmsh python3-gmsh python3-meshio libmagics++-data)

has_package() {
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

need_packages() {
  local missing=() package sudo=()
  for package in "$@"; do
    has_package "$package" || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  echo "installing: ${missing[*]}"
  if [[ $(id -u) != 0 ]]; then
    if ! command -v sudo >/dev/null; then
      echo "not root and no sudo; install by hand: apt-get install ${missing[*]}" >&2
      return 1
    fi
    sudo=(sudo)
  fi
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq update </dev/null || true
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install \
    "${missing[@]}" </dev/null >/dev/null
}

# -D options that make CMake use ccache where it is installed.
compiler_cache() {
  if command -v ccache >/dev/null; then echo "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"; fi
}
