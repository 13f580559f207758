#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The fallback without a hardware counter loses no count in 60 s at the default cap, nor in 4 s at the highest configurable cap. Above a cap it
# faults. $1, $2: these caps in edges a second.
. ./board.sh
make_lines
default=$1
highest=$2

run() { # run CAP RATE SECONDS [BOUNCES DEBOUNCE_S] -> counted fault true_count came_about
  coproc PROBE { ./quadrature_probe "$1" "${5:-0}"; }
  read -r -u "${PROBE[0]}" line
  test "$line" = ready || { echo "$line"; return 1; }
  read -r true_count came_about < <(chrt -f 85 ./gpio_board encoder "$LINES_FOLDER" "$2" "$3" "${4:-0}")
  sleep 0.05
  eval "exec ${PROBE[1]}>&-"
  read -r -u "${PROBE[0]}" counted fault
  wait "$PROBE_PID" || true
  echo "$came_about edges/s for $3 s, cap $1: true count $true_count, counted $counted, fault $fault"
}

run "$default" "$default" 60
check "60 s at the default cap without a lost count" test "$counted" = "$true_count" -a "$fault" = 0
check "at that rate" test "$came_about" -ge $((default * 99 / 100)) -a "$true_count" = $((default * 30))
run "$default" $((default * 12 / 10)) 2
check "20 % above it: over-speed" test "$fault" = 3
run "$highest" "$highest" 4
check "4 s at the highest cap without a lost count" test "$counted" = "$true_count" -a "$fault" = 0
check "at that rate" test "$came_about" -ge $((highest * 99 / 100)) -a "$true_count" = $((highest * 2))
# Contacts that bounce ten times within half a millisecond at every edge, at a hundred edges a second.
run "$default" 100 4 10 0
check "bounces are too many edges" test "$fault" = 3
run "$default" 100 4 10 0.002
check "and none where the kernel waits for two steady milliseconds" test "$counted" = "$true_count" -a "$fault" = 0
exit $failed
