# SPDX-License-Identifier: BSD-3-Clause
# Shared by the scripts of this folder, which source it: a board of simulated lines and files, and the checks.
set -euo pipefail
chmod +x ./* 2>/dev/null || true

LINES_FOLDER=$PWD/lines
TREE=$PWD/tree
failed=0
tell_why() { # shows the logs when a script fails anywhere
  local status=$?
  if [ $status -ne 0 ]; then tail -n 40 daemon.log ctl.log 2>/dev/null || true; fi
}
trap tell_why EXIT

check() { # check "what" command...
  local what=$1
  shift
  if "$@"; then echo "ok    $what"; else
    echo "FAIL  $what"
    failed=1
  fi
}

# Makes every line of the joint under the name of its role, pulled as docs/gpio.md requires. Outputs are pulled down, so that enable and brake fall
# when nothing drives them. The board drives the contacts.
make_lines() {
  modprobe gpio-sim 2>/dev/null || true
  local chip=/sys/kernel/config/gpio-sim/board number=0 name
  local names=(enable direction brake_release alive amplifier_fault estop negative_limit positive_limit home index
    quadrature_a quadrature_b)
  mkdir -p $chip/bank
  echo ${#names[@]} >$chip/bank/num_lines
  echo joint-board >$chip/bank/label
  for name in "${names[@]}"; do
    mkdir $chip/bank/line$number
    echo "$name" >$chip/bank/line$number/name
    number=$((number + 1))
  done
  echo 1 >$chip/live
  local device folder
  device=$(cat $chip/dev_name)
  folder=/sys/devices/platform/$device/$(cat $chip/bank/chip_name)
  mkdir -p "$LINES_FOLDER"
  for number in "${!names[@]}"; do
    ln -sfn "$folder/sim_gpio$number" "$LINES_FOLDER/${names[$number]}"
  done
  pull home pull-up
}
pull() { echo "$2" >"$LINES_FOLDER/$1/pull"; }
level() { cat "$LINES_FOLDER/$1/value"; }
level_is() { test "$(level "$1")" = "$2"; }

make_tree() {
  mkdir -p "$TREE"/pwm/pwm0 "$TREE"/count0
  for file in pwm/pwm0/enable pwm/pwm0/duty_cycle pwm/pwm0/period pwm/pwm0/polarity count0/ceiling count0/enable \
    count0/function; do echo 0 >"$TREE/$file"; done
  echo 0000000000 >"$TREE/count0/count"
  echo 25000 >"$TREE/temperature"
  : >"$TREE/truth"
}
duty() { head -n1 "$TREE/pwm/pwm0/duty_cycle"; }
duty_is() { test "$(duty)" = "$1"; }
truth() { cat "$TREE/truth"; }
near() { # near A B TOLERANCE
  python3 -c 'import sys; a, b, tolerance = map(float, sys.argv[1:]); sys.exit(not abs(a - b) <= tolerance)' "$@" ||
    { echo "      $1 is not $2"; return 1; }
}

line_table() { # line_table ROLE ACTIVE [BIAS]
  printf '[joint.gpio.%s]\nchip = "joint-board"\nline = "%s"\nactive = "%s"\nbias = "%s"\n' "$1" "$1" "$2" "${3:-as_is}"
}

# gpio.toml: the joint of config/gpio.toml on this board.
make_configuration() {
  ./strainwavectl keygen --out key --role operator --comment vm >/dev/null
  cp key.pub authorized_keys
  chmod 600 authorized_keys
  cat >gpio.toml <<TOML
[daemon]
period_s = 0.001
lcm_url = "udpm://239.255.76.67:7667?ttl=0"
[security]
authorized_keys = "authorized_keys"
[[joint]]
name = "elbow"
joint_model = "rhs17-6006"
model = "rigid"
inertia_kgm2 = 0.089
gear_ratio = 50
driver = "gpio"
table = "rhs17-6006.json"
[joint.limits]
position_min_rad = -0.6
position_max_rad = 0.6
speed_limit_rad_s = 1.0
acceleration_rad_s2 = 40
following_error_rad = 0.1
torque_limit_Nm = 34
[joint.homing]
to = "home"
required = true
then_index = true
position_rad = 0.25132741
speed_rad_s = 0.05
travel_rad = 1.2
[joint.thermometer]
file = "$TREE/temperature"
period_s = 0.2
[joint.gpio.pwm]
chip = "$TREE/pwm"
frequency_Hz = 20000
[joint.gpio.motor]
torque_constant_Nm_A = 0.192
peak_current_A = 4.3
[joint.gpio.amplifier]
kind = "current"
full_scale_A = 5.0
enable_delay_s = 0.01
[joint.gpio.brake]
release_delay_s = 0.05
engage_delay_s = 0.03
stop_delay_s = 0.1
[joint.gpio.encoder]
source = "counter"
counter = "$TREE/count0"
ceiling = 4294967295
counts_per_motor_revolution = 6400
$(line_table enable high)
$(line_table direction high)
$(line_table brake_release high)
$(line_table alive high)
$(line_table amplifier_fault low pull_up)
$(line_table estop high)
$(line_table negative_limit high)
$(line_table positive_limit high)
$(line_table home low)
$(line_table index high)
TOML
}

# The priority is above the daemon's, because real mechanics do not wait.
start_plant() { # start_plant POSITION_RAD
  chrt -f 85 ./gpio_board plant "$LINES_FOLDER" "$TREE" "$1" &
  plant=$!
  sleep 0.1
}

start_daemon() {
  ./strainwaved --config gpio.toml >daemon.log 2>&1 &
  daemon=$!
  local i
  for i in $(seq 100); do
    grep -q ready daemon.log && return 0
    kill -0 $daemon 2>/dev/null || break
    sleep 0.1
  done
  cat daemon.log
  return 1
}
ctl() { timeout 60 ./strainwavectl --key key "$@" >>ctl.log 2>&1; }
refused() { ! ctl "$@"; }
status_has() { ./strainwavectl status elbow 2>/dev/null | grep -q -- "$1"; }
