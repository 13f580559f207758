#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The installed service under systemd: the users of its processes, and what remains after the processes are killed or stopped.
. ./service.sh

ip route delete 239.255.76.67/32 dev lo
install_package
must_not "nothing is enabled by the installation" systemctl -q is-enabled strainwaved
must_not "nothing is started by the installation" pgrep strainwave

echo "== start"
sysctl -q vm.compact_unevictable_allowed=1
must "it starts, and systemd waits until the loop meets its timing" systemctl enable --now strainwaved
must "it is active" is_active
must "its log says why" bash -c 'journalctl -u strainwaved -o cat | grep -q "ready: the loop meets its timing"'
must "it warns of a kernel that moves locked memory" bash -c \
  'journalctl -u strainwaved -o cat | grep -q "compact_unevictable_allowed=0"'
must "the route of LCM's group has a loopback source" bash -c 'ip route get 239.255.76.67 | grep -q "dev lo src 127.0.0.1"'
must "its status names the joint's mode" bash -c 'systemctl show strainwaved -p StatusText | grep -q "elbow off"'
must "the core is not root" test "$(ps -o user:20= -p "$(core)")" = strainwave
must "its gateway is another user, and nobody's group but its own" test \
  "$(awk '/^(Uid|Gid|Groups):/' "/proc/$(gateway)/status" | tr -s '\t ' ' ')" = "$(id strainwave-gateway | awk -F'[=(]' \
    '{ print "Uid: "$2" "$2" "$2" "$2; print "Gid: "$4" "$4" "$4" "$4; print "Groups: "$4" " }')"
must_not "the two share no user" test "$(ps -o uid= -p "$(core)")" = "$(ps -o uid= -p "$(gateway)")"
must "one thread has SCHED_FIFO 80" test "$(ps -L -o cls=,rtprio= -p "$(core)" | grep -c 'FF *80')" = 1
must "its memory is locked" bash -c "awk '/^VmLck/ { exit !(\$2 > 1000) }' /proc/$(core)/status"
must_not "nothing of what it asks the kernel for is refused" bash -c 'journalctl -u strainwaved -o cat | grep -qi "permission denied"'
must "neither has a capability" bash -c "! grep -hE '^Cap(Prm|Eff|Bnd|Amb)' /proc/{$(core),$(gateway)}/status | grep -qv '0000000000000000'"
must "the gateway has a filter of its own upon the service's" \
  test "$(awk '/^Seccomp_filters/ { print $2 }' "/proc/$(gateway)/status")" -gt "$(awk '/^Seccomp_filters/ { print $2 }' "/proc/$(core)/status")"
as_gateway() { runuser -u strainwave-gateway -- "$@"; }
must_not "the gateway's user cannot read the daemon's copy of the keys" as_gateway sh -c 'cat /run/credentials/strainwaved.service/*'
must_not "nor the flight records" as_gateway ls /var/lib/strainwave
must_not "nor the locks" as_gateway ls /run/strainwave
must_not "nor signal the core" as_gateway kill -0 "$(core)"
must_not "nor have a gateway started" as_gateway python3 -c \
  'import socket; socket.socket(socket.AF_UNIX).connect("/run/strainwave-gateway/core")'
must_not "in its own view of the files there is no configuration" nsenter -t "$(gateway)" -m ls /etc/strainwave/strainwaved.toml
must_not "and there are no keys" nsenter -t "$(gateway)" -m ls /etc/strainwave/authorized_keys
must "a process of the same user cannot read the core's memory" test "$(stat -c %U "/proc/$(core)/mem")" = root

echo "== tracking through the service"
must "the joint moves to 0.5 rad and holds" move_to 0.5
must "without a fault" is_state fault 0

echo "== the gateway is killed, then stopped"
pid=$(core) session=$(state session_id) first=$(gateway)
strainwavectl move elbow -1.0
kill -9 "$first"
must "another gateway is there within a second" wait_for 1 bash -c "pgrep -u strainwave-gateway | grep -qvx $first"
must "the core goes on" test "$(core)" = "$pid"
must "in the same session" is_state session_id "$session"
must "and the move is finished" wait_for 5 is_near -1.0
second=$(gateway)
kill -STOP "$second"
must "a gateway that hangs is replaced" wait_for 6 bash -c "pgrep -u strainwave-gateway | grep -qvx $second"
must "and is gone" wait_for 1 bash -c "! kill -0 $second"
must "the joint held all the while" wait_for 3 bash -c "strainwavectl status elbow | grep -q 'mode *2'"
must "still in the same session" is_state session_id "$session"
must "it is obeyed again" strainwavectl move elbow 0.2
must "nothing was restarted by systemd" test "$(property NRestarts)" = 0

echo "== the core is killed while it moves"
strainwavectl move elbow 1.5
kill -9 "$pid"
must "systemd starts it again" wait_for 15 restarted_since "$pid"
must "no gateway of the old core is left" test "$(pgrep -c -u strainwave-gateway)" = 1
must "in a new session" bash -c "[ \"\$(strainwavectl status elbow | awk '\$1 == \"session_id\" { print \$2 }')\" != $session ]"
must "the joint is off, and nothing moves by itself" stays_off_and_still
must_not "an order of the old session is none of the new: it must be enabled first" strainwavectl move elbow 1.0
must "when told to, it moves" move_to 0.1

echo "== the core is stopped: the watchdog"
pid=$(core)
kill -STOP "$pid"
must "systemd sees it within the watchdog's time and starts it again" wait_for 15 restarted_since "$pid"
must "because of the watchdog" bash -c 'journalctl -u strainwaved -o cat | grep -q "Watchdog timeout"'
must "without one more cycle of the old one" bash -c "journalctl -u strainwaved -o cat | grep -q 'status=9/KILL'"
must "the joint is off, and nothing moves by itself" stays_off_and_still
must "two restarts were counted" test "$(property NRestarts)" = 2

echo "== too many restarts"
systemctl reset-failed strainwaved
for _ in 1 2 3 4; do
  kill -9 "$(core)"
  sleep 3
done
must "systemd gives up" test "$(property ActiveState)" = failed
must_not "and nothing runs" pgrep strainwave
systemctl reset-failed strainwaved

echo "== stop"
systemctl start strainwaved
must "it holds" move_to 0.3
systemctl stop strainwaved
must "it ended in order" test "$(property Result)" = success
must "with its joint at rest" bash -c 'journalctl -u strainwaved -o cat | tail -n 20 | grep -q "stopped: every joint is at rest"'
must_not "nothing is left" pgrep strainwave
finish
