#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy over the library's sources in parallel.
#   tidy.sh [-p BUILD_DIR] [FILE...]     all that BUILD_DIR compiles of component/, interfaces/ and examples/
#   tidy.sh [-p BUILD_DIR] --changed REF only those that differ from REF (or are new)
# BUILD_DIR holds compile_commands.json (default build/dev). Of a build in large pieces (a unity build, as the
# presets asan and release are) whole pieces are checked, five times faster; files by name need a build of single files.
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
commands=$build/compile_commands.json
if [[ ! -f $commands ]]; then
  echo "tidy: no $commands; configure first: cmake --preset dev" >&2
  exit 2
fi
sources='(component|interfaces|examples)/.*\.cpp'
compiled() { sed -nE 's/^ *"file": "(.*)",?$/\1/p' "$commands" | sort -u; }
pieces() { compiled | grep -E '/Unity/[^/]*$' || true; }

# The files to check, and how clang-tidy gets at each: by itself, or in its piece.
if [[ -n $changed ]]; then
  mapfile -t files < <({ git diff --name-only --diff-filter=d "$changed"; git ls-files --others --exclude-standard; } |
    grep -E "^$sources\$" | sort -u || true)
fi
wanted=()
checked=0
if ((${#files[@]})); then
  # A file that this build does not compile has no command to check it by. (One list for all: grep -q
  # leaves a pipe early, which pipefail takes for a failure.)
  all=$(compiled)
  for file in "${files[@]}"; do
    if grep -qxF "$PWD/$file" <<<"$all"; then wanted+=("$file"); fi
  done
  checked=${#wanted[@]}
elif [[ -z $changed ]]; then
  mapfile -t in_pieces < <(pieces)
  mapfile -t wanted < <(compiled | grep -E "^$PWD/$sources\$" || true)
  checked=${#wanted[@]}
  for piece in "${in_pieces[@]}"; do
    n=$(grep -cE "^#include \"$PWD/$sources\"" "$piece" || true)
    if ((n > 0)); then
      wanted+=("$piece")
      checked=$((checked + n))
    fi
  done
fi
if ((${#wanted[@]} == 0)); then
  echo "tidy: nothing to check"
  exit 0
fi
linter=$(command -v clang-tidy-14 || command -v clang-tidy)
# The dearest first, so that no long one is left for the end: pieces, then the largest files. GCC's own
# warning options in the commands mean nothing to the linter, and are no finding.
if stat -c '%s %n' "${wanted[@]}" | sed -E 's,^[0-9]+ (.*/Unity/),9999999 \1,' | sort -rn | cut -d' ' -f2- |
  xargs -P "$(nproc)" -n 1 "$linter" -p "$build" --config-file=.clang-tidy --quiet \
    --extra-arg=-Wno-unknown-warning-option 2> >(grep -v 'warnings generated' >&2 || true); then
  echo "tidy: $checked files clean"
else
  echo "tidy: findings above must be fixed" >&2
  exit 1
fi
