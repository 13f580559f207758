#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Keys that only root may read reach the daemon as a credential. A second daemon runs next to the first. Removal stops both.
. ./service.sh
install_package
config=/etc/strainwave/strainwaved.toml

echo "== keys"
strainwavectl keygen --out key --role operator --comment test >/dev/null
cat key.pub >>/etc/strainwave/authorized_keys
chmod 600 /etc/strainwave/authorized_keys
sed -i -e 's/^unsigned_orders = .*/unsigned_orders = "refuse"/' -e 's/^# authorized_keys = /authorized_keys = /' $config
must "it starts with keys that its user cannot read by itself" systemctl start strainwaved
must_not "an order without a signature is refused" strainwavectl enable elbow
must "an order with one is obeyed" strainwavectl --key key enable elbow
must "a stop needs none" strainwavectl disable elbow

echo "== a second daemon"
sed -e 's/^\[daemon\]/[daemon]\nprefix = "LEFT"/' -e 's/^unsigned_orders = .*/unsigned_orders = "allow"/' \
  -e 's/^authorized_keys/# &/' $config >/etc/strainwave/left.toml
must "starts from the template" systemctl start strainwaved@left
must "and is obeyed on its own prefix" strainwavectl --prefix LEFT enable elbow
must "while the first is off" is_state mode 0
must "each has a folder of its own" test -d /var/lib/strainwave/left
sed -i 's/^prefix.*/prefix = "SW"/' /etc/strainwave/left.toml
must_not "with the first one's prefix it does not start" systemctl restart strainwaved@left
systemctl reset-failed
sed -i 's/^prefix.*/prefix = "LEFT"/' /etc/strainwave/left.toml
systemctl start strainwaved@left

echo "== devices"
must "the group may hold off sleep states" test "$(stat -c %G:%a /dev/cpu_dma_latency)" = strainwave:660
bank=/sys/kernel/config/gpio-sim/service/bank
mkdir -p $bank/line0
echo 2 >$bank/num_lines
echo 1 >${bank%/bank}/live
udevadm settle
chip=$(cat $bank/chip_name)
must "the group may use GPIO chips" test "$(stat -c %G:%a "/dev/$chip")" = strainwave:660
# Uses the sandbox of the unit: its user, its device list, its file systems.
mapfile -t sandbox < <(grep -E '^(DevicePolicy|DeviceAllow|Protect|Private|ReadWritePaths|ProcSubset|Capability)' \
  /lib/systemd/system/strainwaved.service | sed 's/^/-p\n/')
within() { systemd-run --quiet --wait --pipe -p User=strainwave "${sandbox[@]}" "$@"; }
must "the service reaches them" within gpioinfo "$chip"
must_not "but no disk" within head -c 1 /dev/vda
pull=/sys/devices/platform/$(cat ${bank%/bank}/dev_name)/$chip/sim_gpio0/pull
must_not "what root keeps in sysfs it cannot write" within sh -c "echo pull-up >$pull"
chgrp strainwave "$pull"
chmod g+w "$pull"
must "what its group was given there it can" within sh -c "echo pull-up >$pull"
must_not "nor does it see other processes" within sh -c 'ls /proc/1/status'
must_not "a folder outside sysfs is given to nobody" /usr/libexec/strainwave/grant-sysfs /etc
mkdir -p /etc/systemd/network
cp /usr/share/strainwave/network/* /etc/systemd/network/
udevadm control --reload
ip link add vcan5 type vcan
udevadm settle
must "a CAN interface has a short transmit queue" test "$(cat /sys/class/net/vcan5/tx_queue_len)" = 16
systemctl start systemd-networkd
must_not "every key of the network files is known" bash -c \
  'journalctl -u systemd-networkd -u systemd-udevd -o cat | grep -E "80-strainwave.*(nknown|nvalid|gnoring|ailed)"'
must "the CAN interface is theirs" bash -c 'networkctl status vcan5 | grep -q 80-strainwave-can.network'

echo "== an upgrade and a removal"
first=$(core)
dpkg -i ./strainwave_*.deb >install.log 2>&1
must "an upgrade leaves the daemon running" test "$(core)" = "$first"
must "and says so" grep -q 'systemctl restart strainwaved.service' install.log
mapfile -t before < <(gateway)
kill -9 "${before[@]}"
replaced() { [ "$(gateway | grep -cvxF "$(printf '%s\n' "${before[@]}")")" = ${#before[@]} ]; }
must "each daemon has another gateway" wait_for 3 replaced
must "which is the one it knows" test "$(gateway | while read -r pid; do readlink "/proc/$pid/exe"; done | grep -c deleted)" = ${#before[@]}
dpkg -r strainwave >/dev/null 2>&1
must_not "a removal ends both daemons" pgrep strainwave
finish
