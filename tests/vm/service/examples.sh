#!/bin/bash
# What README and pages tell the operator of a machine with packages, command by command, as the pages have it. The machine
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
page README
must "after README.md the joint is where it was sent" wait_for 5 is_near 0.5
systemctl disable --now strainwaved
dpkg -r strainwave >/dev/null 2>&1
page quick-start
must_not "after quick-start.md nothing runs" pgrep strainwave
systemctl start strainwaved
for name in *.sh; do
  name=${name%.sh}
  case $name in examples | service | README | quick-start) ;; *) page "$name" ;; esac
done
finish
