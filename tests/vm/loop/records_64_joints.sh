#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# records_64_joints.sh SECONDS: `strainwavectl record` must receive every state of 64 joints at 200 Hz in virtual time, and the loop must skip no
# cycle. bench/recording does the same in real time on the current machine.
set -euo pipefail
seconds=$1
mkdir bin bench
mv strainwaved strainwave-gateway strainwavectl bin
mv recording bench
sed -i 's/^real_time = .*/real_time = "enforce"/' config/demo.toml

said=$(python3 bench/recording --bin bin --joints 64 --seconds "$seconds")
echo "$said"
[[ "$said" == *"0 not published, 0 datagrams lost before the recorder, 0 messages missing by its own count; the daemon left out 0 periods"* ]]
[[ "$said" == *"the loop ran in real time"* ]]
# Some states at both ends may be missing, because recorder and daemon do not start and end in the same cycle.
states=$(sed -nE 's/^64 joints, ([0-9]+) states.*/\1/p' <<<"$said")
((states >= 64 * 200 * seconds - 128 && states <= 64 * 200 * seconds + 128))
