#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Two commands must succeed and print the same, which is not nothing.
#   same_output.sh "COMMAND ARGUMENT" "COMMAND ARGUMENT"
set -euo pipefail
read -ra first <<<"$1"
read -ra second <<<"$2"
one=$("${first[@]}")
other=$("${second[@]}")
if [[ -z $one || $one != "$other" ]]; then
  echo "$1 says $one, $2 says $other" >&2
  exit 1
fi
