#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Checks that every C and C++ file reads as .clang-format wants it; --fix rewrites those that don't.
set -euo pipefail
cd "$(dirname "$0")/../.."
mapfile -t files < <(git ls-files --cached --others --exclude-standard '*.cpp' '*.hpp' '*.c' '*.h')
formatter=$(command -v clang-format-14 || command -v clang-format)
if [[ ${1:-} == --fix ]]; then
  "$formatter" -i "${files[@]}"
  exit 0
fi
"$formatter" --dry-run --Werror "${files[@]}"
echo "format: ${#files[@]} files as .clang-format wants them"
