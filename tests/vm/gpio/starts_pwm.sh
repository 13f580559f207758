#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The daemon starts its PWM on a chip that refuses what Linux 6.1 refuses: a fresh channel after a boot, and a channel with settings left by another
# program.
. ./board.sh
make_lines
make_tree
make_configuration
PWM=$TREE/pwm

mount_pwm() { # mount_pwm [PERIOD_NS DUTY_NS ENABLE POLARITY]
  chrt -f 85 python3 kernel_pwm.py "$PWM" pwm.log "$@" &
  pwm=$!
  for _ in $(seq 100); do mountpoint -q "$PWM" && return 0; sleep 0.05; done
  return 1
}
unmount_pwm() { kill $pwm && wait $pwm; }
# In the daemon's writes, a state that is on (column 6) must have no duty (column 5).
never_drove() { awk '$6 == 1 && $5 != 0 { bad = 1; print "      " $0 } END { exit bad }' pwm.log; }
shows() { test "$(cat "$PWM"/pwm0/{period,duty_cycle,enable,polarity} | paste -sd' ')" = "$1"; }

mount_pwm 0 0 0 normal
check "a channel without a period refuses to be switched off" bash -c "! echo 0 2>/dev/null >'$PWM/pwm0/enable'"
check "and a duty of nothing" bash -c "! echo 0 2>/dev/null >'$PWM/pwm0/duty_cycle'"
unmount_pwm
mount_pwm 100000 80000 1 inversed
check "one that is on refuses another polarity" bash -c "! echo normal 2>/dev/null >'$PWM/pwm0/polarity'"
check "and a period below its duty" bash -c "! echo 50000 2>/dev/null >'$PWM/pwm0/period'"
unmount_pwm

starts() { # starts WHAT [PERIOD_NS DUTY_NS ENABLE POLARITY]
  local what=$1
  shift
  mount_pwm "$@"
  check "starts on a channel $what" start_daemon
  check "which is idle and on then" shows "50000 0 1 normal"
  check "nothing was refused" bash -c '! grep refused pwm.log'
  check "and it never was on with a duty" never_drove
  kill $daemon
  wait $daemon || failed=1
  check "at the end it is idle" shows "50000 0 1 normal"
  unmount_pwm
}
starts "that nobody has exported yet"
starts "without a period" 0 0 0 normal
starts "that was left on, with a longer period and the other polarity" 100000 80000 1 inversed
starts "that was left off with a duty above our period" 100000 80000 0 normal
starts "that was left as we set it" 50000 0 1 normal
exit $failed
