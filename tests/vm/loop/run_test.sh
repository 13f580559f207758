#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs one test program in virtual time: run_test.sh [NAME=VALUE...] ./PROGRAM [ARGUMENT...]
set -euo pipefail
exec env STRAINWAVE_VIRTUAL_TIME=1 "$@"
