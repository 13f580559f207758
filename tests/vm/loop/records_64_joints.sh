#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# records_64_joints.sh SECONDS: what `strainwavectl record` gets of 64 joints at 200 Hz, in virtual time: every state of every cycle, and
# the loop leaves out none. On a real machine bench/recording says the same of that machine.
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
# All but those of the first and the last moments, when recorder and daemon do not begin and end in the same cycle.
states=$(sed -nE 's/^64 joints, ([0-9]+) states.*/\1/p' <<<"$said")
((states >= 64 * 200 * seconds - 128 && states <= 64 * 200 * seconds + 128))
