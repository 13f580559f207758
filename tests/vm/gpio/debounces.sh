#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# A bouncing contact, with and without debounce_s. The test uses the amplifier's fault input, because the daemon latches its fault.
. ./board.sh
make_lines
make_tree
make_configuration
sed -i '/^\[joint.gpio.amplifier_fault\]/,/^bias/{s/"low"/"high"/;s/"pull_up"/"as_is"/}' gpio.toml
cp gpio.toml believing.toml
sed '/^\[joint.gpio.amplifier_fault\]/a debounce_s = 0.01' believing.toml >gpio.toml
start_plant 0.3

hold() {
  check "starts" start_daemon
  check "enables" ctl enable elbow
  sleep 0.2 # the brake opens under torque
}
end() { kill $daemon && wait $daemon; }

hold
./gpio_board bounce "$LINES_FOLDER" amplifier_fault 3
check "three seconds of bounces are no fault of an input that must be steady for 10 ms" level_is enable 1
reaction_ns=$(./gpio_board react "$LINES_FOLDER" "$TREE" amplifier_fault)
echo "the same input steady to enable off: $reaction_ns ns of virtual time"
check "10 ms, a period and a cycle's work of steady level are one" \
  test "$reaction_ns" -ge 10000000 -a "$reaction_ns" -le 12100000
check "which is said" status_has "drive fault"
pull amplifier_fault pull-down
end

cp believing.toml gpio.toml
hold
./gpio_board bounce "$LINES_FOLDER" amplifier_fault 0.1
check "without debounce_s the first bounce is one" level_is enable 0
end
kill $plant
exit $failed
