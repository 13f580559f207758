#!/bin/bash
# The fallback without a counter: 60 s at the stated rate without a lost count, a fault above it. $1: edges a second.
. ./board.sh
make_lines
rate=$1

run() { # run RATE SECONDS -> counted fault expected
  local truth
  coproc PROBE { ./quadrature_probe "$rate"; }
  read -r -u "${PROBE[0]}" line
  test "$line" = ready || { echo "$line"; return 1; }
  truth=$(./gpio_board encoder "$LINES_FOLDER" "$1" "$2")
  sleep 0.05
  eval "exec ${PROBE[1]}>&-"
  read -r -u "${PROBE[0]}" counted fault
  wait "$PROBE_PID" || true
  echo "$1 edges/s for $2 s: true count $truth, counted $counted, fault $fault"
  true_count=$truth
}

run "$rate" 60
check "60 s at the stated rate without a lost count" test "$counted" = "$true_count" -a "$fault" = 0
check "and the encoder has moved" test "$true_count" -gt $((rate * 20))
run $((rate * 12 / 10)) 2
check "20 % above it: over-speed" test "$fault" = 3
exit $failed
