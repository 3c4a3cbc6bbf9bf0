#!/usr/bin/env bash
# Usage: scripts/numerics.sh [OPTIONS of causticl selftest]
# Runs the checks of the hard cases (10^6 inputs each, where no option says otherwise) and prints them as the table
# of docs/numerics.md. Takes minutes.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}"
build build causticl
status=0
table=$("$root/build/causticl" selftest "$@") || status=$?
# The columns are those of selftest_line() in host/selftest/selftest.cpp.
awk '
  function column(first, length_) { text = substr($0, first, length_); gsub(/^ +| +$/, "", text); return text }
  NR == 1 { print $0 "\n"; print "| case | check | inputs | failures | worst error | tolerance |\n|---|---|---|---|---|---|"; next }
  NR == 2 || column(1, 4) !~ /^[0-9]+$/ { next }
  {
    unit = match($0, / \([a-z0-9^. -]*[^)]*\)/) ? substr($0, RSTART + 2, RLENGTH - 3) : ""
    worst = column(82, 11); tolerance = column(94, 11)
    if (tolerance != "") tolerance = tolerance " (" unit ")"
    print "| " column(1, 4) " | " column(7, 52) " | " column(60, 11) " | " column(72, 9) " | " worst " | " tolerance " |"
  }' <<<"$table"
tail -2 <<<"$table"
exit $status
