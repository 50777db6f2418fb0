#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds (preset release) and runs all tests.
#   tests/run.sh           everything
#   tests/run.sh --quick   without the long tests (labels integration, determinism, install)
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/support/packages.sh

selection=()
case ${1:-} in
  "") ;;
  --quick) selection=(-LE 'integration|determinism|install') ;;
  *) echo "usage: tests/run.sh [--quick]" >&2; exit 2 ;;
esac

need_packages "${delos_build_packages[@]}" "${delos_test_packages[@]}"
# Tests that read Debian's data sets skip, and say so, where these can't be had.
need_packages "${delos_data_packages[@]}" || echo "going on without ${delos_data_packages[*]}"

mapfile -t cache < <(compiler_cache)
cmake --preset release "${cache[@]}" >/dev/null
cmake --build --preset release -j "$(nproc)"
# Two at a time at most: most tests use several threads themselves.
ctest --preset release -j 2 "${selection[@]}"
