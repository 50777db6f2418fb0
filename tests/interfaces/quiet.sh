#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs a host that prints nothing but its failures: success, and no byte on stdout or stderr.
#   quiet.sh PROGRAM [ARGUMENT...]
set -uo pipefail
said=$("$@" 2>&1)
status=$?
if [[ $status != 0 || -n $said ]]; then
  echo "status $status, said:" >&2
  head -50 <<<"$said" >&2
  exit 1
fi
