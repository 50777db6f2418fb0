#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A shared libdelos shows every function that delos.h and component.h declare, and no stranger.
#   symbols.sh LIBRARY HEADER...
set -euo pipefail
exported=$(nm -D --defined-only "$1" | awk '{print $NF}' | sort -u)
strangers=$(grep -vE '^(delos_[a-z0-9_]+|_ZNK?5delos3api.*|_ZT[ISV]N5delos3api.*)$' <<<"$exported" || true)
if [[ -n $strangers ]]; then
  echo "exported, but not public:" >&2
  head -20 <<<"$strangers" | c++filt >&2
  exit 1
fi
declared=$(grep -ohE 'delos_[a-z0-9_]+\(' "${@:2}" | tr -d '(' | sort -u)
# Words before a parenthesis in comments are functions too; all that is declared must be there.
missing=$(comm -23 <(echo "$declared") <(grep '^delos_' <<<"$exported"))
if [[ -n $missing || $(wc -l <<<"$declared") -lt 100 ]]; then
  echo "declared, but not exported: $missing" >&2
  exit 1
fi
