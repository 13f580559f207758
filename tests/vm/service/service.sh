# SPDX-License-Identifier: BSD-3-Clause
# Shared by the tests of the installed service, which source it.
set -euo pipefail

export PATH=$PATH:/usr/sbin:/sbin
failed=0
must() { # TEXT COMMAND...
  local what=$1
  shift
  if "$@" >/tmp/output 2>&1; then
    echo "ok    $what"
  else
    echo "FAIL  $what"
    sed 's/^/      /' /tmp/output
    failed=1
  fi
}
must_not() {
  local what=$1
  shift
  must "$what" bash -c '! "$@"' - "$@"
}
# Ends the test with its result, and after a failure with the service's log.
finish() {
  if [ $failed -ne 0 ]; then journalctl -b --no-pager -o short-monotonic -u 'strainwave*' | tail -n 60; fi
  exit $failed
}

install_package() { dpkg -i ./strainwave_*.deb >/tmp/output 2>&1 || { cat /tmp/output; exit 1; }; }
property() { systemctl show strainwaved -p "$1" --value; }
core() { property MainPID; }
gateway() { pgrep -u strainwave-gateway; }
# A field of the joint's state, such as "mode" (a number) or "session_id".
state() { strainwavectl status elbow | awk -v field="$1" '$1 == field { print $2 }'; }
is_state() { [ "$(state "$1")" = "$2" ]; }
# wait_for SECONDS COMMAND...: repeats the command until it succeeds.
wait_for() {
  local left=$(($1 * 10))
  shift
  while ! "$@" >/dev/null 2>&1; do
    if [ $((left--)) -le 0 ]; then return 1; fi
    sleep 0.1
  done
}
is_active() { systemctl -q is-active strainwaved; }
restarted_since() { is_active && [ "$(core)" != "$1" ] && [ "$(core)" != 0 ]; }
is_near() { awk -v a="$(state joint_position_rad)" -v b="$1" 'BEGIN { exit !((a - b) * (a - b) < 1e-8) }'; }
# Checks for three seconds that the joint is off and has no torque, and that its position does not change.
stays_off_and_still() {
  local begin
  begin=$(state joint_position_rad)
  for _ in 1 2 3; do
    is_state mode 0 && is_state torque_commanded_Nm 0 && [ "$(state joint_position_rad)" = "$begin" ] || return 1
    sleep 1
  done
}
# Enables the joint, which is off, moves it and waits until it holds at the position.
move_to() {
  strainwavectl enable elbow && strainwavectl move elbow "$1" && wait_for 10 is_state mode 2 && wait_for 10 is_near "$1"
}
