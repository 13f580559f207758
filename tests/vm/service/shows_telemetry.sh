#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# strainwave-telemetry as a service: its output, its privileges, its access control, and that it does not disturb the daemon.
# The configuration files are the examples of docs/telemetry.md.
. ./service.sh
sudo() { "$@"; }
export -f sudo
install_package
systemctl start strainwaved
request() { # TARGET [HEADER]
  exec 3<>/dev/tcp/127.0.0.1/8765 || return 1
  printf 'GET %s HTTP/1.1\r\nHost: localhost\r\n%s\r\n' "$1" "${2:+$2$'\r\n'}" >&3
  timeout 5 cat <&3
  exec 3>&-
}
answers() { request "$1" "${3:-}" | grep -q "$2"; }
telemetry() { systemctl show strainwave-telemetry -p "$1" --value; }
status_of() { awk -v field="$1:" '$1 == field { print $2 }' "/proc/$(telemetry MainPID)/status"; }

echo "== as the page tells"
must_not "the installation starts nothing" systemctl -q is-active strainwave-telemetry
must "the page's commands" bash ./telemetry.sh
token=$(cat /etc/strainwave/telemetry-token)
must "it runs" wait_for 5 systemctl -q is-active strainwave-telemetry
must "without the token nobody looks" wait_for 10 answers /metrics '^HTTP/1.1 401 '
must "with it the joint is there" wait_for 10 answers "/metrics?token=$token" 'strainwave_joint_mode{prefix="SW",joint="elbow"} 0'
must "and with the header" answers /metrics '^HTTP/1.1 200 ' "Authorization: Bearer $token"

echo "== as installed"
rm -r /etc/systemd/system/strainwave-telemetry.service.d
systemctl daemon-reload
systemctl restart strainwave-telemetry
must "this machine needs no token" wait_for 10 answers /metrics 'strainwave_cycles_total{prefix="SW"}'
must "it listens on loopback alone" test "$(ss -Hltn 'sport = :8765' | awk '{ print $4 }')" = 127.0.0.1:8765
must_not "its user is nobody's" grep -q strainwave-telemetry /etc/passwd
must "it is not root" test "$(status_of Uid)" != 0
for set in CapInh CapPrm CapEff CapBnd CapAmb; do
  must "no capability ($set)" test "$(status_of $set)" = 0000000000000000
done
must "it may gain no privilege" test "$(status_of NoNewPrivs)" = 1

echo "== whatever becomes of it"
strainwavectl enable elbow >/dev/null
before=$(core)
kill -9 "$(telemetry MainPID)"
must "it comes back after a crash" wait_for 20 answers /metrics 'strainwave_joint_mode{prefix="SW",joint="elbow"} 2'
must "no joint noticed" is_state mode 2
must "nor the daemon" test "$(core)" = "$before"
systemctl stop strainwave-telemetry
must "it ends in order" test "$(telemetry Result)" = success
finish
