#!/bin/bash
# Two actuator PCs, each a network namespace of its own with a daemon, and the operator's PC, on one LCM network (ttl=1)
# through a bridge. The client lists and watches both, gives signed orders across; loss, delay, duplication and reordering on
# every link do no harm; a daemon without a route to its peers goes on. docs/several-machines.md shows the same commands.
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

# One client sees both, and names them.
for _ in $(seq 20); do
  ctl status >output 2>&1 || true
  if grep -q '^arm.elbow ' output && grep -q '^leg.knee ' output; then break; fi
done
grep -q '^arm.elbow ' output || { cat output; fail "the arm is not listed"; }
grep -q '^leg.knee ' output || { cat output; fail "the leg is not listed"; }
ctl watch --plain --duration_s 0.5 >output
grep -q '^arm.elbow ' output && grep -q '^leg.knee ' output || fail "watch does not show both"

# Signed orders across; each daemon obeys its own key only.
for machine in arm leg; do ctl --prefix $machine load-table rhs17-6006.json; done
expect_status 1 as leg --prefix arm enable elbow
grep -q 'wrong signature' output || { cat output; fail "a key of the leg must mean nothing to the arm"; }
expect_status 1 unsigned --prefix arm enable elbow
ctl --prefix arm enable elbow
as leg --prefix leg enable knee

# A network that loses, delays, doubles and reorders.
for machine in operator arm leg; do
  in_machine $machine tc qdisc add dev eth0 root netem loss 15% delay 3ms 2ms duplicate 5% reorder 20%
done
for position_rad in 0.1 -0.1 0.3; do
  ctl --timeout_s 20 --prefix arm move elbow $position_rad --wait
  as leg --timeout_s 20 --prefix leg move knee $position_rad --wait
done
in_machine operator tc -s qdisc show dev eth0 | grep -o 'dropped [0-9]*' | grep -qv 'dropped 0$' || fail "nothing was lost: the test shows nothing"
# A repetition was answered, not obeyed twice; nobody saw a forgery or a replay.
ctl --timeout_s 20 --prefix arm timing >output
if grep -E 'wrong signature|not rising' output | grep -qv 'refused messages         1 (wrong signature)'; then cat output; fail "a lossy network looks like an attack"; fi

# The operator's PC is cut off in the middle of an identification: the stream expires, the joint holds by itself.
timeout -s KILL 60 bash -c ". ./several_machines.bash; ctl --prefix arm identify elbow --out cut.lcm --overwrite" >/dev/null 2>&1 &
cut=$!
sleep 8
in_machine operator ip link set eth0 down
sleep 3
kill -KILL $cut 2>/dev/null || true
in_machine arm ./strainwavectl --lcm-url "$lcm_url" --prefix arm --timeout_s 10 status elbow >output
grep -q '^mode  *2 (holding)' output || { cat output; fail "the joint must hold when its client is cut off"; }
grep -q 'setpoint stream expired' output || { cat output; fail "the stream must have expired"; }

# The network is back: everything is.
in_machine operator ip link set eth0 up
in_machine operator ip route replace 239.255.76.67/32 dev eth0
ctl --timeout_s 20 --prefix arm move elbow 0 --wait
# Anybody may stop.
unsigned --timeout_s 20 --prefix leg disable knee
echo "two machines, one operator: passed"
