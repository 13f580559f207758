#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the commands of the pages for an operator of a machine with packages, in the order of the pages. Strainwave is not installed at the beginning.
. ./service.sh
sudo() { "$@"; }
export -f sudo

ip route delete 239.255.76.67/32 dev lo
mkdir -p build/packages
mv strainwave_*.deb build/packages/

# The guest's console is not an interactive terminal.
follow() { bash ./"$1".sh </dev/null; }
# page NAME: follows the page as a reader does, with the service in the state that the page before left.
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
