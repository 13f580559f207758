#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The machine reboots while its joint holds. The service starts again by itself, but the joint stays off. Runs after each boot.
. ./service.sh

if [ ! -e /var/lib/strainwave/before ]; then
  mkdir -p /var/log/journal # a journal that outlives the boot
  systemctl restart systemd-journald
  install_package
  sed -i 's/^name = "elbow"/name = "elbow" # of this machine/' /etc/strainwave/strainwaved.toml
  systemctl enable --now strainwaved
  must "the joint moves to 0.5 rad and holds" move_to 0.5
  state session_id >/var/lib/strainwave/before
  if [ $failed -ne 0 ]; then finish; fi
  echo "rebooting"
  systemctl reboot
  sleep 60
  exit 1
fi

must "the service is back by itself" wait_for 20 is_active
must "the configuration is this machine's" grep -q 'of this machine' /etc/strainwave/strainwaved.toml
must "the run before ended in order" bash -c 'journalctl -b -1 -u strainwaved -o cat | grep -q "stopped: every joint is at rest"'
must_not "in a new session" is_state session_id "$(cat /var/lib/strainwave/before)"
must "the joint is off, and nothing moves by itself" stays_off_and_still
must "when told to, it moves" move_to 0.2
finish
