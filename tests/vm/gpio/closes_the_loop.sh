#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# One joint from the first check of its wiring to its shut-down, with a motor behind simulated lines and files.
. ./board.sh
make_lines
make_tree
make_configuration

# Before any motion: the output of gpio-check, which must not touch the lines.
check "gpio-check finds every line usable" ctl gpio-check gpio.toml
check "gpio-check shows every line" test "$(./strainwavectl gpio-check gpio.toml | grep -c joint-board\\\|/dev/gpiochip)" -ge 10
check "gpio-check tells an inactive input" bash -c './strainwavectl gpio-check gpio.toml | grep -q "^  home .*inactive"'
pull home pull-down
check "gpio-check tells it from an active one" bash -c './strainwavectl gpio-check gpio.toml | grep "^  home " | grep -qv inactive'
pull home pull-up

# Errors before any motion: a line in use by another program, and an unknown name.
gpioset --mode=signal joint-board 0=0 &
holder=$!
sleep 0.3
check "a held line keeps the daemon from starting" bash -c '! timeout 10 ./strainwaved --config gpio.toml >held.log 2>&1'
check "and its holder is named" grep -q 'enable.*held by "gpioset"' held.log
check "gpio-check names it, too" bash -c '! ./strainwavectl gpio-check gpio.toml >held.log 2>&1 && grep -q gpioset held.log'
kill $holder
wait $holder 2>/dev/null || true
sed 's/line = "estop"/line = "e-stop"/' gpio.toml >wrong.toml
check "a wrong name keeps the daemon from starting" bash -c '! timeout 10 ./strainwaved --config wrong.toml >wrong.log 2>&1'
check "and is named" grep -q 'joint\[0\].gpio.estop: line = e-stop: no line' wrong.log
check "no output has moved meanwhile" level_is enable 0

start_plant 0.3
check "the daemon starts" start_daemon
check "its outputs are safe" level_is enable 0
check "the brake is shut" level_is brake_release 0
check "the hardware watchdog is fed" bash -c 'for i in $(seq 20); do cat lines/alive/value; sleep 0.0007; done | sort -u | wc -l | grep -qx 2'
check "gpio-check names the daemon" bash -c './strainwavectl gpio-check gpio.toml | grep -q "^  estop .*held by \"strainwaved elbow\""'

check "enable" ctl enable elbow
sleep 0.2 # the brake opens under torque
check "the amplifier is on" level_is enable 1
check "the brake is open" level_is brake_release 1
check "a move before homing is refused" refused move elbow 0.0
check "homing" ctl home elbow
sleep 0.3 # the joint comes to rest, because state and truth are sampled at different instants
check "home is where it is" near "$(./strainwavectl status elbow --json | grep -o '"joint_position_rad": *[-0-9.e]*' | grep -o '[-0-9.e]*$')" "$(truth)" 0.0002
check "a move" ctl move elbow -0.2 --wait
check "arrives" near "$(truth)" -0.2 0.001
check "and back, the other direction of the bridge" ctl move elbow 0.3 --wait
check "arrives there" near "$(truth)" 0.3 0.001

check "a move into the limit switch ends with a fault" refused move elbow 0.55 --wait
check "it is the limit switch's" status_has "limit switch"
check "the amplifier is off" level_is enable 0
check "no torque" duty_is 0
sleep 0.2
check "the brake shuts after its delay" level_is brake_release 0
check "the fault is cleared" ctl clear-fault elbow
check "enable at the switch" ctl enable elbow
sleep 0.2 # the brake opens under torque
check "farther into it is refused" refused move elbow 0.58
check "out of it is allowed" ctl move elbow 0.2 --wait

pull amplifier_fault pull-down
sleep 0.01
check "the amplifier's fault stops the joint" level_is enable 0
check "and is told" status_has "drive fault"
pull amplifier_fault pull-up
ctl clear-fault elbow
sleep 0.3 # the joint coasts without torque and can be enabled only at rest
check "enable after it" ctl enable elbow
sleep 0.2 # the brake opens under torque

# The emergency stop is pressed during a motion. Within a period all outputs must be safe.
ctl move elbow -0.4
sleep 0.15
check "it moves" bash -c 'test "$(head -n1 tree/pwm/pwm0/duty_cycle)" != 0'
reaction_ns=$(./gpio_board react "$LINES_FOLDER" "$TREE" estop)
echo "e-stop to enable off and no torque: $reaction_ns ns of virtual time"
# The daemon reads the input once a period. A tenth of a period is a generous limit for a cycle's work.
check "within one period and a cycle's work" test "$reaction_ns" -le 1100000
check "the brake waits for its delay" level_is brake_release 1
sleep 0.2
check "and shuts" level_is brake_release 0
check "the fault is the e-stop's" status_has "emergency stop"
check "with it pressed it cannot be enabled" bash -c './strainwavectl --key key clear-fault elbow >>ctl.log && ! ./strainwavectl --key key enable elbow >>ctl.log 2>&1'
position=$(truth)
pull estop pull-down
sleep 0.5
check "releasing it moves nothing" near "$(truth)" "$position" 0.000001
check "nor switches anything on" level_is enable 0
ctl clear-fault elbow
# Repeats this at other instants within the period.
for pause in 0.0103 0.0205 0.0307 0.0409; do
  sleep 0.3
  ctl enable elbow
  sleep $pause
  reaction_ns=$(./gpio_board react "$LINES_FOLDER" "$TREE" estop)
  check "once more: $reaction_ns ns" test "$reaction_ns" -le 1100000
  pull estop pull-down
  sleep 0.2
  ctl clear-fault elbow
done
sleep 0.3
check "enable after it" ctl enable elbow
sleep 0.2 # the brake opens under torque
check "disable" ctl disable elbow
sleep 0.1
check "then everything is safe" bash -c 'test "$(cat lines/enable/value)$(cat lines/brake_release/value)$(head -n1 tree/pwm/pwm0/duty_cycle)" = 000'

check "enable once more" ctl enable elbow
sleep 0.2 # the brake opens under torque
kill $daemon
wait $daemon || failed=1
check "the daemon's end leaves everything safe" bash -c 'test "$(cat lines/enable/value)$(cat lines/brake_release/value)$(head -n1 tree/pwm/pwm0/duty_cycle)" = 000'
kill $plant
exit $failed
