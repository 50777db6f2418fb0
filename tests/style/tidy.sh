#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy over the library's sources in parallel.
#   tidy.sh [-p BUILD_DIR] [FILE...]     all .cpp files of component/, interfaces/ and examples/
#   tidy.sh [-p BUILD_DIR] --changed REF only those that differ from REF (or are new)
# BUILD_DIR holds compile_commands.json (default build/dev).
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/dev
files=()
changed=""
while (($#)); do
  case $1 in
    -p) build=$2; shift 2 ;;
    --changed) changed=$2; shift 2 ;;
    *) files+=("$1"); shift ;;
  esac
done
if [[ ! -f $build/compile_commands.json ]]; then
  echo "tidy: no $build/compile_commands.json; configure first: cmake --preset dev" >&2
  exit 2
fi
if [[ -n $changed ]]; then
  mapfile -t files < <({ git diff --name-only --diff-filter=d "$changed"; git ls-files --others --exclude-standard; } |
    grep -E '^(component|interfaces|examples)/.*\.cpp$' | sort -u || true)
elif ((${#files[@]} == 0)); then
  mapfile -t files < <(git ls-files --cached --others --exclude-standard 'component/*.cpp' 'interfaces/*.cpp' 'examples/*.cpp')
fi
# A file that this build does not compile has no command to check it by.
wanted=()
for file in "${files[@]}"; do
  if grep -qF "/$file\"" "$build/compile_commands.json"; then wanted+=("$file"); fi
done
if ((${#wanted[@]} == 0)); then
  echo "tidy: nothing to check"
  exit 0
fi
linter=$(command -v clang-tidy-14 || command -v clang-tidy)
# The largest first, so that no long one is left for the end. GCC's own warning options in the commands
# mean nothing to the linter, and are no finding.
if stat -c '%s %n' "${wanted[@]}" | sort -rn | cut -d' ' -f2- |
  xargs -P "$(nproc)" -n 1 "$linter" -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option 2> >(grep -v 'warnings generated' >&2 || true); then
  echo "tidy: ${#wanted[@]} files clean"
else
  echo "tidy: findings above must be fixed" >&2
  exit 1
fi
