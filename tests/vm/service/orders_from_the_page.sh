#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# strainwave-telemetry as a service with an operator's key, by the commands of docs/telemetry.md. Its page may order; the unit's exposure stays.
. ./service.sh
sudo() { "$@"; }
export -f sudo
install_package
sed -i -e 's/^unsigned_orders = .*/unsigned_orders = "refuse"/' -e 's/^# authorized_keys = /authorized_keys = /' /etc/strainwave/strainwaved.toml
# Prints the lines of the page from the line that begins with $1 to the line that begins with $2.
commands() { sed -n "\#^$1#,\#^$2#p" telemetry.md; }
commands 'strainwavectl keygen' 'sudo systemctl restart strainwaved' >key.sh
commands 'sudo install -m 600 ~/' 'sudo systemctl restart strainwave-telemetry' >unit.sh
address() { journalctl -u strainwave-telemetry -o cat | grep -o 'http://.*#token=.*' | tail -n 1; }
order() { node page_order.mjs "$1" SW.elbow "$2"; }

must "the page's commands make a key that the daemon knows" bash -e key.sh
must "the daemon runs with it" wait_for 10 is_active
must_not "it refuses orders without a signature" strainwavectl enable elbow
must "the page's commands give the key to the unit" bash -e unit.sh
must "the address with the token is in the journal" wait_for 10 test -n "$(sleep 2; address)"
must "an order from the page is obeyed" order "$(address)" enable
must "the joint holds" wait_for 5 is_state mode 2
must_not "one with another token is not" order "http://127.0.0.1:8765/#token=00000000000000000000000000000000" hold
must "the stop from the page needs none" order "http://127.0.0.1:8765/#token=none" stop
must "the joint is off" wait_for 5 is_state mode 0
must "the unit is exposed no more than promised" systemd-analyze security --no-pager --threshold=20 strainwave-telemetry
tail -n 1 /tmp/output
must_not "its user cannot read the key itself" runuser -u nobody -- cat /etc/strainwave/bench-key
finish
