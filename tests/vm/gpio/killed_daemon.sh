#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The state of the lines after the daemon is killed during a motion. It shows why docs/gpio.md requires pull resistors.
. ./board.sh
make_lines
make_tree
make_configuration

move_and_kill() {
  start_plant 0.3
  start_daemon
  ctl enable elbow
  ctl home elbow
  ctl move elbow -0.4
  sleep 0.15
  check "it moves, amplifier on, brake open" bash -c 'test "$(cat lines/enable/value)$(cat lines/brake_release/value)" = 11'
  kill -9 $daemon
  wait $daemon 2>/dev/null || true
  sleep 0.01
}

move_and_kill
check "the kernel lets the lines go: the pull-down switches the amplifier off" level_is enable 0
check "and the pull-down shuts the brake" level_is brake_release 0
check "but the PWM goes on with its last duty" bash -c 'test "$(head -n1 tree/pwm/pwm0/duty_cycle)" != 0'
first=$(level alive)
check "the hardware watchdog starves" bash -c "for i in \$(seq 20); do cat lines/alive/value; sleep 0.0007; done | sort -u | grep -qx $first"
sleep 0.3
position=$(truth)
sleep 0.3
check "the joint stands" near "$(truth)" "$position" 0.000001
kill $plant
check "a daemon that is started anew begins safe" start_daemon
check "with no torque" duty_is 0
check "and the amplifier off" level_is enable 0
kill $daemon
wait $daemon || true

# The same board with wrong wiring: pull-ups instead of pull-downs.
pull enable pull-up
pull brake_release pull-up
move_and_kill
check "with a pull-up the amplifier stays on: this is why the pull-down must exist" level_is enable 1
kill $plant
exit $failed
