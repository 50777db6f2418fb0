#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A shared library shows every C function that the headers declare, LEAST at least, and no stranger.
#   symbols.sh LIBRARY PATTERN_OF_ITS_OWN LEAST HEADER...
set -euo pipefail
exported=$(nm -D --defined-only "$1" | awk '{print $NF}' | sort -u)
strangers=$(grep -vE "^($2)$" <<<"$exported" || true)
if [[ -n $strangers ]]; then
  echo "exported, but not public:" >&2
  head -20 <<<"$strangers" | c++filt >&2
  exit 1
fi
# Words before a parenthesis in comments are functions too; all that are the library's must be there.
declared=$(grep -ohE '\b[a-z0-9_]+\(' "${@:4}" | tr -d '(' | grep -E "^($2)$" | sort -u)
missing=$(comm -23 <(echo "$declared") <(echo "$exported"))
if [[ -n $missing || $(wc -l <<<"$declared") -lt $3 ]]; then
  echo "declared, but not exported: $missing" >&2
  exit 1
fi
