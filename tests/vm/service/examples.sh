#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What the pages tell the operator of a machine with packages, command by command, as the pages have it. The machine
# knows nothing of Strainwave before.
. ./service.sh
sudo() { "$@"; }
export -f sudo

ip route delete 239.255.76.67/32 dev lo
mkdir -p build/packages
mv strainwave_*.deb build/packages/

# The guest's console is no terminal to be asked at.
follow() { bash ./"$1".sh </dev/null; }
# page NAME: as its reader, with the service as the page before left it.
page() {
  local start
  start=$(date +%s)
  must "$1" follow "$1"
  cat /tmp/output
  echo "      $(($(date +%s) - start)) s of the machine's time"
}
page installation
must_not "after installation.md nothing runs" pgrep strainwave
systemctl start strainwaved
for name in *.sh; do
  name=${name%.sh}
  case $name in examples | service | installation) ;; *) page "$name" ;; esac
done
finish
