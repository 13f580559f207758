#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Two actuator PCs on one LCM network (ttl=1) through a veth cable, each a network namespace with a daemon. One client lists and watches both and
# gives signed orders to both. Loss, delay, duplication and reordering do no harm. A joint whose client is cut off holds by itself.
# docs/several-machines.md shows the same commands.
set -euo pipefail
. ./several_machines.bash

fail() {
  echo "FAILED: $*" >&2
  tail -n 20 arm.log leg.log >&2 || true
  exit 1
}
# expect_status STATUS COMMAND...
expect_status() {
  local wanted=$1 status=0
  shift
  "$@" >output 2>&1 || status=$?
  [ "$status" -eq "$wanted" ] || { cat output >&2; fail "status $status, not $wanted: $*"; }
}

make_network
make_keys
start_daemon arm elbow
start_daemon leg knee
trap stop_daemons EXIT

# One client sees and names both.
for _ in $(seq 20); do
  ctl status >output 2>&1 || true
  if grep -q '^arm.elbow ' output && grep -q '^leg.knee ' output; then break; fi
done
grep -q '^arm.elbow ' output || { cat output; fail "the arm is not listed"; }
grep -q '^leg.knee ' output || { cat output; fail "the leg is not listed"; }
ctl watch --plain --duration_s 0.5 >output
grep -q '^arm.elbow ' output && grep -q '^leg.knee ' output || fail "watch does not show both"

# Signed orders reach both machines. Each daemon obeys its own key only.
for machine in arm leg; do ctl --prefix $machine load-table rhs17-6006.json; done
expect_status 1 as leg --prefix arm enable elbow
grep -q 'wrong signature' output || { cat output; fail "a key of the leg must mean nothing to the arm"; }
expect_status 1 unsigned --prefix arm enable elbow
ctl --prefix arm enable elbow
# The key that loaded its table still owns the knee.
as leg --prefix leg take-over knee
as leg --prefix leg enable knee

# The network loses, delays, duplicates and reorders datagrams.
for machine in arm leg; do
  in_machine $machine tc qdisc add dev eth0 root netem loss 5% delay 3ms 2ms duplicate 5% reorder 20%
done
for position_rad in 0.1 -0.1 0.3; do
  ctl --prefix arm move elbow $position_rad --wait
  as leg --prefix leg move knee $position_rad --wait
done
in_machine arm tc -s qdisc show dev eth0 | grep -o 'dropped [0-9]*' | grep -qv 'dropped 0$' || fail "nothing was lost: the test shows nothing"
# The daemon answered a repetition without obeying it twice, and it counted no forgery or replay.
ctl --prefix arm timing >output
if grep -E 'wrong signature|not rising' output | grep -qv 'refused messages         1 (wrong signature)'; then cat output; fail "a lossy network looks like an attack"; fi

# The cable is cut during an identification. The stream expires, and the joint holds by itself.
ctl --prefix leg take-over knee
ctl --prefix leg identify knee --out cut.lcm >identify.txt 2>&1 &
cut=$!
sleep 4
for machine in arm leg; do in_machine $machine tc qdisc replace dev eth0 root netem loss 100%; done
status=0
wait $cut || status=$?
[ "$status" -eq 3 ] || { cat identify.txt; fail "the client must say that nothing is heard, not end with $status"; }
in_machine leg ./strainwavectl --lcm-url "$lcm_url" --prefix leg --timeout_s 10 status knee >output
grep -q '^mode  *2 (holding)' output || { cat output; fail "the joint must hold when its client is cut off"; }
grep -q 'setpoint stream expired' output || { cat output; fail "the stream must have expired"; }

# The cable is restored, and everything continues.
for machine in arm leg; do in_machine $machine tc qdisc del dev eth0 root; done
ctl --prefix leg move knee 0 --wait
# Any client may stop a joint, without a key.
unsigned --prefix leg disable knee
echo "two machines, one operator: passed"
