#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The guest has what the tests need: a real-time kernel, virtual time, vcan, gpio-sim, systemd, LCM's multicast route.
set -euo pipefail
failed=0
must() {
  local what=$1
  shift
  if "$@" >/dev/null 2>&1; then echo "ok    $what"; else echo "FAIL  $what"; failed=1; fi
}

must "PREEMPT_RT kernel" grep -q PREEMPT_RT /proc/version
must "systemd is the first process" test "$(cat /proc/1/comm)" = systemd
must "SCHED_FIFO" chrt -f 80 true
must "a multicast route on the loopback" bash -c 'ip route get 239.255.76.67 | grep -q "dev lo src 127.0.0.1"'

can_round_trip() {
  ip link add dev vcan9 type vcan && ip link set vcan9 up
  candump -n 1 -L vcan9 >dump &
  sleep 0.1
  cansend vcan9 123#DEADBEEF
  wait $!
  grep -q '123#DEADBEEF' dump
}
must "a frame over vcan" can_round_trip

gpio_round_trip() {
  local chip=/sys/kernel/config/gpio-sim/offers
  mkdir -p $chip/bank/line0
  echo 2 >$chip/bank/num_lines
  echo probe >$chip/bank/line0/name
  echo 1 >$chip/live
  local device=$(cat $chip/dev_name) gpiochip=$(cat $chip/bank/chip_name)
  echo pull-up >/sys/devices/platform/"$device"/"$gpiochip"/sim_gpio0/pull
  test "$(gpioget "$gpiochip" 0)" = 1
  gpioset --mode=time --sec=1 "$gpiochip" 1=1 &
  sleep 0.2
  test "$(cat /sys/devices/platform/"$device"/"$gpiochip"/sim_gpio1/value)" = 1
  wait
}
must "simulated GPIO lines in both directions" gpio_round_trip

virtual_time() {
  # A sleep of one second takes almost no host time, but the guest's clock advances by one second to the millisecond.
  local before after
  before=$(date +%s%N)
  sleep 1
  after=$(date +%s%N)
  local slept_ms=$(((after - before) / 1000000))
  test $slept_ms -ge 1000 && test $slept_ms -le 1020
}
must "virtual time" virtual_time
exit $failed
